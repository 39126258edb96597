#version 460
// Distance of the nearest blocker. The depth test goes by that distance as well, not by the interpolated one.
#extension GL_GOOGLE_include_directive : require
#include "raster/shadow_fragment.glsl"

layout(location = 0) out uint outDistance;

void main() {
  if (CL_HAS(alphaMask) && cutByMask(materialOf(pushed.materialId), alphaHere())) discard;
  ShadowView view = shadowViews[pushed.view];
  float z = distanceHere();
  gl_FragDepth = view.orthographic != 0u ? 1.0 - z / view.zFar : view.zNear / z;
  outDistance = floatBitsToUint(z);
}
