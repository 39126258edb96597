// Rules on light: its types, and whether shadows are looked for.
#include <fmt/format.h>

#include <algorithm>

#include "effects/analysis.h"
#include "effects/shadow_reach.h"

namespace crosslight {
namespace {

void types(Analysis& a) {
  const auto add = [&](std::uint32_t value, const char* name, LightType type) {
    a.addFirst(&Plan::lights, value, name, "light", a.scene.lights, [&](const Light& l) { return l.type == type; });
  };
#define CL_ROW(value, name, ...) add(value, #name, LightType::name);
  CL_LIGHT_TYPES(CL_ROW)
#undef CL_ROW
}

void shadows(Analysis& a) {
  const RenderSettings& s = a.settings;
  const auto add = [&](bool on, const std::string& reason) { a.draft.add(Effect::shadows, "shadows", on, reason); };
  if (s.method == Method::wireframe) return add(false, "edges are not lit");
  if (a.traced && !s.shadows) return a.draft.addSwitchedOff(Effect::shadows, "shadows", "switched off");
  if (!a.traced && s.rasterShadows == RasterShadows::off)
    return add(false, "raster shows no shadows; --set raster-shadows=rays or maps does");
  const bool around = a.traced && a.scene.atmosphere.environment.present();
  const bool lit = !a.scene.lights.empty() || around;
  if (!lit) return add(false, "the scene has no light");
  a.lightShadows = shadowsOfLights(a.scene, s, a.uses);
  const auto first =
      std::find_if(a.lightShadows.begin(), a.lightShadows.end(), [](const auto& l) { return l.shadows; });
  if (first != a.lightShadows.end()) return add(true, first->reason);
  if (around) return add(true, "the environment casts shadows");
  add(false, a.lightShadows.size() == 1 ? a.lightShadows.front().reason
                                        : "no caster between any light and any surface that it lights");
}

void softShadows(Analysis& a) {
  const RenderSettings& s = a.settings;
  if (a.traced && !s.shadows) return a.draft.addSwitchedOff(Effect::softShadows, "softShadows", "switched off");
  const auto found = std::find_if(a.scene.lights.begin(), a.scene.lights.end(), isArea);
  const bool area = found != a.scene.lights.end();
  const bool around = a.scene.atmosphere.environment.present();
  const bool cast = a.draft.has(Effect::shadows);
  const bool on = a.traced && cast && s.lightSamples > 0 && (area || around);
  const auto index = static_cast<std::size_t>(found - a.scene.lights.begin());
  const std::string who =
      area ? quoted("light", found->name, index) + " has an area" : "the environment shines from all around";
  a.draft.add(Effect::softShadows, "softShadows", on,
              !a.traced          ? "raster methods cast shadows from a light's middle"
              : !cast            ? "no shadows are looked for"
              : !area && !around ? "no light has an area, and there is no environment"
              : !s.lightSamples  ? "switched off: lights with an area cast shadows from their middle"
                                 : fmt::format("{}, {} rays to it", who, s.lightSamples));
}

}  // namespace

void judgeLights(Analysis& a) {
  types(a);
  shadows(a);
  softShadows(a);
}

}  // namespace crosslight
