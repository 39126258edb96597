// Rules on what becomes of rays at surfaces: mirrored, refracted, absorbed, colored.
#include "effects/analysis.h"
#include "effects/media.h"

namespace crosslight {
namespace {

void rasterReflections(Analysis& a, const MaterialRule& rule) {
  if (a.settings.method == Method::wireframe) return a.draft.add(rule.effect, rule.name, false, "edges are not lit");
  if (a.settings.rasterReflections != RasterReflections::off) return a.addByMaterial(rule);
  a.draft.add(rule.effect, rule.name, false,
              "raster shows no reflections; --set raster-reflections=environment, probes or mirrors does");
}

void addRayRule(Analysis& a, const MaterialRule& rule) {
  const bool wanted = rule.effect == Effect::reflection ? a.settings.reflection : a.settings.refraction;
  if (!a.traced && rule.effect == Effect::reflection) return rasterReflections(a, rule);
  if (!a.traced) return a.draft.add(rule.effect, rule.name, false, "not simulated by raster methods");
  if (!wanted || a.settings.maxDepth == 0) return a.draft.addSwitchedOff(rule.effect, rule.name, "switched off");
  a.addByMaterial(rule);
}

void bodies(Analysis& a) {
  const std::string reason = reasonForNestedMedia(a.scene, a.settings);
  a.draft.add(Effect::nestedMedia, "nestedMedia", !reason.empty(),
              reason.empty() ? "no body has a priority, and the camera is in none" : reason);
  const auto disperses = [](const Material& m) { return m.dispersion > 0.0f && isBody(m); };
  const MaterialRule rule{Effect::dispersion, "dispersion", "spreads light into colors", disperses};
  const bool bends = a.traced && a.settings.refraction && a.settings.maxDepth > 0;
  if (a.settings.dispersion == Dispersion::rgb && bends) return a.addByMaterial(rule);
  a.draft.add(rule.effect, rule.name, false, a.traced ? "not asked for" : "not simulated by raster methods");
}

void shadowsInColor(Analysis& a) {
  const bool wanted = a.settings.coloredShadows;
  const bool on = a.draft.has(Effect::shadows) && a.draft.has(Effect::transparency) && wanted;
  a.draft.add(
      Effect::coloredShadows, "coloredShadows", on,
      !wanted ? "not asked for" : (on ? "asked for, and something lets light pass" : "nothing lets light pass"));
}

}  // namespace

void judgeRays(Analysis& a) {
  for (const MaterialRule& rule : rayRules()) addRayRule(a, rule);
  bodies(a);
  shadowsInColor(a);
}

}  // namespace crosslight
