// Ray against triangle, watertight: Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection", JCGT 2(1).
// Shared edges are evaluated with the same operands on both sides, and zero counts as inside, so no ray slips through.
#ifndef CROSSLIGHT_ACCEL_TRIANGLE_GLSL
#define CROSSLIGHT_ACCEL_TRIANGLE_GLSL

// What depends on the ray alone: the axis of its largest component, and the shear that makes it the z axis.
struct RayShear {
  uint axis;
  vec3 shear;  // Sx, Sy, Sz of the paper
};

// Cyclic rotation that puts component `axis` last; cyclic keeps the winding.
vec3 rotateToLast(vec3 v, uint axis) { return axis == 0u ? v.yzx : (axis == 1u ? v.zxy : v.xyz); }

RayShear shearOf(vec3 direction) {
  vec3 a = abs(direction);
  uint axis = a.x > a.y && a.x > a.z ? 0u : (a.y > a.z ? 1u : 2u);
  vec3 d = rotateToLast(direction, axis);
  return RayShear(axis, vec3(d.xy / d.z, 1.0 / d.z));
}

struct TriangleHit {
  bool hit;
  float t;
  float b1;
  float b2;
  bool back;  // the ray meets the side on which the corners run clockwise
};

// Corners relative to the ray's origin and rotated already: packets whose rays share the axis rotate once for all.
TriangleHit hitRotated(vec3 a, vec3 b, vec3 c, vec3 shear, float tMin, float tMax) {
  precise vec2 pa = a.xy - shear.xy * a.z;
  precise vec2 pb = b.xy - shear.xy * b.z;
  precise vec2 pc = c.xy - shear.xy * c.z;
  precise float u = pc.x * pb.y - pc.y * pb.x;
  precise float v = pa.x * pc.y - pa.y * pc.x;
  precise float w = pb.x * pa.y - pb.y * pa.x;
  float det = u + v + w;
  bool inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
  float inverse = 1.0 / det;
  float t = (u * a.z + v * b.z + w * c.z) * shear.z * inverse;
  TriangleHit result;
  result.hit = inside && det != 0.0 && t > tMin && t <= tMax;
  result.t = t;
  result.b1 = v * inverse;
  result.b2 = w * inverse;
  // Seen along +z a counter-clockwise triangle has det > 0; seen along -z the projection is mirrored.
  result.back = (det > 0.0) != (shear.z > 0.0);
  return result;
}

TriangleHit hitTriangle(vec3 origin, RayShear ray, vec3 v0, vec3 v1, vec3 v2, float tMin, float tMax) {
  return hitRotated(rotateToLast(v0 - origin, ray.axis), rotateToLast(v1 - origin, ray.axis),
                    rotateToLast(v2 - origin, ray.axis), ray.shear, tMin, tMax);
}
#endif
