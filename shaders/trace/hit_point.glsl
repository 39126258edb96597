// The surface at a hit as the ray's viewer sees it: material, textures and layers, for every kernel that lights hits.
#ifndef CROSSLIGHT_HIT_POINT_GLSL
#define CROSSLIGHT_HIT_POINT_GLSL
#include "trace/viewer.glsl"

// Length of a ray's way to its hit: of what the camera sees directly the depth along the view, as in raster, else that
// of the light's way.
float wayOf(RayRecord ray, float t) {
  if (!kBranches || ray.kind == kRayPrimary) return t;
  return t * (isSeenDirectly(ray.kind) ? dot(ray.direction, frame.cameraForward) : length(ray.direction));
}

// `path`: length of the light's way from the camera to the hit.
SurfacePoint pointOfHit(inout HitSurface h, RayRecord ray, float path) {
  if (kPlacesTextures) {
    vec3 direction = safeNormalize(ray.direction, vec3(0.0));
    placeTextures(h.uv, pixelWidthAtCamera() + path * pixelSpread(), direction, h.at.geometricNormal, h.at);
  }
  SurfacePoint s = surfaceAt(h.at);
  if (kHasLayers) s = seenFrom(s, towardsViewer(ray, s.position));
  return s;
}
#endif
