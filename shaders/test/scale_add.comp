// out[i] = factor * in[i] + summand + texel, for the tests of the gpu room.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint kFactor = 1u;
layout(set = 0, binding = 0, scalar) readonly buffer In { uint inValues[]; };
layout(set = 0, binding = 1, scalar) buffer Out { uint outValues[]; };
layout(set = 0, binding = 2) uniform samplerBuffer floats;
layout(set = 0, binding = 3) uniform usamplerBuffer uints;
layout(set = 0, binding = 4, scalar) uniform Offset { uint uniformSummand; };
layout(push_constant, scalar) uniform Push {
  uint count;
  uint summand;
};

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  const uint texels = uint(texelFetch(floats, int(i)).w) + texelFetch(uints, int(i)).y;
  outValues[i] = kFactor * inValues[i] + summand + texels + uniformSummand;
}
