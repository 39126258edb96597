// What one lane of a subgroup has, for all of them.
#ifndef CROSSLIGHT_LANES_GLSL
#define CROSSLIGHT_LANES_GLSL
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require

uint fromLane(uint value, uint from) { return subgroupShuffle(value, from); }
float fromLane(float value, uint from) { return uintBitsToFloat(subgroupShuffle(floatBitsToUint(value), from)); }
vec3 vectorFromLane(uvec4 texel, uint from) {
  return uintBitsToFloat(uvec3(subgroupShuffle(texel.x, from), subgroupShuffle(texel.y, from), subgroupShuffle(texel.z, from)));
}
#endif
