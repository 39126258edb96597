// The bound. A node of the ray tree has the value v = direct + w v', v' its mirrored child's, w <= rho the mirror's
// factor, direct <= L. So a tree of at most D segments has v <= L (1 + rho + ... + rho^D), and what lies beyond segment
// C brings a pixel at most rho^(C+1) L (1 + rho + ... + rho^(D-C-1)): pixels are means of samples with positive
// weights. Fog mixes values with its color, which L includes, and so only lowers the difference.
#include "effects/within.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace crosslight {
namespace {

// Values are sums of some hundred products in floats: 2^-24 each.
constexpr double kRounding = 1.0 + 0x1p-14;

double most(const glm::vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// Highlight of a model for a light of 1 and a specular color of 1; nothing: no bound is known.
std::optional<double> highlightOf(const Material& m) {
  switch (m.model) {
    case IlluminationModel::phong:
    case IlluminationModel::blinnPhong:
      return 1.0;  // a power of a cosine
    case IlluminationModel::modifiedPhong:
      return 0.5 * (m.classic.shininess + 2.0);
    case IlluminationModel::lambert:
    case IlluminationModel::orenNayar:
      return 0.0;
    default:
      return std::nullopt;
  }
}

// Light that arrives from all lights together at most, (diffuse or specular, ambient); nothing: no bound is known.
std::optional<glm::dvec2> arrivingOf(const Scene& scene) {
  glm::dvec2 sum(0.0);
  for (const Light& light : scene.lights) {
    if (isArea(light)) return std::nullopt;
    if (!light.classic) {
      if (light.type != LightType::directional) return std::nullopt;  // 1 / d^2 has no bound
      sum.x += most(light.color) * std::abs(light.intensity);
      continue;
    }
    const ClassicLight& c = *light.classic;
    if (c.attenuation.y < 0 || c.attenuation.z < 0) return std::nullopt;
    const bool even = light.type == LightType::directional || c.attenuation == glm::vec3(0.0f);
    if (!even && !(c.attenuation.x > 0)) return std::nullopt;
    const double falloff = even ? 1.0 : 1.0 / c.attenuation.x;
    sum += falloff * glm::dvec2(std::max(most(c.diffuse), most(c.specular)), most(c.ambient));
  }
  return sum;
}

double vertexColorOf(const Scene& scene, const SurfaceUse& use) {
  double largest = 1.0;
  if (use.shape) return largest;
  const auto mesh = static_cast<std::size_t>(scene.instances[use.index].mesh);
  for (const glm::vec4& color : scene.meshes[mesh].primitives[use.primitive].colors)
    largest = std::max(largest, most(glm::vec3(color)));
  return largest;
}

struct TreeBound {
  double direct = 0.0;  // L
  double weight = 0.0;  // rho
};

std::optional<TreeBound> boundOf(const Analysis& a) {
  const Atmosphere& air = a.scene.atmosphere;
  const std::optional<glm::dvec2> arriving = arrivingOf(a.scene);
  if (!arriving || air.environment.present() || hasSmoke(air.smoke)) return std::nullopt;
  TreeBound bound{std::max(most(air.background), hasFog(air) ? most(air.fogColor) : 0.0), 0.0};
  for (const SurfaceUse& use : a.uses) {
    if (!use.met) continue;
    const Material& m = a.materialOf(use);
    const std::optional<double> highlight = highlightOf(m);
    if (!highlight || isTransparent(m)) return std::nullopt;
    constexpr double kOrenNayar = 1.45;  // A + B <= 1 + 0.45
    const double diffuse = most(m.classic.diffuseFactor) * (m.model == IlluminationModel::orenNayar ? kOrenNayar : 1.0);
    const double specular =
        (m.classic.angularSpecular ? std::max(1.0, most(m.classic.specularFactor)) : most(m.classic.specularFactor)) *
        *highlight;
    const double base = vertexColorOf(a.scene, use);
    const double direct = most(m.classic.ambientFactor) * base * (most(air.ambient) + arriving->y) +
                          (diffuse * base + specular) * arriving->x + most(m.emissiveFactor) * m.emissiveStrength;
    bound.direct = std::max(bound.direct, direct);
    if (isMirror(m)) bound.weight = std::max(bound.weight, most(m.classic.reflectionFactor));
  }
  return bound;
}

double beyond(const TreeBound& b, std::uint32_t cut, std::uint32_t depth) {
  double sum = 0.0;
  for (std::uint32_t k = cut; k < depth; ++k) sum += std::pow(b.weight, k + 1.0);
  return sum * b.direct * kRounding;
}

void leaveOutReflection(Plan& plan, const RenderSettings& s) {
  for (EffectVerdict& v : plan.verdicts) {
    if (v.name != "reflection" || !v.on) continue;
    v.reason = fmt::format("left out within {:g}: it brings a pixel at most {:.3g}; {}", s.effectsWithin, plan.bound,
                           v.reason);
    v.on = false;
    v.bound = plan.bound;
    plan.effects &= ~bitOf(Effect::reflection);
  }
}

}  // namespace

void leaveOutWithin(const Analysis& a, Plan& plan) {
  const RenderSettings& s = a.settings;
  if (!(s.effectsWithin > 0) || s.allEffects || !a.traced || !plan.has(Effect::reflection) || plan.maxDepth == 0)
    return;
  const std::optional<TreeBound> bound = boundOf(a);
  if (!bound || s.filter == PixelFilter::mitchell || !std::isfinite(bound->direct)) {
    plan.depthReason += fmt::format("; within {:g}: no bound is known of what reflections bring", s.effectsWithin);
    return;
  }
  std::uint32_t cut = plan.maxDepth;
  while (cut > 0 && beyond(*bound, cut - 1, plan.maxDepth) <= s.effectsWithin) --cut;
  if (cut == plan.maxDepth) return;
  plan.bound = beyond(*bound, cut, plan.maxDepth);
  plan.depthReason = fmt::format(
      "cut within {:g}: mirrors of at most {:g} and direct light of at most {:.3g} bring a pixel at most {:.3g} more; "
      "{}",
      s.effectsWithin, bound->weight, bound->direct, plan.bound, plan.depthReason);
  plan.maxDepth = cut;
  if (cut == 0) leaveOutReflection(plan, s);
}

}  // namespace crosslight
