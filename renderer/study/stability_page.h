// A run of hard cases as one HTML page that needs no other file: figures, pictures, plain words.
#pragma once

#include <string>
#include <vector>

#include "study/platform.h"
#include "study/stability.h"

namespace crosslight::study {

// `device`: what the cases ran on, in words.
std::string stabilityPage(const std::string& device, const Platform& platform, const std::vector<JudgedCase>& cases,
                          const std::vector<const Uncovered*>& uncovered);

}  // namespace crosslight::study
