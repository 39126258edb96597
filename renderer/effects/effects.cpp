// The order of the rules, and promotion: what one effect implies of another.
#include "effects/effects.h"

#include <fmt/format.h>

#include <algorithm>

#include "effects/analysis.h"
#include "effects/details.h"
#include "effects/forced.h"
#include "effects/ray_depth.h"
#include "effects/within.h"
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

Analysis::Analysis(const Scene& s, const RenderSettings& set, InView inView)
    : scene(s), settings(set), traced(set.method == Method::whitted), uses(usesOf(s, set, inView)), draft(set) {}

const Material& Analysis::materialOf(const SurfaceUse& use) const {
  return scene.materials[static_cast<std::size_t>(use.material)];
}

const SurfaceUse* Analysis::firstUse(const MaterialTest& test) const {
  const SurfaceUse* first = nullptr;
  for (const SurfaceUse& use : uses) {
    if (!use.met || !test(materialOf(use))) continue;
    if (use.inView) return &use;
    if (first == nullptr) first = &use;
  }
  return first;
}

std::string Analysis::describe(const SurfaceUse& use, const std::string& what) const {
  return fmt::format("{} {} {}, {}", quoted("material", materialOf(use).name, static_cast<std::size_t>(use.material)),
                     what, placeOf(scene, use), use.why);
}

std::string Analysis::nobody(const MaterialTest& test, const std::string& what) const {
  const auto unmet = std::find_if(uses.begin(), uses.end(), [&](const SurfaceUse& u) { return test(materialOf(u)); });
  return unmet == uses.end() ? "no material in use " + what : describe(*unmet, what) + " of all rays";
}

void Analysis::addByMaterial(const MaterialRule& rule) {
  const SurfaceUse* who = firstUse(rule.test);
  if (who == nullptr) return draft.add(rule.effect, rule.name, false, nobody(rule.test, rule.what));
  const std::string details = detailsOf(rule.effect, materialOf(*who));
  const std::string what = details.empty() ? std::string(rule.what) : fmt::format("{} ({})", rule.what, details);
  draft.add(rule.effect, rule.name, true, describe(*who, what));
}

bool rasterSendsRays(const Plan& plan, const RenderSettings& settings) {
  const bool lightsByRaster =
      settings.method == Method::flat || settings.method == Method::gouraud || settings.method == Method::phong;
  return lightsByRaster && settings.rasterShadows == RasterShadows::rays && plan.has(Effect::shadows);
}

bool isArea(const Light& light) { return (shared::kAreaLightTypes >> static_cast<std::uint32_t>(light.type)) & 1u; }

Plan makePlan(const Scene& scene, const RenderSettings& settings, InView inView) {
  Analysis analysis(scene, settings, inView);
  judgeSurfaces(analysis);
  judgeLights(analysis);
  judgeRays(analysis);
  judgeAir(analysis);
  promote(analysis);
  Plan plan = analysis.draft.take();
  const bool forced = settings.allEffects || forcedState(settings, "shadows") == true;
  if (plan.has(Effect::shadows) && !forced) plan.lightShadows = std::move(analysis.lightShadows);
  const RayDepth depth = usableDepth(scene, settings, analysis.uses);
  plan.maxDepth = settings.allEffects ? settings.maxDepth : depth.most;
  plan.depthReason = depth.reason;
  leaveOutWithin(analysis, plan);
  return plan;
}

}  // namespace crosslight
