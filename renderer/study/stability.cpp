#include "study/stability.h"

#include <fnmatch.h>

#include <algorithm>

#include "base/interrupt.h"
#include "base/time.h"

namespace crosslight::study {
namespace {

bool fits(const std::string& pattern, const char* id, const char* name) {
  return pattern.empty() || fnmatch(pattern.c_str(), id, 0) == 0 || fnmatch(pattern.c_str(), name, 0) == 0;
}

}  // namespace

const char* nameOf(Verdict verdict) {
  return verdict == Verdict::pass ? "pass" : verdict == Verdict::fail ? "fail" : "expected-fail";
}

Verdict JudgedCase::of(const Measurement& m) const {
  if (m.holds()) return Verdict::pass;
  return hardCase->expectedFailure != nullptr ? Verdict::expectedFail : Verdict::fail;
}

Verdict JudgedCase::verdict() const {
  Verdict worst = result.measurements().empty() ? Verdict::fail : Verdict::pass;
  for (const Measurement& m : result.measurements()) {
    if (of(m) != Verdict::pass) worst = of(m);
  }
  return worst;
}

std::vector<const HardCase*> casesFor(const std::string& pattern, bool full) {
  std::vector<const HardCase*> cases;
  for (const HardCase& c : hardCases()) {
    const bool wanted = full || c.inDefault || !pattern.empty();
    if (wanted && fits(pattern, c.id, c.name)) cases.push_back(&c);
  }
  return cases;
}

std::vector<const Uncovered*> uncoveredFor(const std::string& pattern) {
  std::vector<const Uncovered*> cases;
  for (const Uncovered& c : uncoveredCases()) {
    if (fits(pattern, c.id, c.name)) cases.push_back(&c);
  }
  return cases;
}

std::vector<JudgedCase> runCases(const Bench& bench, const std::vector<const HardCase*>& cases,
                                 const CaseProgress& say) {
  std::vector<JudgedCase> judged;
  for (const HardCase* c : cases) {
    throwIfInterrupted();
    if (say) say(judged.size(), cases.size());
    const Stopwatch watch;
    JudgedCase& one = judged.emplace_back();
    one.hardCase = c;
    c->run(bench, one.result);
    one.wallMs = watch.elapsedMs();
  }
  if (say) say(cases.size(), cases.size());
  return judged;
}

}  // namespace crosslight::study
