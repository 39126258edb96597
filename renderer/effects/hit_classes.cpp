#include "effects/hit_classes.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "bindings.h"
#include "effects/forced.h"
#include "effects/material_traits.h"
#include "effects/uses.h"

namespace crosslight {

namespace {

// One more kernel costs 50 to 100 ms to compile on llvmpipe; a million hits take about as long to shade.
constexpr std::uint64_t kFewestRays = 1u << 19;

// What materials decide by themselves; the rest of a plan (shadows, two-sidedness, absorption on a ray's way) is kept.
constexpr std::uint64_t kOfMaterials =
    bitOf(Effect::baseColorTexture) | bitOf(Effect::metallicRoughnessTexture) | bitOf(Effect::normalMap) |
    bitOf(Effect::occlusionTexture) | bitOf(Effect::emissiveTexture) | bitOf(Effect::alphaMask) |
    bitOf(Effect::transparency) | bitOf(Effect::reflection) | bitOf(Effect::refraction) | bitOf(Effect::bumpMap) |
    bitOf(Effect::clearcoat) | bitOf(Effect::sheen) | bitOf(Effect::anisotropy) | bitOf(Effect::iridescence) |
    bitOf(Effect::diffuseTransmission) | bitOf(Effect::mipmaps) | bitOf(Effect::specularLayer) |
    bitOf(Effect::transmissionTexture) | bitOf(Effect::diffuseRoughness) | bitOf(Effect::angularSpecular);

// What surfaces have in common that share a kernel.
struct Signature {
  bool shape = false;
  bool lit = false;
  bool usesLights = false;
  std::uint32_t model = 0;
  std::uint64_t effects = 0;

  auto operator<=>(const Signature&) const = default;
};

// Surfaces that send rays on hand them the length of the way so far, by which those find their texture levels.
constexpr std::uint64_t kSendsRaysOn =
    bitOf(Effect::reflection) | bitOf(Effect::refraction) | bitOf(Effect::transparency);

Signature signatureOf(const Material& m, bool shape, const Plan& plan) {
  const bool hasAmbient = isClassic(m) && m.classic.ambientFactor != glm::vec3(0.0f);
  std::uint64_t effects = effectsOf(m) & plan.effects & kOfMaterials;
  if ((effects & kSendsRaysOn) != 0) effects |= plan.effects & bitOf(Effect::mipmaps);
  return {shape, isLit(m), isLit(m) || hasAmbient, 1u << static_cast<std::uint32_t>(m.model), effects};
}

// The surfaces that rays meet: (material, shape kinds as bits; 0 for meshes).
std::map<std::pair<int, bool>, std::uint32_t> surfacesOf(const Scene& scene, const RenderSettings& settings) {
  std::map<std::pair<int, bool>, std::uint32_t> surfaces;
  for (const SurfaceUse& use : usesOf(scene, settings)) {
    if (!use.met) continue;
    surfaces[{use.material, use.shape}] |=
        use.shape ? 1u << static_cast<std::uint32_t>(scene.shapes[use.index].kind) : 0u;
  }
  return surfaces;
}

HitClass emptyClass(const Plan& plan, std::uint64_t forcedOn) {
  HitClass c;
  c.plan = plan;
  c.plan.verdicts.clear();
  c.plan.models = c.plan.shapes = c.plan.lights = 0;
  c.plan.effects &=
      ~(kOfMaterials | bitOf(Effect::shapes) | bitOf(Effect::triangles) | bitOf(Effect::shadows)) | forcedOn;
  c.lit = false;
  return c;
}

void add(const Signature& s, std::uint32_t kinds, const Plan& plan, HitClass& c) {
  c.lit = c.lit || s.lit;
  if (s.lit) c.plan.effects |= plan.effects & bitOf(Effect::shadows);
  c.plan.models |= s.model & plan.models;
  c.plan.effects |= s.effects | (plan.effects & bitOf(s.shape ? Effect::shapes : Effect::triangles));
  c.plan.shapes |= kinds & plan.shapes;
  if (s.usesLights) c.plan.lights = plan.lights;
}

}  // namespace

bool HitClass::operator==(const HitClass& other) const {
  const auto bits = [](const HitClass& c) {
    return std::tuple(c.lit, c.plan.models, c.plan.lights, c.plan.shapes, c.plan.effects);
  };
  return bits(*this) == bits(other);
}

HitClasses classifyHits(const Scene& scene, const Plan& plan, const RenderSettings& settings) {
  const std::uint64_t rays = std::uint64_t{settings.width} * settings.height * settings.spp;
  const bool pays = settings.hitQueues == HitQueues::on || rays >= kFewestRays;
  if (settings.hitQueues == HitQueues::off || settings.allEffects || !pays) return {};
  const std::uint64_t forcedOn = plan.effects & forcedOnEffects(settings);
  HitClasses result;
  result.ofMaterial.assign(scene.materials.size(), glm::uvec4(shared::kHitClasses));
  std::map<Signature, std::uint32_t> classes;
  for (const auto& [surface, kinds] : surfacesOf(scene, settings)) {
    const auto& [material, shape] = surface;
    const auto index = static_cast<std::size_t>(material);
    const Signature s = signatureOf(scene.materials[index], shape, plan);
    // More kinds of surfaces than classes: the last class takes all that are left.
    const auto next = std::min(static_cast<std::uint32_t>(result.classes.size()), shared::kHitClasses - 1);
    const std::uint32_t at = classes.try_emplace(s, next).first->second;
    if (at == result.classes.size()) result.classes.push_back(emptyClass(plan, forcedOn));
    add(s, kinds, plan, result.classes[at]);
    (shape ? result.ofMaterial[index].y : result.ofMaterial[index].x) = at;
  }
  const bool one = result.classes.size() == 1 && settings.hitQueues != HitQueues::on;
  return one || result.classes.empty() ? HitClasses{} : result;
}

}  // namespace crosslight
