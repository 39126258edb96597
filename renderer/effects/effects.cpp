// Rules: one per effect, each finds the first object that calls for it. Promotion stands in one function below them.
#include "effects/effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>

#include "effects/material_traits.h"
#include "effects/media.h"
#include "scene/shape_mesh.h"
#include "structs.h"

namespace crosslight {
namespace {

std::string quoted(const std::string& kind, const std::string& name, std::size_t index) {
  return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} '{}'", kind, name);
}

// The materials that something drawn uses, in order.
std::set<int> usedMaterials(const Scene& scene, bool shapesAreTraced) {
  std::set<int> used;
  for (const MeshInstance& instance : scene.instances) {
    if (instance.replacedByShape && shapesAreTraced) continue;
    for (const Primitive& p : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives) used.insert(p.material);
  }
  for (const ShapeInstance& shape : scene.shapes) used.insert(shape.material);
  return used;
}

std::string describeFog(const Atmosphere& a) {
  if (a.fogMode == FogMode::linear) return fmt::format("linear from {:g} to {:g}", a.fogStart, a.fogEnd);
  return fmt::format("{} of density {:g}", a.fogMode == FogMode::exp ? "exp" : "exp2", a.fogDensity);
}

class Analysis {
 public:
  Analysis(const Scene& scene, const RenderSettings& settings)
      : scene_(scene),
        settings_(settings),
        traced_(settings.method == Method::whitted),
        materials_(usedMaterials(scene, traced_)) {}

  Plan run() {
    models();
    lights();
    shapes();
    materialRules();
    reflectance();
    vertexColors();
    sides();
    whatRaysDo();
    bodies();
    shadowsInColor();
    air();
    promote();
    return std::move(plan_);
  }

 private:
  using MaterialTest = std::function<bool(const Material&)>;

  void add(Effect effect, const char* name, bool on, std::string reason) {
    if (settings_.allEffects && !on) {
      on = true;
      reason = "compiled in because all effects were asked for; " + reason;
    }
    if (on) plan_.effects |= bitOf(effect);
    plan_.verdicts.push_back({name, on, std::move(reason)});
  }

  // First used material that passes, described; empty when none does.
  std::string firstMaterial(const MaterialTest& test) const {
    for (const int index : materials_) {
      const Material& m = scene_.materials[static_cast<std::size_t>(index)];
      if (test(m)) return quoted("material", m.name, static_cast<std::size_t>(index));
    }
    return {};
  }

  void addByMaterial(const MaterialRule& rule) {
    const std::string who = firstMaterial(rule.test);
    add(rule.effect, rule.name, !who.empty(),
        who.empty() ? std::string("no material in use ") + rule.what : who + " " + rule.what);
  }

  void addListed(std::uint32_t& bits, std::uint32_t value, const char* name, const std::string& who) {
    const bool on = settings_.allEffects || !who.empty();
    if (on) bits |= 1u << value;
    plan_.verdicts.push_back({name, on, who.empty() ? "nothing in the scene uses it" : "used by " + who});
  }

  void models() {
#define CL_ROW(value, name, ...)        \
  addListed(plan_.models, value, #name, \
            firstMaterial([](const Material& m) { return m.model == IlluminationModel::name; }));
    CL_ILLUMINATION_MODELS(CL_ROW)
#undef CL_ROW
  }

  void lights() {
    const auto first = [&](LightType type) -> std::string {
      for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
        if (scene_.lights[i].type == type) return quoted("light", scene_.lights[i].name, i);
      }
      return {};
    };
#define CL_ROW(value, name, ...) addListed(plan_.lights, value, #name, first(LightType::name));
    CL_LIGHT_TYPES(CL_ROW)
#undef CL_ROW
  }

  void shapes() {
    const auto first = [&](ShapeKind kind) -> std::string {
      for (std::size_t i = 0; traced_ && i < scene_.shapes.size(); ++i) {
        if (scene_.shapes[i].kind == kind) return quoted("node", scene_.shapes[i].name, i);
      }
      return {};
    };
#define CL_ROW(value, name, ...) addListed(plan_.shapes, value, #name, first(ShapeKind::name));
    CL_SHAPE_KINDS(CL_ROW)
#undef CL_ROW
    const bool any = traced_ && !scene_.shapes.empty();
    add(Effect::shapes, "shapes", any,
        any ? fmt::format("{} analytic shapes are traced", scene_.shapes.size())
            : (traced_ ? "the scene has no analytic shape" : "raster draws the shapes' meshes"));
    const auto isDrawn = [&](const MeshInstance& m) { return !traced_ || !m.replacedByShape; };
    const auto mesh = std::find_if(scene_.instances.begin(), scene_.instances.end(), isDrawn);
    const bool meshes = mesh != scene_.instances.end() || (!traced_ && !scene_.shapes.empty());
    turnedShapes();
    add(Effect::triangles, "triangles", meshes, meshes ? "meshes are drawn" : "no mesh is drawn");
  }

