// Fog on the segments of the ray tree. A ray that goes straight on continues the segment of its parent, so that fog
// which is no exponential of the distance looks the same as in raster; mirrored and refracted rays begin anew, and what
// they bring is seen through the parent's fog. Inside of refracting bodies there is none.
#ifndef CROSSLIGHT_FOGGED_GLSL
#define CROSSLIGHT_FOGGED_GLSL
#include "shade/fog.glsl"

struct SegmentFog {
  float distance;  // up to the hit, from where the segment began
  Fog fog;
};

// Eye depth is for what the camera sees directly; what mirrors show has none, and goes by the way of the light.
SegmentFog fogAtHit(uint node, RayRecord ray, float t, bool insideBody) {
  float before = 0.0;
  if (kBranches && ray.kind != kRayPrimary) before = nodes[node].travelled;
  float along = isSeenDirectly(ray.kind) && frame.fogByDepth != 0u ? dot(ray.direction, frame.cameraForward) : safeLength(ray.direction);
  float distance = before + t * along;
  Fog fog = fogOver(distance);
  return SegmentFog(distance, insideBody ? Fog(1.0, 0.0) : fog);
}
#endif
