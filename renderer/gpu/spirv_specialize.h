// SPIR-V with the values of its specialization constants put in, and without what then never runs. Private to this
// room.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/pipeline.h"

namespace crosslight::gpu {

// A module that does the same as `module` does with `constants`. Branches that are not taken and functions that are not
// called are left out, and names; arithmetic is not touched. A module with integers of other sizes than 32 bits, or
// with decorations by group, comes back as it was.
std::vector<std::uint32_t> specialized(std::span<const std::uint32_t> module, const Constants& constants);

}  // namespace crosslight::gpu
