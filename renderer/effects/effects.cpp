// The order of the rules, and promotion: what one effect implies of another.
#include "effects/effects.h"

#include <fmt/format.h>

#include <algorithm>

#include "effects/analysis.h"
#include "structs.h"

namespace crosslight {
namespace {

// Mirrored and refracted rays meet surfaces from behind, which must then be lit from behind.
void promote(Analysis& analysis) {
  PlanDraft& draft = analysis.draft;
  const bool secondary = analysis.traced && (draft.has(Effect::reflection) || draft.has(Effect::refraction));
  if (secondary) draft.promote(Effect::twoSided, "twoSided", "mirrored and refracted rays meet surfaces from behind");
}

}  // namespace

std::string quoted(const std::string& kind, const std::string& name, std::size_t index) {
  return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} '{}'", kind, name);
}

Analysis::Analysis(const Scene& s, const RenderSettings& set)
    : scene(s), settings(set), traced(set.method == Method::whitted), uses(usesOf(s, set)), draft(set) {}

const Material& Analysis::materialOf(const SurfaceUse& use) const {
  return scene.materials[static_cast<std::size_t>(use.material)];
}

const SurfaceUse* Analysis::firstUse(const MaterialTest& test) const {
  const auto found =
      std::find_if(uses.begin(), uses.end(), [&](const SurfaceUse& use) { return test(materialOf(use)); });
  return found == uses.end() ? nullptr : &*found;
}

std::string Analysis::describe(const SurfaceUse& use) const {
  return quoted("material", materialOf(use).name, static_cast<std::size_t>(use.material));
}

void Analysis::addByMaterial(const MaterialRule& rule) {
  const SurfaceUse* who = firstUse(rule.test);
  draft.add(rule.effect, rule.name, who != nullptr,
            who == nullptr ? std::string("no material in use ") + rule.what : describe(*who) + " " + rule.what);
}

bool rasterSendsRays(const Plan& plan, const RenderSettings& settings) {
  const bool lightsByRaster =
      settings.method == Method::flat || settings.method == Method::gouraud || settings.method == Method::phong;
  return lightsByRaster && settings.rasterShadows == RasterShadows::rays && plan.has(Effect::shadows);
}

bool isArea(const Light& light) { return (shared::kAreaLightTypes >> static_cast<std::uint32_t>(light.type)) & 1u; }

Plan makePlan(const Scene& scene, const RenderSettings& settings) {
  Analysis analysis(scene, settings);
  judgeSurfaces(analysis);
  judgeLights(analysis);
  judgeRays(analysis);
  judgeAir(analysis);
  promote(analysis);
  Plan plan = analysis.draft.take();
  plan.maxDepth = settings.maxDepth;
  return plan;
}

}  // namespace crosslight
