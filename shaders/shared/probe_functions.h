// What the probes ask the device for: single operations of the shading language, and single functions of the shaders,
// with arguments that the host chooses. Records of both directions.
#ifndef CROSSLIGHT_SHARED_PROBE_FUNCTIONS_H
#define CROSSLIGHT_SHARED_PROBE_FUNCTIONS_H
#include "types.h"

// X(value, name, expression of x, y and z)
#define CL_PROBE_OPERATIONS(X)                     \
  X(0, division, x / y)                            \
  X(1, squareRoot, sqrt(x))                        \
  X(2, inverseSquareRoot, inversesqrt(x))          \
  X(3, exponential, exp(x))                        \
  X(4, exponential2, exp2(x))                      \
  X(5, logarithm, log(x))                          \
  X(6, logarithm2, log2(x))                        \
  X(7, power, pow(x, y))                           \
  X(8, sine, sin(x))                               \
  X(9, cosine, cos(x))                             \
  X(10, tangent, tan(x))                           \
  X(11, arcSine, asin(x))                          \
  X(12, arcCosine, acos(x))                        \
  X(13, arcTangent, atan(x))                       \
  X(14, fused, fma(x, y, z))                       \
  X(15, productAndSum, x* y + z)                   \
  X(16, smallerOf, min(x, y))                      \
  X(17, greaterOf, max(x, y))                      \
  X(18, dotProduct, dot(vec3(x, y, z), vec3(1.0))) \
  X(19, product, x* y)                             \
  X(20, sumAndDifference, (x + y) - x)             \
  X(21, clamped, clamp(x, 0.0, 1.0))               \
  X(22, lengthOf, length(vec3(x, y, z)))           \
  X(23, arcTangent2, atan(x, y))

// X(value, name): each has a function of that name in shaders/probe/functions.comp, which says what its arguments are.
#define CL_PROBE_FUNCTIONS(X) \
  X(0, powerOfCosine)         \
  X(1, unitVector)            \
  X(2, fogged)                \
  X(3, refracted)             \
  X(4, reflectance)           \
  X(5, shape)                 \
  X(6, triangle)              \
  X(7, slabs)                 \
  X(8, mesh)                  \
  X(9, samplePlace)           \
  X(10, mirrored)             \
  X(11, perpendicular)        \
  X(12, sphericalPlace)

CL_SHARED_BEGIN
struct ProbeArguments {
  vec4 a, b, c, d;
};
CL_SIZE(ProbeArguments, 64)
struct ProbeAnswer {
  vec4 a, b;
};
CL_SIZE(ProbeAnswer, 32)
CL_CONST uint kSpecProbe = 64u;   // which function; specialization constant
CL_CONST uint kProbeGroup = 64u;  // invocations of a workgroup
CL_CONST uint kBindProbeArguments = 100u;
CL_CONST uint kBindProbeAnswers = 101u;
CL_CONST uint kBindProbeTriangles = 102u;  // vec3[3 * triangles], of `mesh`
CL_SHARED_END
#endif