  // Else a shape's own coordinates are those of the scene, but for where it stands.
  void turnedShapes() {
    const auto turned = [](const ShapeInstance& s) { return glm::dmat3(s.worldFromObject) != glm::dmat3(1.0); };
    const auto found = traced_ ? std::find_if(scene_.shapes.begin(), scene_.shapes.end(), turned) : scene_.shapes.end();
    const bool any = found != scene_.shapes.end();
    const auto index = static_cast<std::size_t>(found - scene_.shapes.begin());
    add(Effect::turnedShapes, "turnedShapes", any,
        any ? quoted("node", found->name, index) + " is turned or scaled" : "no analytic shape is turned or scaled");
  }

  void materialRules() {
    for (const MaterialRule& rule : surfaceRules()) addByMaterial(rule);
  }

  // What settings ask of the models, where a material in use has one that heeds them.
  void reflectance() {
    const auto index = [](const Material& m) {
      return m.model == IlluminationModel::cookTorrance || m.model == IlluminationModel::cookTorrance1982 ||
             hasAngularSpecular(m);
    };
    const std::string who = firstMaterial(index);
    const bool exact = settings_.fresnel == Fresnel::exact ||
                       (settings_.fresnel == Fresnel::ofModel &&
                        !firstMaterial([](const Material& m) {
                           return m.model == IlluminationModel::cookTorrance1982 || hasAngularSpecular(m);
                         }).empty());
    add(Effect::exactFresnel, "exactFresnel", exact && !who.empty(),
        who.empty() ? "no material in use reflects by Fresnel's equations"
                    : (exact ? who + " reflects by Fresnel's equations" : "Schlick's fit is wanted"));
    const std::string rough =
        firstMaterial([](const Material& m) { return m.model == IlluminationModel::cookTorrance; });
    const bool compensates = settings_.energyCompensation && !rough.empty();
    add(Effect::energyCompensation, "energyCompensation", compensates,
        compensates ? "asked for, and " + rough + " has microfacets"
                    : (settings_.energyCompensation ? "no material in use has glTF's microfacets" : "switched off"));
  }

  void vertexColors() {
    std::string who;
    for (const Mesh& mesh : scene_.meshes) {
      for (const Primitive& p : mesh.primitives) {
        if (who.empty() && !p.colors.empty()) who = mesh.name.empty() ? "a mesh" : "mesh '" + mesh.name + "'";
      }
    }
    add(Effect::vertexColors, "vertexColors", !who.empty(),
        who.empty() ? "no mesh has vertex colors" : who + " has vertex colors");
  }

  void sides() {
    if (settings_.twoSided == TwoSided::always) {
      add(Effect::twoSided, "twoSided", true, "asked for: both sides of every surface are lit");
    } else {
      addByMaterial({Effect::twoSided, "twoSided", "is double-sided", [](const Material& m) { return m.doubleSided; }});
    }
  }

  void addRayRule(const MaterialRule& rule) {
    const bool wanted = rule.effect == Effect::reflection ? settings_.reflection : settings_.refraction;
    if (!traced_ && rule.effect == Effect::reflection) return rasterReflections(rule);
    if (!traced_) return add(rule.effect, rule.name, false, "not simulated by raster methods");
    if (!wanted || settings_.maxDepth == 0) return add(rule.effect, rule.name, false, "switched off");
    addByMaterial(rule);
  }

  void rasterReflections(const MaterialRule& rule) {
    if (settings_.method == Method::wireframe) return add(rule.effect, rule.name, false, "edges are not lit");
    if (settings_.rasterReflections != RasterReflections::off) return addByMaterial(rule);
    add(rule.effect, rule.name, false,
        "raster shows no reflections; --set raster-reflections=environment, probes or mirrors does");
  }

