#version 460
// The largest standard error of a channel's mean in each tile of 8 x 8 pixels, from the deviations of the samples from
// the first one: sqrt((sum d^2 - (sum d)^2 / n) / (n (n - 1))). Exactly zero where all samples are the same. Samples are
// taken as independent; those of a net are spread more evenly, so the error is overestimated.
#extension GL_GOOGLE_include_directive : require
#include "shared/entry.glsl"
#include "shared/structs.h"
#include "shared/bindings.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform PushBlock { FilmPush pushed; };
layout(set = 0, binding = kBindTileErrors, scalar) writeonly buffer TileErrorBlock { float tileErrors[]; };
layout(set = 0, binding = kBindMoments, scalar) readonly buffer MomentBlock { PixelMoments moments[]; };

shared float largest[64];

// What is not finite is counted elsewhere; more samples would not mend it.
float errorOf(PixelMoments m) {
  float n = float(pushed.samples);
  vec3 squares = max(m.squares - m.sum * m.sum / n, vec3(0.0)) / (n * (n - 1.0));
  float most = max(squares.r, max(squares.g, squares.b));
  return most < 3.0e38 ? sqrt(most) : 0.0;
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint across = (pushed.width + kTileSize - 1u) / kTileSize;
  uint tile = gl_WorkGroupID.x;
  uint x = kTileSize * (tile % across) + lane % kTileSize;
  uint pixel = (kTileSize * (tile / across) + lane / kTileSize) * pushed.width + x;
  float error = 0.0;
  if (x < pushed.width && pixel < pushed.pixelCount) error = errorOf(moments[pixel]);
  largest[lane] = error;
  barrier();
  for (uint reach = 32u; reach > 0u; reach /= 2u) {
    if (lane < reach) largest[lane] = max(largest[lane], largest[lane + reach]);
    barrier();
  }
  if (lane == 0u) tileErrors[tile] = largest[0];
}
