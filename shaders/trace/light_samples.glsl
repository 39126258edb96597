// What kernels share that send several rays from a hit to one light.
#ifndef CROSSLIGHT_LIGHT_SAMPLES_GLSL
#define CROSSLIGHT_LIGHT_SAMPLES_GLSL

const uint kEnvironmentLight = 0xffffffffu;  // instead of a light's index

struct SampledPoint {
  bool hit;
  HitSurface h;
  SurfacePoint s;
  vec3 wo;
  uint place;  // the pixel of a camera's ray, the bits of where others end
};

SampledPoint sampledPoint(uint ray) {
  uint node = pushed.firstNode + ray;
  HitRecord hit = hitOf(node);
  CameraPlace at = cameraPlace(ray);
  RayRecord record = rayOfNode(node, at);
  SampledPoint p;
  p.hit = hit.primitive != kNoHit;
  if (!p.hit) hit.primitive = CL_HAS(triangles) ? 0u : kHitShape;  // something that is there; nobody asks for it
  p.h = surfaceOfHit(hit, rayOf(record), !goesStraight(record.kind));
  // Of the way from the camera only the last part is known here: textures are read at most too sharp, for a weight.
  p.s = pointOfHit(p.h, record, wayOf(record, hit.t));
  p.wo = towardsViewer(record, p.s.position);
  bool camera = !kBranches || record.kind == kRayPrimary;
  uint pixel = (pushed.firstRow + at.at.y) * frame.resolution.x + at.at.x;
  p.place = camera ? hashOf(pixel) : hashOf(floatBitsToUint(p.s.position));
  return p;
}

// The same numbers in every sample of a pixel, moved on by the sample's index.
uint scrambleOf(SampledPoint p, uint light) { return hashOf(p.place ^ hashOf(light, frame.sampleSeed)); }

// What a direction would bring, colors averaged.
float unshadowed(SurfacePoint s, vec3 wo, vec3 wi, LightRecord light) {
  ShadedParts parts = compose(s, lobeSums(light, evaluateModel(s, wo, wi)), vec3(0.0));
  return dot(parts.diffuse + parts.specular, vec3(1.0 / 3.0));
}

LightRecord blackLight() {
  LightRecord light;
  light.diffuse = vec3(0.0);
  light.specular = vec3(0.0);
  return light;
}
#endif
