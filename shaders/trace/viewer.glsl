#ifndef CROSSLIGHT_VIEWER_GLSL
#define CROSSLIGHT_VIEWER_GLSL
// The viewer of a secondary ray is where it comes from; primary rays share the camera's rule with the rasteriser.
vec3 towardsViewer(RayRecord ray, vec3 renderPos) {
  bool camera = !kBranches || ray.kind == kRayPrimary;
  return camera ? viewDirection(renderPos) : -safeNormalize(ray.direction, vec3(0.0));
}
#endif
