// The transparent fragments of every sample, as a list: which comes first is decided when they are resolved.
#ifndef CROSSLIGHT_LAYERS_GLSL
#define CROSSLIGHT_LAYERS_GLSL

layout(set = 0, binding = kBindLayerHeads, scalar) buffer LayerHeadBlock { uint layerHeads[]; };
layout(set = 0, binding = kBindLayers, scalar) buffer LayerBlock { LayerRecord layers[]; };
layout(set = 0, binding = kBindLayerCounts, scalar) buffer LayerCountBlock { uint layerCounts[]; };
layout(constant_id = kSpecSamples) const uint specSamples = 1u;

// Mesa 22.3's llvmpipe draws some samples of the row above a scissor too.
bool hasList() { return uint(gl_FragCoord.y) >= pushed.layerFirstRow; }

// Of this invocation's sample.
uint layerPlace() {
  uvec2 at = uvec2(gl_FragCoord.xy);
  return ((at.y - pushed.layerFirstRow) * frame.resolution.x + at.x) * specSamples + uint(gl_SampleID);
}

#ifdef CL_LAYERS
void keepLayer(Layer layer) {
  if (!hasList()) return;
  uint at = atomicAdd(layerCounts[kLayersWanted], 1u);
  if (at >= 0x80000000u) layerCounts[kLayersTooMany] = 1u;
  if (at < pushed.layerCapacity) {
    uint next = atomicExchange(layerHeads[layerPlace()], at);
    layers[at] = LayerRecord(gl_FragCoord.z, pushed.firstTriangle + uint(gl_PrimitiveID), next, layer.color, layer.passed);
  }
}
#endif
#endif
