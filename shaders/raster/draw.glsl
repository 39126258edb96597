// What the stages of one draw read: its material as a uniform block, and lights as another while they are few. llvmpipe
// reads a uniform at a constant place once for eight lanes, a storage buffer lane by lane.
#ifndef CROSSLIGHT_RASTER_DRAW_GLSL
#define CROSSLIGHT_RASTER_DRAW_GLSL
#include "shared/raster_bindings.h"

layout(push_constant, scalar) uniform PushBlock { RasterPush pushed; };
layout(set = 0, binding = kBindDrawMaterial, scalar) uniform DrawMaterialBlock { MaterialRecord drawMaterial; };
layout(set = 0, binding = kBindFewLights, scalar) uniform FewLightsBlock { LightRecord fewLights[kFewLights]; };
layout(constant_id = kSpecLightCount) const uint specLightCount = kManyLights;

uint drawnLightCount() { return specLightCount == kManyLights ? frame.lightCount : specLightCount; }

LightRecord drawnLight(uint index) {
  if (specLightCount == kManyLights) return lights[index];
  return fewLights[index];
}

float lightVisibility(uint lightIndex) { return 1.0; }

#define CL_MATERIAL(id) drawMaterial
#define CL_LIGHT(index) drawnLight(index)
#endif
