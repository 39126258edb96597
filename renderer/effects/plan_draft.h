// A plan in the making: takes the verdict of each rule, lets what the user forces have the last word, and says so.
#pragma once

#include <string>

#include "effects/effects.h"

namespace crosslight {

class PlanDraft {
 public:
  explicit PlanDraft(const RenderSettings& settings) : settings_(settings) {}

  void add(Effect effect, const char* name, bool on, const std::string& reason);
  // What an option switches off: compiling all effects in does not ask for it, forcing it by its name does.
  void addSwitchedOff(Effect effect, const char* name, const std::string& reason);
  // A row of a list whose bits lie in `bits`.
  void addListed(std::uint32_t Plan::*bits, std::uint32_t value, const char* name, bool on, const std::string& reason);
  // Switches on what a rule has judged off, because of others; what is on keeps its reason.
  void promote(Effect effect, const char* name, const std::string& reason);

  bool has(Effect effect) const { return plan_.has(effect); }
  Plan take() { return std::move(plan_); }

 private:
  EffectVerdict settled(const char* name, bool on, const std::string& reason) const;

  const RenderSettings& settings_;
  Plan plan_;
};

}  // namespace crosslight
