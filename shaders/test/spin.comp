// Counts as long as the host says, in two nested loops, so that a wait can time out; no driver can fold the loops away.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 1) in;
layout(set = 0, binding = 0, scalar) buffer State { uint state; };
layout(push_constant) uniform Push {
  uint outerRounds;
  uint innerRounds;
};

void main() {
  uint x = state | 1u;
  for (uint i = 0u; i < outerRounds; ++i) {
    for (uint k = 0u; k < innerRounds; ++k) x = x * 1664525u + (x >> 13);
  }
  state = x;
}
