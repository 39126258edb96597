// What a level leaves behind: nodes of the ray tree, or samples where surfaces send no rays on.
#ifndef CROSSLIGHT_RESULTS_GLSL
#define CROSSLIGHT_RESULTS_GLSL

const bool kManyLights = (specVariant & kVariantManyLights) != 0u;

// Nodes of the rays that follow, or kNoRayNode.
struct Children {
  uint reflected;
  uint transmitted;       // the first of them
  uint transmittedCount;  // with dispersion
};

struct Shaded {
  vec3 value;
  float alpha;
  vec3 weightScale;  // what is left after the way through a medium
  Children children;
};

bool inLaterBatch() { return kManyLights && pushed.firstLight > 0u; }

// The sample is complete when the last batch of lights is.
void storeSample(uint pixel, Shaded shaded) {
  vec4 sofar = vec4(0.0);
  if (inLaterBatch()) sofar = vec4(samples[pixel].rgb, 0.0);
  samples[pixel] = vec4(sofar.rgb + shaded.value, shaded.alpha);
}

void storeNode(uint index, RayRecord ray, Shaded shaded) {
  if (inLaterBatch()) {
    nodes[index].value += shaded.value;
    return;
  }
  nodes[index].value = shaded.value;
  nodes[index].alpha = shaded.alpha;
  nodes[index].reflected = shaded.children.reflected;
  nodes[index].transmitted = shaded.children.transmitted;
  if (CL_HAS(dispersion)) nodes[index].transmittedCount = shaded.children.transmittedCount;
  if (CL_HAS(absorption) && ray.kind != kRayPrimary) nodes[index].weight *= shaded.weightScale;
}

// The background, once; `direction` is that of the ray, of any length.
void storeMiss(uint index, uint pixel, vec3 direction) {
  if (inLaterBatch()) return;
  if (!kBranches) {
    samples[pixel] = vec4(radianceBehind(direction), 0.0);
    return;
  }
  nodes[index].value = radianceBehind(direction);
  nodes[index].alpha = 0.0;
  nodes[index].reflected = nodes[index].transmitted = kNoRayNode;
}
#endif
