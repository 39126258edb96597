// How precise the device's functions are; private to the room, part of platform.h.
#pragma once

#include "study/platform.h"

namespace crosslight::study {

std::vector<FunctionPrecision> measurePrecision(const gpu::Device& device);

}  // namespace crosslight::study
