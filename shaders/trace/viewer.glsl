#ifndef CROSSLIGHT_VIEWER_GLSL
#define CROSSLIGHT_VIEWER_GLSL
// The viewer of mirrored and refracted rays is where they come from; what the camera sees directly shares its rule with
// the rasteriser.
vec3 towardsViewer(RayRecord ray, vec3 renderPos) {
  return isSeenDirectly(ray.kind) ? viewDirection(renderPos) : -safeNormalize(ray.direction, vec3(0.0));
}
#endif
