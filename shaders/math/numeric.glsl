// Constants and the numerically careful helpers; each has a double-precision twin in tests.
#ifndef CROSSLIGHT_NUMERIC_GLSL
#define CROSSLIGHT_NUMERIC_GLSL

const float kPi = 3.14159265358979323846;
const float kUnitRoundoff = 5.9604644775390625e-8;  // u = 2^-24
const float kLargest = 3.0e38;

// Higham 2002, "Accuracy and Stability of Numerical Algorithms", Lemma 3.1: n roundings accumulate to at most gamma_n.
float gammaBound(float n) { return n * kUnitRoundoff / (1.0 - n * kUnitRoundoff); }

// a at 0, b at 1. mix() may be computed in either of two ways, chosen by what stands around it; this may not.
vec3 interpolate(vec3 a, vec3 b, float t) { return a + (b - a) * t; }
vec4 interpolate(vec4 a, vec4 b, float t) { return a + (b - a) * t; }

// max() and min() say what becomes of NaN, and pay for it on llvmpipe; here the second operand stands in for a NaN.
float greater(float a, float b) { return a > b ? a : b; }
float smaller(float a, float b) { return a < b ? a : b; }
vec3 greater(vec3 a, vec3 b) { return vec3(greater(a.x, b.x), greater(a.y, b.y), greater(a.z, b.z)); }
vec3 smaller(vec3 a, vec3 b) { return vec3(smaller(a.x, b.x), smaller(a.y, b.y), smaller(a.z, b.z)); }

float maxComponent(vec3 v) { return max(max(v.x, v.y), v.z); }

// Unit vector of any finite, nonzero v; `fallback` for zero, infinite or NaN. Scaled first, so that squares neither
// overflow nor vanish.
vec3 safeNormalize(vec3 v, vec3 fallback) {
  float m = maxComponent(abs(v));
  vec3 scaled = v / m;
  return (m > 0.0 && m < kLargest) ? scaled * inversesqrt(dot(scaled, scaled)) : fallback;
}

// Length of any finite vector, without overflow on the way.
float safeLength(vec3 v) {
  float m = maxComponent(abs(v));
  vec3 scaled = v / m;
  return m > 0.0 ? m * sqrt(dot(scaled, scaled)) : 0.0;
}

// log(1 - h) for h in [0, 1). The series (to h^5) is within 2e-8 relative below 1/32, where log() itself would cancel.
float logOneMinus(float h) {
  float series = -h * (1.0 + h * (0.5 + h * (0.33333333 + h * (0.25 + h * 0.2))));
  return h < 0.03125 ? series : log(1.0 - h);
}

// 1 - exp(-x) for x >= 0. The series (to x^7) is within 1e-7 relative below 0.25, where the difference would cancel.
float oneMinusExp(float x) {
  float series = 1.0 - x * 0.2 * (1.0 - x * 0.16666667 * (1.0 - x * 0.14285714));
  series = x * (1.0 - x * 0.5 * (1.0 - x * 0.33333333 * (1.0 - x * 0.25 * series)));
  return x < 0.25 ? series : 1.0 - exp(-x);
}

// max(a.b, 0)^n for unit a, b and n >= 0, with 0^0 = 1 for a.b > 0 only. Written as exp(n log(1 - |a-b|^2 / 2)):
// pow(dot(a, b), n) loses n ulp of the cosine, this keeps the absolute error below 1e-6 for every n.
float powerOfCosine(vec3 a, vec3 b, float n) {
  vec3 d = a - b;
  float h = min(0.5 * dot(d, d), 0.99999994);
  float lobe = n == 0.0 ? 1.0 : exp(n * logOneMinus(h));
  return dot(a, b) > 0.0 ? lobe : 0.0;
}

// Error-free product (Dekker 1971, "A Floating-Point Technique for Extending the Available Precision"): x + y == a * b
// exactly while |a|, |b| < 2^115. `precise`, because compilers may reassociate otherwise; no fma, because it may be unfused.
vec2 twoProduct(float a, float b) {
  precise float p = a * b;
  precise float ca = 4097.0 * a;
  precise float ah = ca - (ca - a);
  precise float al = a - ah;
  precise float cb = 4097.0 * b;
  precise float bh = cb - (cb - b);
  precise float bl = b - bh;
  precise float e = ((ah * bh - p) + ah * bl + al * bh) + al * bl;
  return vec2(p, e);
}

// Error-free sum (Knuth 1969, TAOCP vol. 2, 4.2.2 Theorem B).
vec2 twoSum(float a, float b) {
  precise float s = a + b;
  precise float bb = s - a;
  precise float e = (a - (s - bb)) + (b - bb);
  return vec2(s, e);
}

// a b - c d within 0.5 ulp or so (Kahan; Jeannerod, Louvet, Muller 2013).
float differenceOfProducts(float a, float b, float c, float d) {
  vec2 p = twoProduct(a, b);
  vec2 q = twoProduct(c, d);
  precise float s = p.x - q.x;
  precise float e = p.y - q.y;
  precise float r = s + e;
  return r;
}

// v.v - r^2 as if computed in twice the precision (Ogita, Rump, Oishi 2005, "Accurate Sum and Dot Product", Alg. 5.3).
float squaredLengthMinus(vec3 v, float r) {
  vec2 x = twoProduct(v.x, v.x);
  vec2 y = twoProduct(v.y, v.y);
  vec2 z = twoProduct(v.z, v.z);
  vec2 w = twoProduct(r, r);
  vec2 s1 = twoSum(x.x, -w.x);
  vec2 s2 = twoSum(s1.x, y.x);
  vec2 s3 = twoSum(s2.x, z.x);
  precise float e = ((x.y - w.y) + y.y + z.y) + (s1.y + s2.y + s3.y);
  precise float r2 = s3.x + e;
  return r2;
}

bool isFinite3(vec3 v) { return !(any(isnan(v)) || any(isinf(v))); }
#endif
