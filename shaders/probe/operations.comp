#version 460
// One operation of the language on arguments that the host chooses: what the device makes of sqrt(), pow(), min(NaN) ...
#extension GL_GOOGLE_include_directive : require
#include "shared/entry.glsl"
#include "shared/probe_functions.h"

layout(local_size_x = 64) in;
layout(constant_id = kSpecProbe) const uint specProbe = 0u;
layout(set = 0, binding = kBindProbeArguments, scalar) readonly buffer ArgumentBlock { vec3 arguments[]; };
layout(set = 0, binding = kBindProbeAnswers, scalar) buffer AnswerBlock { float answers[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(arguments.length())) return;
  float x = arguments[i].x;
  float y = arguments[i].y;
  float z = arguments[i].z;
#define CL_OPERATION(value, name, expression) \
  if (specProbe == value) answers[i] = expression;
  CL_PROBE_OPERATIONS(CL_OPERATION)
#undef CL_OPERATION
}
