#ifndef CROSSLIGHT_RAY_GLSL
#define CROSSLIGHT_RAY_GLSL

struct Ray {
  vec3 origin;
  vec3 direction;
  float tMin;
  float tMax;
  uint from;  // slot of the triangle that the ray leaves, which it cannot meet again; kNoHit: none
};

Ray rayOf(RayRecord r) { return Ray(r.origin, r.direction, r.tMin, r.tMax, r.from); }
#endif
