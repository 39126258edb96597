// What of a light comes along a ray, one ray per lane; of shadows in color that of the channel CL_SHADOW_CHANNEL.
#ifndef CROSSLIGHT_LIGHT_PASSED_GLSL
#define CROSSLIGHT_LIGHT_PASSED_GLSL
#include "accel/few_shapes.glsl"

float lightPassed(Ray ray, uint shapes) {
  float passed = 1.0;
  if (CL_HAS(triangles)) passed = lightPassedTriangles(ray);
  if (CL_HAS(shapes)) passed = kFewShapes ? lightPassedShapes(ray, passed, shapes) : lightPassedShapesByTree(ray, passed);
  return inColor() ? passed * crossedShare() : passed;
}
#endif