  void shadows() {
    const bool wanted = traced_ ? settings_.shadows : settings_.rasterShadows != RasterShadows::off;
    if (settings_.method == Method::wireframe) return add(Effect::shadows, "shadows", false, "edges are not lit");
    if (!wanted) {
      return add(Effect::shadows, "shadows", false,
                 traced_ ? "switched off" : "raster shows no shadows; --set raster-shadows=rays or maps does");
    }
    const bool around = traced_ && scene_.atmosphere.environment.present();
    const bool lit = !scene_.lights.empty() || around;
    add(Effect::shadows, "shadows", lit,
        lit ? fmt::format("{} lights {}cast shadows", scene_.lights.size(), around ? "and the environment " : "")
            : "the scene has no light");
  }

  void whatRaysDo() {
    shadows();
    softShadows();
    for (const MaterialRule& rule : rayRules()) addRayRule(rule);
  }

  void softShadows() {
    const auto found = std::find_if(scene_.lights.begin(), scene_.lights.end(), isArea);
    const bool area = found != scene_.lights.end();
    const bool around = scene_.atmosphere.environment.present();
    const bool on = traced_ && settings_.shadows && settings_.lightSamples > 0 && (area || around);
    const auto index = static_cast<std::size_t>(found - scene_.lights.begin());
    const std::string who =
        area ? quoted("light", found->name, index) + " has an area" : "the environment shines from all around";
    add(Effect::softShadows, "softShadows", on,
        !traced_                  ? "raster methods cast shadows from a light's middle"
        : !settings_.shadows      ? "switched off"
        : !area && !around        ? "no light has an area, and there is no environment"
        : !settings_.lightSamples ? "switched off: lights with an area cast shadows from their middle"
                                  : fmt::format("{}, {} rays to it", who, settings_.lightSamples));
  }

  void bodies() {
    const std::string reason = reasonForNestedMedia(scene_, settings_);
    add(Effect::nestedMedia, "nestedMedia", !reason.empty(),
        reason.empty() ? "no body has a priority, and the camera is in none" : reason);
    const auto disperses = [](const Material& m) { return m.dispersion > 0.0f && isBody(m); };
    const MaterialRule rule{Effect::dispersion, "dispersion", "spreads light into colors", disperses};
    const bool bends = traced_ && settings_.refraction && settings_.maxDepth > 0;
    if (settings_.dispersion == Dispersion::rgb && bends) {
      addByMaterial(rule);
    } else {
      add(rule.effect, rule.name, false, traced_ ? "not asked for" : "not simulated by raster methods");
    }
  }

  void shadowsInColor() {
    const bool on = plan_.has(Effect::shadows) && plan_.has(Effect::transparency) && settings_.coloredShadows;
    add(Effect::coloredShadows, "coloredShadows", on,
        !settings_.coloredShadows ? "not asked for"
                                  : (on ? "asked for, and something lets light pass" : "nothing lets light pass"));
  }

  void air() {
    const Atmosphere& a = scene_.atmosphere;
    const bool around = a.environment.present();
    add(Effect::environment, "environment", around,
        around ? "the scene is lit by the environment " + a.environment.file.filename().string()
               : "the scene has no environment");
    add(Effect::fog, "fog", hasFog(a), hasFog(a) ? "the scene has fog: " + describeFog(a) : "the scene has no fog");
    const bool smoke = hasSmoke(a.smoke), drawn = settings_.method != Method::wireframe;
    add(Effect::smoke, "smoke", smoke && drawn,
        !smoke ? "the scene has no smoke" : (drawn ? "the scene has smoke" : "wireframe draws edges without smoke"));
  }

  // Mirrored and refracted rays meet surfaces from behind, which must then be lit from behind.
  void promote() {
    const bool secondary = traced_ && (plan_.has(Effect::reflection) || plan_.has(Effect::refraction));
    if (!secondary || plan_.has(Effect::twoSided)) return;
    plan_.effects |= bitOf(Effect::twoSided);
    for (EffectVerdict& v : plan_.verdicts) {
      if (v.name == "twoSided") v = {"twoSided", true, "mirrored and refracted rays meet surfaces from behind"};
    }
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  bool traced_;
  std::set<int> materials_;
  Plan plan_;
};

}  // namespace

bool rasterSendsRays(const Plan& plan, const RenderSettings& settings) {
  const bool lightsByRaster =
      settings.method == Method::flat || settings.method == Method::gouraud || settings.method == Method::phong;
  return lightsByRaster && settings.rasterShadows == RasterShadows::rays && plan.has(Effect::shadows);
}

bool isArea(const Light& light) { return (shared::kAreaLightTypes >> static_cast<std::uint32_t>(light.type)) & 1u; }

Plan makePlan(const Scene& scene, const RenderSettings& settings) { return Analysis(scene, settings).run(); }

}  // namespace crosslight
