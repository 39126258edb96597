// Axis y, R the radius of the center circle, r that of the tube: f(p) = (|p|^2 + R^2 - r^2)^2 - 4 R^2 (x^2 + z^2) = 0.
// The quartic is formed at the ray's closest approach and solved by bracketing: the roots of each derivative separate
// those of the polynomial above it, so no root is lost; a bisection safeguards Newton's step inside each bracket.

const int kTorusSteps = 40;  // bisection alone halves a bracket to rounding within 24 + its binary exponent's range

float horner(float c[5], int degree, float x) {
  float y = c[4];
  if (degree < 4) y = 0.0;
  for (int i = 3; i >= 0; --i) y = i > degree ? 0.0 : y * x + c[i];
  return y;
}

// Root of the monotone piece of the polynomial on [low, high] whose end values differ in sign.
float rootBetween(float c[5], float dc[5], int degree, float low, float high, float valueLow) {
  float x = 0.5 * (low + high);
  for (int step = 0; step < kTorusSteps; ++step) {
    float y = horner(c, degree, x);
    bool sameSide = (y < 0.0) == (valueLow < 0.0);
    low = sameSide ? x : low;
    high = sameSide ? high : x;
    float newton = x - y / horner(dc, degree - 1, x);
    x = newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  return x;
}

// All roots in [low, high] of the polynomial c of `degree`, given its derivative's roots in ascending order.
void rootsFromExtrema(float c[5], float dc[5], int degree, float extrema[4], int extremaCount, float low, float high,
                      out float roots[4], out int count) {
  roots = float[4](0.0, 0.0, 0.0, 0.0);
  count = 0;
  float left = low;
  float valueLeft = horner(c, degree, left);
  for (int i = 0; i <= extremaCount && i < 4; ++i) {
    float right = i < extremaCount ? extrema[i] : high;
    float valueRight = horner(c, degree, right);
    bool crosses = (valueLeft < 0.0) != (valueRight < 0.0);
    if (crosses && count < 4) {
      roots[count] = rootBetween(c, dc, degree, left, right, valueLeft);
      ++count;
    }
    left = right;
    valueLeft = valueRight;
  }
}

void derivativeOf(float c[5], out float dc[5]) { dc = float[5](c[1], 2.0 * c[2], 3.0 * c[3], 4.0 * c[4], 0.0); }

// Quartic in the distance s from the closest approach, along the unit direction e; lengths in units of R.
void torusQuartic(vec3 o, vec3 e, float ratio, out float c[5]) {
  float g = dot(o, o) + 1.0 - ratio * ratio;  // o.e = 0 up to rounding, but the term is kept
  float h = dot(o, e);
  c[4] = 1.0;
  c[3] = 4.0 * h;
  c[2] = 2.0 * g + 4.0 * h * h - 4.0 * dot(e.xz, e.xz);
  c[1] = 4.0 * g * h - 8.0 * dot(o.xz, e.xz);
  c[0] = g * g - 4.0 * dot(o.xz, o.xz);
}

void torusRoots(float c[5], float reach, out float roots[4], out int count) {
  float d1[5];
  float d2[5];
  float d3[5];
  derivativeOf(c, d1);
  derivativeOf(d1, d2);
  derivativeOf(d2, d3);
  Roots inflections = solveQuadratic(d2[2], -0.5 * d2[1], d2[0]);
  float r2[4] = float[4](inflections.low, inflections.high, 0.0, 0.0);
  int n2 = inflections.real ? 2 : 0;
  float r1[4];
  int n1;
  rootsFromExtrema(d1, d2, 3, r2, n2, -reach, reach, r1, n1);
  rootsFromExtrema(c, d1, 4, r1, n1, -reach, reach, roots, count);
}

ShapeHit hitTorus(vec4 params, vec3 o, vec3 d, float tMin, float tMax) {
  float R = params.x;
  float r = params.y;
  float len = length(d);
  vec3 e = d / len;
  float shift = recenter(o, d);
  o /= R;
  float ratio = r / R;
  float outer = 1.0 + ratio;
  float reachSquared = outer * outer - dot(o, o);
  ShapeHit hit = kShapeMiss;
  if (!(reachSquared > 0.0)) return hit;
  // The chord through the bounding sphere, a little longer: the ends are outside of the torus for sure.
  float reach = sqrt(reachSquared) * (1.0 + 16.0 * kUnitRoundoff) + 16.0 * kUnitRoundoff;
  float c[5];
  torusQuartic(o, e, ratio, c);
  float roots[4];
  int count;
  torusRoots(c, reach, roots, count);
  for (int i = 0; i < 4; ++i) {
    float t = shift + roots[i] * R / len;
    bool better = i < count && inRange(t, tMin, tMax) && (!hit.hit || t < hit.t);
    if (better) {
      hit.hit = true;
      hit.t = t;
      vec3 p = o + roots[i] * e;
      vec2 ring = p.xz / max(length(p.xz), 1.0 / kLargest);
      vec3 center = vec3(ring.x, 0.0, ring.y);
      hit.n = safeNormalize(p - center, vec3(0.0, 1.0, 0.0));
      hit.p = R * center + r * hit.n;
      float around = atan(ring.y, ring.x);
      float across = atan(hit.n.y, dot(hit.n.xz, ring));
      hit.uv = 0.5 + vec2(around, across) / (2.0 * kPi);
    }
  }
  return hit;
}
