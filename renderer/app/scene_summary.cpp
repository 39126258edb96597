#include "app/scene_summary.h"

#include <fmt/format.h>

#include <numbers>

#include "app/suggest.h"
#include "base/log.h"
#include "base/text.h"
#include "scene/shape_mesh.h"
#include "structs.h"

namespace crosslight {
namespace {

template <class T>
std::uint64_t bytesOf(const std::vector<T>& items) {
  return items.size() * sizeof(T);
}

double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

template <class V>
Json vectorJson(const V& v) {
  return Json::array({v.x, v.y, v.z});
}

std::string named(const std::string& name) { return name.empty() ? "(no name)" : printable(name); }

const char* nameOf(AlphaMode mode) {
  switch (mode) {
    case AlphaMode::opaque:
      return "opaque";
    case AlphaMode::mask:
      return "mask";
    case AlphaMode::blend:
      return "blend";
  }
  return "";
}

// Which textures a material has, by the names of glTF.
std::vector<std::string> texturesOf(const Material& material) {
  std::vector<std::string> names;
  if (material.baseColorTexture.present()) names.push_back("baseColor");
  if (material.metallicRoughnessTexture.present()) names.push_back("metallicRoughness");
  if (material.normalTexture.present()) names.push_back("normal");
  if (material.occlusionTexture.present()) names.push_back("occlusion");
  if (material.emissiveTexture.present()) names.push_back("emissive");
  return names;
}

std::string cameraLine(const Camera& camera) {
  const std::string range =
      fmt::format("near {:g}, far {}", camera.zNear, camera.zFar ? fmt::format("{:g}", *camera.zFar) : "infinite");
  if (camera.orthographic) {
    return fmt::format("orthographic, {:g} x {:g}, {}", 2 * camera.xMag, 2 * camera.yMag, range);
  }
  return fmt::format("perspective, {:.4g} degrees high, {}", degrees(camera.yFov), range);
}

std::string lightLine(const Light& light) {
  if (light.classic) return fmt::format("{}, classic", nameOf(light.type));
  const bool area = (1u << static_cast<std::uint32_t>(light.type)) & shared::kAreaLightTypes;
  const char* unit = area ? "nit" : light.type == LightType::directional ? "lux" : "candela";
  return fmt::format("{}, {:g} {}, color {:g} {:g} {:g}", nameOf(light.type), light.intensity, unit, light.color.x,
                     light.color.y, light.color.z);
}

std::string materialLine(const Material& material) {
  std::string text = std::string(nameOf(material.model)) + ", " + nameOf(material.alphaMode);
  if (material.doubleSided) text += ", two-sided";
  if (!material.classic.preset.empty()) text += ", preset " + material.classic.preset;
  if (material.transmissionFactor > 0) text += fmt::format(", transmission {:g}", material.transmissionFactor);
  if (material.priority) text += fmt::format(", priority {}", *material.priority);
  if (material.dispersion > 0) text += fmt::format(", dispersion {:g}", material.dispersion);
  const auto textures = texturesOf(material);
  if (!textures.empty()) text += ", textures " + joined(textures, " ");
  return text;
}

Json cameraJson(const Camera& camera) {
  Json json = {{"name", camera.name}, {"type", camera.orthographic ? "orthographic" : "perspective"}};
  if (camera.orthographic) {
    json["xMag"] = camera.xMag;
    json["yMag"] = camera.yMag;
  } else {
    json["yFovRadians"] = camera.yFov;
  }
  json["zNear"] = camera.zNear;
  json["zFar"] = camera.zFar ? Json(*camera.zFar) : Json(nullptr);
  json["position"] = vectorJson(camera.worldFromCamera[3]);
  return json;
}

Json lightJson(const Light& light) {
  Json json = {{"name", light.name}, {"type", nameOf(light.type)}, {"classic", light.classic.has_value()}};
  json["color"] = vectorJson(light.classic ? light.classic->diffuse : light.color);
  json["intensity"] = light.classic ? Json(nullptr) : Json(light.intensity);
  json["position"] = vectorJson(light.worldPosition);
  json["direction"] = vectorJson(light.worldDirection);
  if (light.radius > 0) json["radius"] = light.radius;
  if (light.worldU != glm::dvec3(0.0)) json["axes"] = Json::array({vectorJson(light.worldU), vectorJson(light.worldV)});
  return json;
}

const char* nameOf(FogMode mode) {
  switch (mode) {
    case FogMode::none:
      return "none";
    case FogMode::linear:
      return "linear";
    case FogMode::exp:
      return "exp";
    case FogMode::exp2:
      break;
  }
  return "exp2";
}

const char* nameOf(SmokeShape shape) {
  switch (shape) {
    case SmokeShape::none:
      return "none";
    case SmokeShape::everywhere:
      return "everywhere";
    case SmokeShape::box:
      return "box";
    case SmokeShape::sphere:
      break;
  }
  return "sphere";
}

std::string smokeLine(const Smoke& s) {
  const std::string grid =
      s.densities.empty() ? "even" : fmt::format("{} x {} x {} densities", s.grid[0], s.grid[1], s.grid[2]);
  return fmt::format("{}, {}, absorption {:g} {:g} {:g}, scattering {:g} {:g} {:g} per unit, anisotropy {:g}",
                     nameOf(s.shape), grid, s.absorption.x, s.absorption.y, s.absorption.z, s.scattering.x,
                     s.scattering.y, s.scattering.z, s.anisotropy);
}

Json smokeJson(const Smoke& s) {
  if (!hasSmoke(s)) return nullptr;
  return {{"shape", nameOf(s.shape)},
          {"absorption", vectorJson(s.absorption)},
          {"scattering", vectorJson(s.scattering)},
          {"anisotropy", s.anisotropy},
          {"grid", s.grid}};
}

std::string airLine(const Atmosphere& a) {
  if (!hasFog(a)) return "clear";
  const glm::vec3& c = a.fogColor;
  const std::string extent = a.fogMode == FogMode::linear ? fmt::format("from {:g} to {:g}", a.fogStart, a.fogEnd)
                                                          : fmt::format("density {:g} per unit", a.fogDensity);
  return fmt::format("{} fog, {}, color {:g} {:g} {:g}", nameOf(a.fogMode), extent, c.x, c.y, c.z);
}

Json environmentJson(const Environment& e) {
  if (e.file.empty()) return nullptr;
  return {{"file", e.file.string()}, {"intensity", e.intensity}, {"rotationRadians", e.rotation}};
}

Json fogJson(const Atmosphere& a) {
  if (!hasFog(a)) return nullptr;
  Json json = {{"mode", nameOf(a.fogMode)}, {"color", vectorJson(a.fogColor)}};
  if (a.fogMode == FogMode::linear) {
    json["start"] = a.fogStart;
    json["end"] = a.fogEnd;
  } else {
    json["density"] = a.fogDensity;
  }
  return json;
}

Json materialJson(const Material& material) {
  return {{"name", material.name},
          {"model", nameOf(material.model)},
          {"alphaMode", nameOf(material.alphaMode)},
          {"doubleSided", material.doubleSided},
          {"preset", material.classic.preset},
          {"transmission", material.transmissionFactor},
          {"textures", texturesOf(material)}};
}

std::string row(const std::string& name, const std::string& text) { return fmt::format("{:<12}{}\n", name, text); }

}  // namespace

std::uint64_t hostBytesOf(const Scene& scene) {
  std::uint64_t bytes = 0;
  for (const TextureImage& image : scene.images) bytes += bytesOf(image.rgba);
  for (const Mesh& mesh : scene.meshes) {
    for (const Primitive& p : mesh.primitives) {
      bytes += bytesOf(p.positions) + bytesOf(p.normals) + bytesOf(p.tangents) + bytesOf(p.uv0) + bytesOf(p.uv1) +
               bytesOf(p.colors) + bytesOf(p.indices);
    }
  }
  return bytes;
}

std::string sceneTable(const Scene& scene) {
  const SceneStats& stats = scene.stats;
  std::string text =
      row("file", fmt::format("{} ({} bytes with what it refers to)", scene.source.string(), stats.fileBytes));
  text += row("scene", fmt::format("{} of {}", named(scene.name), std::max<std::size_t>(1, stats.sceneNames.size())));
  text +=
      row("geometry", fmt::format("{} triangles, {} vertices, {} meshes, {} instances, {} analytic shapes, {} nodes",
                                  stats.triangles, stats.vertices, scene.meshes.size(), scene.instances.size(),
                                  scene.shapes.size(), stats.nodes));
  if (!scene.worldBounds.empty()) {
    const glm::dvec3 &a = scene.worldBounds.lower, &b = scene.worldBounds.upper;
    text += row("bounds", fmt::format("{:g} {:g} {:g} to {:g} {:g} {:g}", a.x, a.y, a.z, b.x, b.y, b.z));
  }
  text += row("air", airLine(scene.atmosphere));
  if (const Environment& e = scene.atmosphere.environment; !e.file.empty()) {
    text += row("environment", fmt::format("{}, intensity {:g}, turned by {:.4g} degrees",
                                           printable(e.file.filename().string()), e.intensity, degrees(e.rotation)));
  }
  if (hasSmoke(scene.atmosphere.smoke)) text += row("smoke", smokeLine(scene.atmosphere.smoke));
  text += row("images", fmt::format("{}", scene.images.size()));
  text += row("animations", fmt::format("{}", stats.animations));
  text += row("memory", fmt::format("{:.1f} MiB on the host", static_cast<double>(hostBytesOf(scene)) / (1 << 20)));
  text += row("extensions", stats.extensionsUsed.empty() ? "none" : named(joined(stats.extensionsUsed, ", ")));
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    const std::string origin = scene.defaultCamera ? " (made to frame the bounds: the file has none)" : "";
    text +=
        row(fmt::format("camera {}", i), named(scene.cameras[i].name) + ": " + cameraLine(scene.cameras[i]) + origin);
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const std::string origin = scene.defaultLight ? " (a headlight: the file has none)" : "";
    text += row(fmt::format("light {}", i), named(scene.lights[i].name) + ": " + lightLine(scene.lights[i]) + origin);
  }
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    text +=
        row(fmt::format("material {}", i), named(scene.materials[i].name) + ": " + materialLine(scene.materials[i]));
  }
  return text;
}

