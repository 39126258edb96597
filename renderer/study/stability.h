// Runs hard cases and judges them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/catalog.h"

namespace crosslight::study {

enum class Verdict { pass, fail, expectedFail };
const char* nameOf(Verdict verdict);  // as records have it

struct JudgedCase {
  const HardCase* hardCase = nullptr;
  CaseResult result;
  double wallMs = 0;

  Verdict of(const Measurement& m) const;
  Verdict verdict() const;  // the worst of its measurements'
};

// Those whose id or name fits the pattern (as file names on a shell); without a pattern the default set, or all.
std::vector<const HardCase*> casesFor(const std::string& pattern, bool full);
std::vector<const Uncovered*> uncoveredFor(const std::string& pattern);

using CaseProgress = std::function<void(std::uint64_t done, std::uint64_t total)>;
// Ctrl-C is looked for between cases.
std::vector<JudgedCase> runCases(const Bench& bench, const std::vector<const HardCase*>& cases,
                                 const CaseProgress& say);

}  // namespace crosslight::study
