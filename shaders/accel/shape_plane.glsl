// The plane y = 0 and the disk in it. A ray inside the plane misses.
ShapeHit hitPlane(vec4 params, vec3 o, vec3 d, float tMin, float tMax) {
  float t = -o.y / d.y;
  vec3 p = o + t * d;
  ShapeHit hit = kShapeMiss;
  hit.hit = d.y != 0.0 && inRange(t, tMin, tMax);
  hit.t = t;
  hit.p = vec3(p.x, 0.0, p.z);
  hit.n = vec3(0.0, 1.0, 0.0);
  hit.uv = vec2(p.x, -p.z);
  return hit;
}

ShapeHit hitDisk(vec4 params, vec3 o, vec3 d, float tMin, float tMax) {
  float radius = params.x;
  ShapeHit hit = hitPlane(params, o, d, tMin, tMax);
  hit.hit = hit.hit && dot(hit.p.xz, hit.p.xz) <= radius * radius;
  hit.uv = 0.5 + 0.5 * vec2(hit.p.x, -hit.p.z) / radius;
  return hit;
}