Json sceneJson(const Scene& scene) {
  const SceneStats& stats = scene.stats;
  Json json = {{"file", scene.source.string()}, {"fileBytes", stats.fileBytes}, {"name", scene.name}};
  json["scenes"] = stats.sceneNames;
  json["counts"] = {{"triangles", stats.triangles},  {"vertices", stats.vertices},
                    {"meshes", scene.meshes.size()}, {"instances", scene.instances.size()},
                    {"shapes", scene.shapes.size()}, {"nodes", stats.nodes},
                    {"images", scene.images.size()}, {"animations", stats.animations}};
  json["bounds"] =
      scene.worldBounds.empty()
          ? Json(nullptr)
          : Json({{"lower", vectorJson(scene.worldBounds.lower)}, {"upper", vectorJson(scene.worldBounds.upper)}});
  json["hostBytes"] = hostBytesOf(scene);
  json["extensions"] = stats.extensionsUsed;
  json["defaultCamera"] = scene.defaultCamera;
  json["defaultLight"] = scene.defaultLight;
  json["fog"] = fogJson(scene.atmosphere);
  json["environment"] = environmentJson(scene.atmosphere.environment);
  json["smoke"] = smokeJson(scene.atmosphere.smoke);
  json["cameras"] = json["lights"] = json["materials"] = Json::array();
  for (const Camera& camera : scene.cameras) json["cameras"].push_back(cameraJson(camera));
  for (const Light& light : scene.lights) json["lights"].push_back(lightJson(light));
  for (const Material& material : scene.materials) json["materials"].push_back(materialJson(material));
  for (const ShapeInstance& shape : scene.shapes) {
    json["shapes"].push_back({{"name", shape.name}, {"kind", nameOf(shape.kind)}});
  }
  return json;
}

}  // namespace crosslight
