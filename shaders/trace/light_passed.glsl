// What of a light comes along a ray, one ray per lane.
#ifndef CROSSLIGHT_LIGHT_PASSED_GLSL
#define CROSSLIGHT_LIGHT_PASSED_GLSL
#include "accel/few_shapes.glsl"

float lightPassed(Ray ray, uint shapes) {
  float passed = 1.0;
  if (CL_HAS(triangles)) passed = lightPassedTriangles(ray);
  if (!CL_HAS(shapes)) return passed;
  return kFewShapes ? lightPassedShapes(ray, passed, shapes) : lightPassedShapesByTree(ray, passed);
}
#endif
