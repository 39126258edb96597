#ifndef CROSSLIGHT_LEAVE_POINT_GLSL
#define CROSSLIGHT_LEAVE_POINT_GLSL
#include "math/numeric.glsl"

// Origin of a ray that leaves the surface towards `direction`: beyond the error bound, on that side. The sum rounds
// once more, hence the last term.
vec3 leavePoint(vec3 position, vec3 error, vec3 ng, vec3 direction) {
  float along = dot(abs(ng), error + gammaBound(2.0) * abs(position));
  return position + (dot(ng, direction) < 0.0 ? -along : along) * ng;
}
#endif
