// Axis y, |y| <= height / 2, closed by two disks. The solid is convex: the hit is where the interval of the infinite
// cylinder and that of the slab between the disks, intersected, begins or ends.
ShapeHit hitCylinder(vec4 params, vec3 o, vec3 d, float tMin, float tMax) {
  float radius = params.x;
  float halfHeight = 0.5 * params.y;
  float shift = recenter(o, d);
  float a = dot(d.xz, d.xz);
  float c = squaredLengthMinus(vec3(o.x, 0.0, o.z), radius);
  Roots wall = solveQuadratic(a, -dot(o.xz, d.xz), c);
  bool alongAxis = a == 0.0;
  if (alongAxis ? c > 0.0 : !wall.real) return kShapeMiss;
  float wallLow = alongAxis ? -kLargest : wall.low;
  float wallHigh = alongAxis ? kLargest : wall.high;
  float up = d.y < 0.0 ? -1.0 : 1.0;
  bool level = d.y == 0.0;
  if (level && abs(o.y) > halfHeight) return kShapeMiss;
  float capLow = level ? -kLargest : (-up * halfHeight - o.y) / d.y;
  float capHigh = level ? kLargest : (up * halfHeight - o.y) / d.y;
  float low = max(wallLow, capLow);
  float high = min(wallHigh, capHigh);
  bool useLow = inRange(low + shift, tMin, tMax);
  ShapeHit hit = kShapeMiss;
  hit.t = (useLow ? low : high) + shift;
  hit.hit = low <= high && (useLow || inRange(high + shift, tMin, tMax));
  bool onCap = useLow ? capLow >= wallLow : capHigh <= wallHigh;
  float capSign = useLow ? -up : up;
  vec3 p = o + (useLow ? low : high) * d;
  vec2 radial = p.xz / max(length(p.xz), 1.0 / kLargest);
  hit.p = onCap ? vec3(p.x, capSign * halfHeight, p.z)
                : vec3(radius * radial.x, clamp(p.y, -halfHeight, halfHeight), radius * radial.y);
  hit.n = onCap ? vec3(0.0, capSign, 0.0) : vec3(radial.x, 0.0, radial.y);
  float longitude = (p.x == 0.0 && p.z == 0.0) ? 0.0 : atan(p.z, p.x);
  hit.uv = onCap ? 0.5 + 0.5 * p.xz / radius : vec2(0.5 + longitude / (2.0 * kPi), 0.5 - 0.5 * p.y / halfHeight);
  return hit;
}
