// Subtrees of up to four primitives, which are most of a tree: every way to part them is tried. Private to the room.
#pragma once

#include "accel/bvh_builder.h"

namespace crosslight::accel {

inline constexpr std::uint32_t kTreeletPrimitives = 4;

// Appends the subtree's nodes to `sink`, below `parent`, and its primitives to plan.order from `first` on. Returns its
// child reference, and its box in `bounds`. 1 to kTreeletPrimitives references.
std::uint32_t buildTreelet(const Plan& plan, std::span<const Reference> references, std::uint32_t first,
                           std::uint32_t depth, std::uint32_t parent, NodeSink& sink, Box& bounds);

}  // namespace crosslight::accel
