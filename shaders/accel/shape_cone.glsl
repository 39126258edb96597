// Axis y: radius at y = -height/2, apex at y = +height/2, closed by a disk. The wall is x^2 + z^2 = k^2 (apex - y)^2.
// Candidates are the wall's two roots (on the lower nappe only) and the base; the nearest in range wins.
void considerConeWall(float t, float shift, vec3 o, vec3 d, float k, float halfHeight, float tMin, float tMax,
                      inout ShapeHit best) {
  vec3 p = o + t * d;
  bool better = inRange(t + shift, tMin, tMax) && p.y <= halfHeight && p.y >= -halfHeight &&
                (!best.hit || t + shift < best.t);
  if (!better) return;
  float radius = k * (halfHeight - p.y);
  vec2 radial = p.xz / max(length(p.xz), 1.0 / kLargest);
  float longitude = (p.x == 0.0 && p.z == 0.0) ? 0.0 : atan(p.z, p.x);
  best.hit = true;
  best.t = t + shift;
  best.p = vec3(radius * radial.x, p.y, radius * radial.y);
  best.n = vec3(radial.x, k, radial.y);
  best.uv = vec2(0.5 + longitude / (2.0 * kPi), 0.5 - 0.5 * p.y / halfHeight);
}

ShapeHit hitCone(vec4 params, vec3 o, vec3 d, float tMin, float tMax) {
  float halfHeight = 0.5 * params.y;
  float k = params.x / params.y;
  float shift = recenter(o, d);
  float fromApex = halfHeight - o.y;
  float a = dot(d.xz, d.xz) - k * k * d.y * d.y;
  float b = -(dot(o.xz, d.xz) + k * k * fromApex * d.y);
  float c = dot(o.xz, o.xz) - k * k * fromApex * fromApex;
  Roots wall = solveQuadratic(a, b, c);
  ShapeHit best = kShapeMiss;
  if (wall.real) {
    considerConeWall(wall.low, shift, o, d, k, halfHeight, tMin, tMax, best);
    considerConeWall(wall.high, shift, o, d, k, halfHeight, tMin, tMax, best);
  }
  float t = (-halfHeight - o.y) / d.y;
  vec3 p = o + t * d;
  bool onBase = d.y != 0.0 && dot(p.xz, p.xz) <= params.x * params.x && inRange(t + shift, tMin, tMax) &&
                (!best.hit || t + shift < best.t);
  if (onBase) {
    best.hit = true;
    best.t = t + shift;
    best.p = vec3(p.x, -halfHeight, p.z);
    best.n = vec3(0.0, -1.0, 0.0);
    best.uv = 0.5 + 0.5 * p.xz / params.x;
  }
  return best;
}
