#include "effects/forced.h"

#include "bindings.h"
#include "effects/effects.h"
#include "lists.h"

namespace crosslight {

std::vector<std::string> effectNames() {
#define CL_ROW(value, name, ...) #name,
#define CL_EFFECT_ROW(bit, name) #name,
  return {CL_ILLUMINATION_MODELS(CL_ROW) CL_LIGHT_TYPES(CL_ROW) CL_SHAPE_KINDS(CL_ROW) CL_EFFECTS(CL_EFFECT_ROW)
              CL_MORE_EFFECTS(CL_EFFECT_ROW)};
#undef CL_EFFECT_ROW
#undef CL_ROW
}

std::optional<bool> forcedState(const RenderSettings& settings, const std::string& name) {
  std::optional<bool> state;
  for (const ForcedEffect& forced : settings.forcedEffects) {
    if (forced.name == name) state = forced.on;
  }
  return state;
}

std::uint64_t forcedOnEffects(const RenderSettings& settings) {
  std::uint64_t bits = 0;
#define CL_EFFECT_ROW(bit, name) bits |= forcedState(settings, #name) == true ? bitOf(Effect::name) : 0u;
  CL_EFFECTS(CL_EFFECT_ROW)
  CL_MORE_EFFECTS(CL_EFFECT_ROW)
#undef CL_EFFECT_ROW
  return bits;
}

RenderSettings withForcedSwitches(RenderSettings s) {
  const auto isOff = [&](const char* name) { return forcedState(s, name) == false; };
  if (isOff("shadows")) {
    s.shadows = false;
    s.rasterShadows = RasterShadows::off;
  }
  if (isOff("reflection")) {
    s.reflection = false;
    s.rasterReflections = RasterReflections::off;
  }
  if (isOff("softShadows")) s.lightSamples = 0;
  if (isOff("refraction")) s.refraction = false;
  if (isOff("dispersion")) s.dispersion = Dispersion::off;
  if (isOff("coloredShadows")) s.coloredShadows = false;
  if (isOff("energyCompensation")) s.energyCompensation = false;
  return s;
}

}  // namespace crosslight
