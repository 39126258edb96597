// Roots of a t^2 - 2 b t + c = 0 without cancellation between b and the discriminant's root.
#ifndef CROSSLIGHT_QUADRATIC_GLSL
#define CROSSLIGHT_QUADRATIC_GLSL

struct Roots {
  bool real;
  float low;
  float high;
};

// Press et al. 2007, "Numerical Recipes", Eq. 5.6.4. With a == 0 the one root of the linear equation stands twice.
Roots solveQuadratic(float a, float b, float c) {
  float discriminant = differenceOfProducts(b, b, a, c);
  float root = sqrt(max(discriminant, 0.0));
  float q = b + (b < 0.0 ? -root : root);
  float linear = c / (2.0 * b);
  float t0 = a == 0.0 ? linear : q / a;
  float t1 = (a == 0.0 || q == 0.0) ? t0 : c / q;
  return Roots(discriminant >= 0.0 && (a != 0.0 || b != 0.0), min(t0, t1), max(t0, t1));
}
#endif
