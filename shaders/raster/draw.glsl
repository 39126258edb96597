// What the stages of one draw read: its material as a uniform block, and lights as another while they are few. llvmpipe
// reads a uniform at a constant place once for eight lanes, a storage buffer lane by lane.
#ifndef CROSSLIGHT_RASTER_DRAW_GLSL
#define CROSSLIGHT_RASTER_DRAW_GLSL
#include "shared/raster_bindings.h"

layout(push_constant, scalar) uniform PushBlock { RasterPush pushed; };
layout(set = 0, binding = kBindDrawMaterial, scalar) uniform DrawMaterialBlock { MaterialRecord drawMaterial; };
layout(set = 0, binding = kBindFewLights, scalar) uniform FewLightsBlock { LightRecord fewLights[kFewLights]; };
layout(constant_id = kSpecReflections) const uint specReflections = kReflectionsOff;
const bool kReflects = specReflections != kReflectionsOff;
layout(constant_id = kSpecLightCount) const uint specLightCount = kManyLights;

uint drawnLightCount() { return specLightCount == kManyLights ? frame.lightCount : specLightCount; }

LightRecord drawnLight(uint index) {
  if (specLightCount == kManyLights) return lights[index];
  return fewLights[index];
}

// Mesa 22.3's lavapipe compiles a vertex shader anew after every change of the bindings, with the values of the uniforms
// that its branches hang on (8 times the time of a picture of 1,500 draws). So the vertex stage takes from the storage
// buffers what it decides by, and from the uniforms what it computes with.
#ifdef CL_VERTEX_STAGE
MaterialRecord vertexMaterial(uint id) {
  MaterialRecord m = drawMaterial;
  m.model = materials[id].model;
  m.flags = materials[id].flags;
  m.shininess = materials[id].shininess;
  m.indexOfRefraction = materials[id].indexOfRefraction;
  if (kReadsLayers) {
    m.diffuseRoughness = materials[id].diffuseRoughness;
    m.clearcoat = materials[id].clearcoat;
    m.sheenColor = materials[id].sheenColor;
    m.sheenRoughness = materials[id].sheenRoughness;
    m.anisotropy = materials[id].anisotropy;
    m.iridescence = materials[id].iridescence;
    m.filmIndex = materials[id].filmIndex;
    m.diffuseTransmission = materials[id].diffuseTransmission;
  }
  return m;
}

LightRecord vertexLight(uint index) {
  LightRecord light = drawnLight(index);
  light.type = lights[index].type;
  light.flags = lights[index].flags;
  light.range = lights[index].range;
  return light;
}

#define CL_MATERIAL(id) vertexMaterial(id)
#define CL_LIGHT(index) vertexLight(index)
#else
#define CL_MATERIAL(id) drawMaterial
#define CL_LAYER_SLOT(id, layer) drawMaterial.layerTextures[layer]
#define CL_LIGHT(index) drawnLight(index)
#endif
#include "raster/shadow.glsl"
#endif
