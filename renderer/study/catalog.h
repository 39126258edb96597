// The catalog of numerically hard cases: those that are run, those that have no feature to run on, those not covered.
#pragma once

#include <string>
#include <vector>

#include "study/hard_case.h"

namespace crosslight::study {

const std::vector<HardCase>& hardCases();

// Of the catalog, without a case.
struct Uncovered {
  const char* id;
  const char* name;
  // Why it cannot be run here; null: it could, but is not written yet.
  const char* notApplicable;
};
const std::vector<Uncovered>& uncoveredCases();

}  // namespace crosslight::study
