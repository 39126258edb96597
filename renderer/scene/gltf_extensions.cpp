// The CROSSLIGHT_* extensions: what scenes/schema/CROSSLIGHT_*.schema.json says, in code. Their names and limits are
// compared by a test.
#include <fmt/format.h>

#include "scene/gltf_build.h"
#include "scene/material_table.h"

namespace crosslight::gltf {
namespace {

constexpr Range kUnit{0.0, 1.0, false};
constexpr double kMaxSpotExponent = 128.0;  // OpenGL 1.x, GL_SPOT_EXPONENT

std::string presetNames() {
  std::string names;
  for (const MaterialPreset& preset : materialPresets()) {
    if (!names.empty()) names += ", ";
    names += preset.name;
  }
  return names;
}

float number(const JsonAt& object, const char* key, float fallback, const Range& range) {
  return static_cast<float>(numberOr(object, key, double{fallback}, range));
}

// Those of CL_ILLUMINATION_MODELS that a classic material may have.
IlluminationModel modelOf(const JsonAt& model) {
  const std::string name =
      model.oneOf({"lambert", "phong", "blinnPhong", "modifiedPhong", "orenNayar", "cookTorrance1982"});
#define CL_MODEL_ROW(value, row, ...) \
  if (name == #row) return IlluminationModel::row;
  CL_ILLUMINATION_MODELS(CL_MODEL_ROW)
#undef CL_MODEL_ROW
  model.fail("is a model without code");
}

// Oren and Nayar's angle, or the slope of Cook and Torrance: neither formula is meant for more than a right angle.
constexpr double kLargestRoughness = 1.5707963267948966;

// What belongs to one model alone.
void readModelParameters(const JsonAt& extension, Material& material) {
  ClassicMaterial& classic = material.classic;
  const bool grooves = material.model == IlluminationModel::cookTorrance1982;
  classic.roughness = number(extension, "roughness", grooves ? 0.3f : 0.0f, Range::between(0.0, kLargestRoughness));
  if (grooves && classic.roughness == 0.0f) extension.at("roughness").fail("must be above 0 for cookTorrance1982");
  if (const auto coefficient = extension.find("specularCoefficient"))
    classic.angularSpecular = coefficient->oneOf({"constant", "angular"}) == "angular";
  if (const auto index = extension.find("refractiveIndex")) {
    classic.hasIndex = true;
    classic.refractiveIndex = index->vec3(Range::above(0.0));
  }
  classic.extinction = vec3Or(extension, "extinction", classic.extinction, Range::atLeast(0.0));
  if (!classic.hasIndex && extension.find("extinction")) extension.fail("extinction needs a refractiveIndex beside it");
  const bool indexed = classic.hasIndex && !grooves;
  if (indexed) extension.at("refractiveIndex").warn("counts for the model cookTorrance1982 alone");
}

FogMode fogModeOf(const std::string& name) {
  if (name == "linear") return FogMode::linear;
  return name == "exp" ? FogMode::exp : FogMode::exp2;
}

void readFog(const JsonAt& fog, Atmosphere& atmosphere) {
  fog.onlyKnows({"mode", "color", "start", "end", "density"});
  atmosphere.fogMode = fogModeOf(fog.at("mode").oneOf({"linear", "exp", "exp2"}));
  atmosphere.fogColor = vec3Or(fog, "color", atmosphere.fogColor, Range::atLeast(0.0));
  atmosphere.fogStart = numberOr(fog, "start", atmosphere.fogStart, Range::atLeast(0.0));
  atmosphere.fogEnd = numberOr(fog, "end", atmosphere.fogEnd, Range::atLeast(0.0));
  atmosphere.fogDensity = numberOr(fog, "density", atmosphere.fogDensity, Range::atLeast(0.0));
  if (atmosphere.fogMode == FogMode::linear && !(atmosphere.fogEnd > atmosphere.fogStart)) {
    fog.fail(
        fmt::format("linear fog needs an end beyond its start {:g}, has {:g}", atmosphere.fogStart, atmosphere.fogEnd));
  }
}

// The picture itself is read by those who draw: no image format is known here.
void readEnvironmentOf(const JsonAt& at, const Document& document, Atmosphere& atmosphere) {
  at.onlyKnows({"uri", "intensity", "rotation"});
  atmosphere.environment.file = fileInFolder(at.at("uri"), document);
  atmosphere.environment.intensity = numberOr(at, "intensity", 1.0, Range::atLeast(0.0));
  atmosphere.environment.rotation = numberOr(at, "rotation", 0.0);
}

ShapeKind kindOf(const JsonAt& kind) {
#define CL_KIND_ROW(value, name, ...) \
  if (kind.string() == #name) return ShapeKind::name;
  CL_SHAPE_KINDS(CL_KIND_ROW)
#undef CL_KIND_ROW
#define CL_KIND_NAME(value, name, ...) #name ", "
  kind.fail("is none of " CL_SHAPE_KINDS(CL_KIND_NAME) "but '" + kind.string() + "'");
#undef CL_KIND_NAME
}

}  // namespace

void readClassicMaterial(const JsonAt& extension, Material& material) {
  extension.onlyKnows({"model", "preset", "ambientFactor", "diffuseFactor", "specularFactor", "shininess",
                       "transparency", "reflectionFactor", "roughness", "specularCoefficient", "refractiveIndex",
                       "extinction"});
  ClassicMaterial& classic = material.classic;
  material.model = modelOf(extension.at("model"));
  readModelParameters(extension, material);
  if (const auto name = extension.find("preset")) {
    const auto preset = findMaterialPreset(name->string());
    if (!preset) name->fail("'" + name->string() + "' is not in the material table; there are " + presetNames());
    classic.preset = name->string();
    classic.ambientFactor = preset->ambient;
    classic.diffuseFactor = preset->diffuse;
    classic.specularFactor = preset->specular;
    classic.shininess = preset->shininess;
  }
  classic.ambientFactor = vec3Or(extension, "ambientFactor", classic.ambientFactor, kUnit);
  classic.diffuseFactor = vec3Or(extension, "diffuseFactor", classic.diffuseFactor, kUnit);
  classic.specularFactor = vec3Or(extension, "specularFactor", classic.specularFactor, kUnit);
  classic.shininess = number(extension, "shininess", classic.shininess, Range::atLeast(0.0));
  classic.transparency = number(extension, "transparency", classic.transparency, kUnit);
  classic.reflectionFactor = vec3Or(extension, "reflectionFactor", classic.reflectionFactor, kUnit);
}

void readDielectric(const JsonAt& extension, Material& material) {
  constexpr std::int64_t kMostPriority = 1000;
  extension.onlyKnows({"priority"});
  extension.at("priority");
  material.priority = static_cast<int>(integerOr(extension, "priority", 0, kMostPriority));
}

ClassicLight readClassicLight(const JsonAt& extension) {
  extension.onlyKnows({"attenuation", "spotExponent", "spotCutoff", "ambient", "diffuse", "specular"});
  ClassicLight light;
  light.ambient = vec3Or(extension, "ambient", light.ambient, Range::atLeast(0.0));
  light.diffuse = vec3Or(extension, "diffuse", light.diffuse, Range::atLeast(0.0));
  light.specular = vec3Or(extension, "specular", light.specular, Range::atLeast(0.0));
  light.attenuation = vec3Or(extension, "attenuation", light.attenuation, Range::atLeast(0.0));
  light.spotExponent = number(extension, "spotExponent", light.spotExponent, Range::between(0.0, kMaxSpotExponent));
  light.spotCutoff = number(extension, "spotCutoff", light.spotCutoff, Range::between(0.0, 180.0));
  if (light.spotCutoff > 90.0f && light.spotCutoff != 180.0f) {
    extension.at("spotCutoff").fail(fmt::format("must be in [0, 90], or 180 for no cone, is {:g}", light.spotCutoff));
  }
  return light;
}

Atmosphere readAtmosphere(const Source& source, const JsonAt& extension, const Document& document) {
  extension.onlyKnows({"ambient", "background", "fog", "environment", "smoke"});
  Atmosphere atmosphere;
  atmosphere.ambient = vec3Or(extension, "ambient", atmosphere.ambient, Range::atLeast(0.0));
  atmosphere.background = vec3Or(extension, "background", atmosphere.background, Range::atLeast(0.0));
  if (const auto fog = extension.find("fog")) readFog(*fog, atmosphere);
  if (const auto environment = extension.find("environment")) readEnvironmentOf(*environment, document, atmosphere);
  if (const auto smoke = extension.find("smoke")) atmosphere.smoke = readSmoke(source, *smoke);
  return atmosphere;
}

void readDisplacement(const JsonAt& extension, const TextureReader& texture, Material& material) {
  extension.onlyKnows({"displacementTexture", "scale", "bias"});
  extension.at("displacementTexture").onlyKnows({"index", "texCoord"});
  material.displacementTexture = texture(extension, "displacementTexture");
  material.displacementScale = number(extension, "scale", material.displacementScale, {});
  material.displacementBias = number(extension, "bias", material.displacementBias, {});
}

NodeShape readNodeShape(const JsonAt& extension, std::size_t materialCount) {
  extension.onlyKnows({"kind", "radius", "height", "size", "tubeRadius", "material"});
  NodeShape shape;
  shape.kind = kindOf(extension.at("kind"));
  shape.material = referenceOr(extension, "material", materialCount, "material");
  // Lengths that the kind does not have are checked all the same, so that a typing error shows.
  const float radius = number(extension, "radius", 0.0f, Range::above(0.0));
  const float height = number(extension, "height", 0.0f, Range::above(0.0));
  const float tube = number(extension, "tubeRadius", 0.0f, Range::above(0.0));
  const glm::vec3 size = vec3Or(extension, "size", glm::vec3(0.0f), Range::above(0.0));
  const bool isRound = shape.kind != ShapeKind::plane && shape.kind != ShapeKind::box;
  if (isRound) extension.at("radius");
  switch (shape.kind) {
    case ShapeKind::plane:
      break;
    case ShapeKind::box:
      extension.at("size");
      shape.params = {size, 0.0f};
      break;
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      extension.at("height");
      shape.params = {radius, height, 0.0f, 0.0f};
      break;
    case ShapeKind::torus:
      extension.at("tubeRadius");
      shape.params = {radius, tube, 0.0f, 0.0f};
      break;
    case ShapeKind::sphere:
    case ShapeKind::disk:
      shape.params = {radius, 0.0f, 0.0f, 0.0f};
      break;
  }
  return shape;
}

}  // namespace crosslight::gltf
