// A run of hard cases as tables for people and as JSON.
#pragma once

#include <string>
#include <vector>

#include "app/record.h"
#include "study/platform.h"
#include "study/stability.h"

namespace crosslight {

std::string platformTable(const study::Platform& platform);
Json platformJson(const study::Platform& platform);

std::string casesTable(const std::vector<study::JudgedCase>& cases);
std::string uncoveredTable(const std::vector<const study::Uncovered*>& uncovered);
// One entry per figure: a case by each of its techniques.
Json casesJson(const std::vector<study::JudgedCase>& cases, const std::vector<const study::Uncovered*>& uncovered);
Json notCoveredJson(const std::vector<const study::Uncovered*>& uncovered);

}  // namespace crosslight
