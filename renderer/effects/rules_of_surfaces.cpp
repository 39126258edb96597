// Rules on what is drawn: illumination models, shapes and meshes, and what materials call for by themselves.
#include <fmt/format.h>

#include <algorithm>

#include "effects/analysis.h"

namespace crosslight {
namespace {

void models(Analysis& a) {
  const auto add = [&](std::uint32_t value, const char* name, IlluminationModel model) {
    const auto has = [model](const Material& m) { return m.model == model; };
    const SurfaceUse* who = a.firstUse(has);
    a.draft.addListed(&Plan::models, value, name, who != nullptr,
                      who == nullptr ? a.nobody(has, "has this model") : a.describe(*who, "has this model"));
  };
#define CL_ROW(value, name, ...) add(value, #name, IlluminationModel::name);
  CL_ILLUMINATION_MODELS(CL_ROW)
#undef CL_ROW
}

void shapeKinds(Analysis& a) {
  const auto add = [&](std::uint32_t value, const char* name, ShapeKind kind) {
    a.addFirst(&Plan::shapes, value, name, "node", a.scene.shapes,
               [&](const ShapeInstance& s) { return a.traced && s.kind == kind; });
  };
#define CL_ROW(value, name, ...) add(value, #name, ShapeKind::name);
  CL_SHAPE_KINDS(CL_ROW)
#undef CL_ROW
}

// Else a shape's own coordinates are those of the scene, but for where it stands.
void turnedShapes(Analysis& a) {
  const auto& shapes = a.scene.shapes;
  const auto turned = [](const ShapeInstance& s) { return glm::dmat3(s.worldFromObject) != glm::dmat3(1.0); };
  const auto found = a.traced ? std::find_if(shapes.begin(), shapes.end(), turned) : shapes.end();
  const bool any = found != shapes.end();
  const auto index = static_cast<std::size_t>(found - shapes.begin());
  a.draft.add(
      Effect::turnedShapes, "turnedShapes", any,
      any ? quoted("node", found->name, index) + " is turned or scaled" : "no analytic shape is turned or scaled");
}

void geometry(Analysis& a) {
  const bool shapes = a.traced && !a.scene.shapes.empty();
  a.draft.add(Effect::shapes, "shapes", shapes,
              shapes ? fmt::format("{} analytic shapes are traced", a.scene.shapes.size())
                     : (a.traced ? "the scene has no analytic shape" : "raster draws the shapes' meshes"));
  turnedShapes(a);
  const auto isDrawn = [&](const MeshInstance& m) { return !a.traced || !m.replacedByShape; };
  const bool meshes = std::any_of(a.scene.instances.begin(), a.scene.instances.end(), isDrawn) ||
                      (!a.traced && !a.scene.shapes.empty());
  a.draft.add(Effect::triangles, "triangles", meshes, meshes ? "meshes are drawn" : "no mesh is drawn");
}

// What settings ask of the models, where a material in use has one that heeds them.
void reflectance(Analysis& a) {
  const RenderSettings& s = a.settings;
  const auto byModel = [](const Material& m) {
    return m.model == IlluminationModel::cookTorrance1982 || hasAngularSpecular(m);
  };
  const SurfaceUse* who =
      a.firstUse([&](const Material& m) { return m.model == IlluminationModel::cookTorrance || byModel(m); });
  const bool exact = s.fresnel == Fresnel::exact || (s.fresnel == Fresnel::ofModel && a.firstUse(byModel) != nullptr);
  a.draft.add(Effect::exactFresnel, "exactFresnel", exact && who != nullptr,
              who == nullptr
                  ? "no material in use reflects by Fresnel's equations"
                  : (exact ? a.describe(*who, "reflects by Fresnel's equations") : "Schlick's fit is wanted"));
  const SurfaceUse* rough = a.firstUse([](const Material& m) { return m.model == IlluminationModel::cookTorrance; });
  const bool compensates = s.energyCompensation && rough != nullptr;
  a.draft.add(Effect::energyCompensation, "energyCompensation", compensates,
              compensates ? "asked for, and " + a.describe(*rough, "has microfacets")
                          : (s.energyCompensation ? "no material in use has glTF's microfacets" : "switched off"));
}

void vertexColors(Analysis& a) {
  const auto colored = [&](const SurfaceUse& use) {
    if (use.shape || !use.met) return false;
    const auto mesh = static_cast<std::size_t>(a.scene.instances[use.index].mesh);
    return !a.scene.meshes[mesh].primitives[use.primitive].colors.empty();
  };
  const auto who = std::find_if(a.uses.begin(), a.uses.end(), colored);
  a.draft.add(Effect::vertexColors, "vertexColors", who != a.uses.end(),
              who == a.uses.end() ? "no mesh that is met has vertex colors"
                                  : a.describe(*who, "is multiplied by vertex colors"));
}

void sides(Analysis& a) {
  if (a.settings.twoSided == TwoSided::always)
    return a.draft.add(Effect::twoSided, "twoSided", true, "asked for: both sides of every surface are lit");
  a.addByMaterial({Effect::twoSided, "twoSided", "is double-sided", [](const Material& m) { return m.doubleSided; }});
}

}  // namespace

void judgeSurfaces(Analysis& a) {
  models(a);
  shapeKinds(a);
  geometry(a);
  for (const MaterialRule& rule : surfaceRules()) a.addByMaterial(rule);
  reflectance(a);
  vertexColors(a);
  sides(a);
}

}  // namespace crosslight
