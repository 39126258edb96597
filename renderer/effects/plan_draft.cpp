#include "effects/plan_draft.h"

#include "effects/forced.h"

namespace crosslight {

EffectVerdict PlanDraft::settled(const char* name, bool on, const std::string& reason) const {
  const std::optional<bool> forced = forcedState(settings_, name);
  if (forced == false)
    return on ? EffectVerdict{name, false, "left out because asked: " + reason, true}
              : EffectVerdict{name, false, reason};
  if (on) return {name, true, reason};
  if (forced == true) return {name, true, "compiled in because it was asked for; " + reason};
  if (settings_.allEffects) return {name, true, "compiled in because all effects were asked for; " + reason};
  return {name, false, reason};
}

void PlanDraft::add(Effect effect, const char* name, bool on, const std::string& reason) {
  plan_.verdicts.push_back(settled(name, on, reason));
  if (plan_.verdicts.back().on) plan_.effects |= bitOf(effect);
}

void PlanDraft::addSwitchedOff(Effect effect, const char* name, const std::string& reason) {
  if (forcedState(settings_, name) == true) return add(effect, name, false, reason);
  plan_.verdicts.push_back({name, false, reason});
}

void PlanDraft::addListed(std::uint32_t Plan::*bits, std::uint32_t value, const char* name, bool on,
                          const std::string& reason) {
  plan_.verdicts.push_back(settled(name, on, reason));
  if (plan_.verdicts.back().on) plan_.*bits |= 1u << value;
}

void PlanDraft::promote(Effect effect, const char* name, const std::string& reason) {
  if (has(effect)) return;
  for (EffectVerdict& verdict : plan_.verdicts) {
    if (verdict.name == name) verdict = settled(name, true, reason);
    if (verdict.name == name && verdict.on) plan_.effects |= bitOf(effect);
  }
}

}  // namespace crosslight
