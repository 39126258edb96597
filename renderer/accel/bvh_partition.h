// Cutting a range of references in two, and keeping their order. Private to the room.
#pragma once

#include "accel/bvh_builder.h"

namespace crosslight::accel {

Box boxOfCenters(std::span<const Reference> references);

// Halves the range by centers along their widest axis, in place; returns the axis. The lower half has the odd one.
std::uint32_t halve(std::span<Reference> references, const Box& centers);

// Two halves of the range by centers, as children of `work`; they stay in its buffer. Returns the axis.
std::uint32_t splitInHalves(const Buffers& buffers, const Work& work, Work (&children)[2]);

// Copies the references of each side to its place, in their order; returns the number of lower ones.
std::size_t scatter(std::span<const Reference> references, const Split& split, Reference* lower, Reference* upper);

// Ranges of the children that a split gives, but for their boxes.
void rangesOf(const Work& work, const Split& split, Work (&children)[2]);

inline bool isUsable(const Work& work, const Split& split) {
  return split.found && fitsDepth(work.depth, std::max(split.lowerCount, work.count - split.lowerCount));
}

}  // namespace crosslight::accel
