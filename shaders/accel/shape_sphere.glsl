// |p| = radius. Haines, Guenther, Akenine-Moeller 2019, "Precision Improvements for Ray/Sphere Intersection", Ray
// Tracing Gems ch. 7; the constant term |o|^2 - r^2 in twice the precision, so that origins on a huge sphere count.
ShapeHit hitSphere(vec4 params, vec3 o, vec3 d, float tMin, float tMax) {
  float radius = params.x;
  float a = dot(d, d);
  float b = -dot(o, d);
  vec3 nearest = o + d * (b / a);
  float discriminant = -squaredLengthMinus(nearest, radius);
  if (!(discriminant >= 0.0)) return kShapeMiss;
  float c = squaredLengthMinus(o, radius);
  float q = b + (b < 0.0 ? -1.0 : 1.0) * sqrt(a * discriminant);
  float t0 = c / q;
  float t1 = q / a;
  float low = min(t0, t1);
  float high = max(t0, t1);
  bool useLow = inRange(low, tMin, tMax);
  ShapeHit hit = kShapeMiss;
  hit.hit = useLow || inRange(high, tMin, tMax);
  hit.t = useLow ? low : high;
  float halfChord = sqrt(discriminant / a);
  hit.n = safeNormalize(nearest + (useLow ? -halfChord : halfChord) * d, vec3(0.0, 1.0, 0.0));
  hit.p = radius * hit.n;
  hit.uv = sphericalUv(hit.p, radius);
  return hit;
}
