// |p_i| <= size_i / 2. Slabs; the face that bounds the interval gives point and normal.
ShapeHit hitBox(vec4 params, vec3 o, vec3 d, float tMin, float tMax) {
  vec3 halfSize = 0.5 * params.xyz;
  vec3 side = vec3(d.x < 0.0 ? -1.0 : 1.0, d.y < 0.0 ? -1.0 : 1.0, d.z < 0.0 ? -1.0 : 1.0);
  vec3 enter = (-side * halfSize - o) / d;
  vec3 leave = (side * halfSize - o) / d;
  // Parallel to a slab: outside of it nothing is hit, inside it (faces included) it does not bound the interval.
  bvec3 parallel = equal(d, vec3(0.0));
  bvec3 outside = greaterThan(abs(o), halfSize);
  enter = mix(enter, vec3(-kLargest), parallel);
  leave = mix(leave, vec3(kLargest), parallel);
  float low = maxComponent(enter);
  float high = -maxComponent(-leave);
  bool useLow = inRange(low, tMin, tMax);
  ShapeHit hit = kShapeMiss;
  hit.t = useLow ? low : high;
  bool blocked = (parallel.x && outside.x) || (parallel.y && outside.y) || (parallel.z && outside.z);
  hit.hit = !blocked && low <= high && (useLow || inRange(high, tMin, tMax));
  vec3 bound = useLow ? enter : leave;
  vec3 facing = useLow ? -side : side;
  bool isX = bound.x == hit.t;
  bool isY = !isX && bound.y == hit.t;
  vec3 axis = isX ? vec3(1.0, 0.0, 0.0) : (isY ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0));
  vec3 p = clamp(o + hit.t * d, -halfSize, halfSize);
  hit.p = mix(p, facing * halfSize, greaterThan(axis, vec3(0.5)));
  hit.n = facing * axis;
  vec2 across = isX ? p.zy / halfSize.zy : (isY ? p.xz / halfSize.xz : p.xy / halfSize.xy);
  hit.uv = 0.5 + 0.5 * vec2(across.x, -across.y);
  return hit;
}
