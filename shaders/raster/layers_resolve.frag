#version 460
// The transparent surfaces of a sample over what is opaque there, from the nearest to the farthest; of equal depths the
// first in scene order lies in front. The order in which they were drawn leaves no trace.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/scene_bindings.glsl"
#include "raster/draw.glsl"
#include "raster/layers.glsl"

layout(constant_id = kSpecLoopPasses) const uint specLoopPasses = 0xffffffffu;
layout(location = 0, index = 0) out vec4 outFront;   // premultiplied
layout(location = 0, index = 1) out vec4 outPassed;  // times what is there already

// Found by one walk along the list.
const int kAtOnce = 4;

struct Found {
  float depth;
  uint triangle;
  uint at;
};
const Found kNearest = Found(2.0, 0u, kNoLayer);
const Found kFarthest = Found(-1.0, 0xffffffffu, kNoLayer);

Found found_[kAtOnce];  // in order
vec3 color_ = vec3(0.0), passed_ = vec3(1.0);
float alphaPassed_ = 1.0;

bool liesBefore(Found a, Found b) { return a.depth > b.depth || (a.depth == b.depth && a.triangle < b.triangle); }

void forget() {
  [[unroll]] for (int k = 0; k < kAtOnce; ++k) found_[k] = kFarthest;
}

void insert(Found next) {
  [[unroll]] for (int k = 0; k < kAtOnce; ++k) {
    bool before = liesBefore(next, found_[k]);
    Found later = before ? found_[k] : next;
    found_[k] = before ? next : found_[k];
    next = later;
  }
}

void add(Found found) {
  bool there = found.at != kNoLayer;
  LayerRecord layer = layers[there ? found.at : 0u];
  vec3 through = there ? layer.passed : vec3(1.0);
  color_ += there ? passed_ * layer.color : vec3(0.0);
  passed_ *= through;
  alphaPassed_ *= max(max(through.r, through.g), through.b);
}

// One loop for all walks: Mesa 22.3's llvmpipe leaves an outer loop around them after one round.
void main() {
  uint head = kNoLayer;
  // llvmpipe runs lanes that the picture does not have, and gives them zeros for what they read: a list that begins with
  // the fragment 0, of which 0 is the next. A count of 0 tells them.
  bool kept = layerCounts[kLayersTooMany] == 0u && layerCounts[kLayersWanted] > 0u;
  if (hasList() && kept) head = layerHeads[layerPlace()];
  Found last = kNearest;
  uint at = head, passes = 0u;
  forget();
  while (at != kNoLayer && passes < specLoopPasses) {
    ++passes;
    Found next = Found(layers[at].depth, layers[at].triangle, at);
    if (liesBefore(last, next)) insert(next);
    at = layers[at].next;
    if (at == kNoLayer) {
      [[unroll]] for (int k = 0; k < kAtOnce; ++k) add(found_[k]);
      last = found_[kAtOnce - 1];
      at = last.at == kNoLayer ? kNoLayer : head;
      forget();
    }
  }
  if (passes >= specLoopPasses) layerCounts[kLayersCutShort] = 1u;
  outFront = vec4(color_, 1.0 - alphaPassed_);
  outPassed = vec4(passed_, alphaPassed_);
}
