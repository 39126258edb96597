#include "oracle/povray.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "image/image_io.h"

namespace crosslight::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

[[noreturn]] void cannotSay(const std::string& what) { throw std::runtime_error("POV-Ray has no word for " + what); }

// All digits: what is compared must not be rounded twice.
template <class Vector>
std::string vec(const Vector& v) {
  return fmt::format("<{:.17g},{:.17g},{:.17g}>", double(v.x), double(v.y), double(v.z));
}
template <class Vector>
std::string rgb(const Vector& v) {
  return "rgb " + vec(v);
}

bool isGray(const glm::vec3& v) { return v.x == v.y && v.y == v.z; }

// POV-Ray's terms are scalars times the pigment (ambient, diffuse) or the light alone (highlights), so ks and kr must
// be gray and ka a multiple of kd; the pigment takes kd's color. Fog, highlights and shadows are as the material's are.
std::string finishOf(const Material& m, const glm::vec3& ambientLight) {
  const ClassicMaterial& c = m.classic;
  if (!isGray(c.specularFactor) || !isGray(c.reflectionFactor)) cannotSay("colored highlights or mirrors");
  // ambient_light is left at 1; ambient may be colored, and multiplies the pigment.
  const auto ratio = [](float a, float d) {
    if (a == 0) return 0.0;
    if (d == 0) cannotSay("ambient light on what has no diffuse color");
    return double(a) / d;
  };
  const glm::dvec3 ambient(ambientLight.x * ratio(c.ambientFactor.x, c.diffuseFactor.x),
                           ambientLight.y * ratio(c.ambientFactor.y, c.diffuseFactor.y),
                           ambientLight.z * ratio(c.ambientFactor.z, c.diffuseFactor.z));
  std::string text = fmt::format("finish {{ diffuse 1 ambient {} ", rgb(ambient));
  if (m.model == IlluminationModel::phong) {
    text += fmt::format("phong {:.17g} phong_size {:.17g} ", c.specularFactor.x, c.shininess);
  } else if (m.model == IlluminationModel::blinnPhong) {
    text += fmt::format("specular {:.17g} roughness {:.17g} ", c.specularFactor.x, 1.0 / double(c.shininess));
  }
  if (c.reflectionFactor.x > 0) text += fmt::format("reflection {{ {:.17g} }} ", c.reflectionFactor.x);
  return text + "}";
}

// A smooth dielectric of glTF: Fresnel's equations, what is not mirrored passes.
std::string dielectric(const Material& m) {
  if (m.metallicFactor != 0 || m.transmissionFactor != 1 || glm::vec3(m.baseColorFactor) != glm::vec3(1.0f))
    cannotSay("this metallic-roughness material");
  return fmt::format(
      "texture {{ pigment {{ rgbt <1,1,1,1> }} finish {{ ambient 0 diffuse 0 reflection {{ 0, 1 fresnel on }} "
      "conserve_energy }} }} interior {{ ior {:.17g} }}",
      m.indexOfRefraction);
}

std::string materialOf(const Material& m, const Scene& scene) {
  if (m.model == IlluminationModel::cookTorrance) return dielectric(m);
  if (m.emissiveFactor != glm::vec3(0.0f)) cannotSay("emission beside classic terms");
  const ClassicMaterial& c = m.classic;
  std::string interior;
  if (c.transparency > 0 && m.hasIor) interior = fmt::format(" interior {{ ior {:.17g} }}", m.indexOfRefraction);
  return fmt::format("texture {{ pigment {{ {} transmit {:.17g} }} {} }}{}", rgb(c.diffuseFactor), c.transparency,
                     finishOf(m, scene.atmosphere.ambient), interior);
}

std::string shapeText(const ShapeInstance& s) {
  switch (s.kind) {
    case ShapeKind::sphere:
      return fmt::format("sphere {{ 0, {:.17g} ", s.params.x);
    case ShapeKind::plane:
      return "plane { y, 0 ";
    case ShapeKind::disk:
      return fmt::format("disc {{ 0, y, {:.17g} ", s.params.x);
    case ShapeKind::box: {
      const glm::dvec3 half = 0.5 * glm::dvec3(s.params);
      return fmt::format("box {{ {}, {} ", vec(-half), vec(half));
    }
    case ShapeKind::cylinder:
      return fmt::format("cylinder {{ {:.17g}*y, {:.17g}*y, {:.17g} ", -0.5 * double(s.params.y),
                         0.5 * double(s.params.y), s.params.x);
    case ShapeKind::cone:
      return fmt::format("cone {{ {:.17g}*y, {:.17g}, {:.17g}*y, 0 ", -0.5 * double(s.params.y), s.params.x,
                         0.5 * double(s.params.y));
    case ShapeKind::torus:
      return fmt::format("torus {{ {:.17g}, {:.17g} sturm ", s.params.x, s.params.y);
  }
  cannotSay("this shape");
}

std::string matrixOf(const glm::dmat4& m) {
  std::string text = "matrix <";
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) text += fmt::format("{}{:.17g}", column + row ? "," : "", m[column][row]);
  }
  return text + ">";
}

std::string meshText(const Mesh& mesh, const glm::dmat4& worldFromObject, const Scene& scene, const std::string& rest) {
  std::string text;
  for (const Primitive& p : mesh.primitives) {
    text += "mesh {\n";
    for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
      text += "triangle { ";
      for (std::size_t k = 0; k < 3; ++k) {
        text +=
            vec(glm::dvec3(worldFromObject * glm::dvec4(p.positions[p.indices[i + k]], 1.0))) + (k < 2 ? "," : " }\n");
      }
    }
    text += materialOf(scene.materials[static_cast<std::size_t>(p.material)], scene) + rest + " }\n";
  }
  return text;
}

// POV-Ray's fade is 2 / (1 + (d / distance)^power): half constant, half linear or quadratic.
std::string fadeOf(const glm::vec3& k) {
  if (k == glm::vec3(1, 0, 0)) return "";
  if (k.x != 0.5f || (k.y > 0) == (k.z > 0)) cannotSay("this attenuation");
  return k.z > 0 ? fmt::format(" fade_distance {:.17g} fade_power 2", std::sqrt(0.5 / double(k.z)))
                 : fmt::format(" fade_distance {:.17g} fade_power 1", 0.5 / double(k.y));
}

std::string lightText(const Light& light) {
  if (!light.classic) cannotSay("a light of glTF");
  const ClassicLight& c = *light.classic;
  if (c.diffuse != c.specular || c.ambient != glm::vec3(0.0f)) cannotSay("a light with several colors");
  std::string text = fmt::format("light_source {{ {}, {}", vec(light.worldPosition), rgb(c.diffuse));
  if (light.type == LightType::directional) {
    text = fmt::format("light_source {{ {}, {} parallel point_at {}", vec(-1e6 * light.worldDirection), rgb(c.diffuse),
                       vec(glm::dvec3(0.0)));
  } else if (light.type == LightType::spot) {
    text += fmt::format(" spotlight point_at {} radius {:.17g} falloff {:.17g} tightness {:.17g}",
                        vec(light.worldPosition + light.worldDirection), c.spotCutoff, c.spotCutoff, c.spotExponent);
  }
  return text + (light.type == LightType::directional ? "" : fadeOf(c.attenuation)) + " }\n";
}

std::string fogText(const Atmosphere& a) {
  if (a.fogMode == FogMode::none) return "";
  if (a.fogMode != FogMode::exp) cannotSay("fog that is not exponential");
  return fmt::format("fog {{ fog_type 1 distance {:.17g} color {} }}\n", 1.0 / a.fogDensity, rgb(a.fogColor));
}

std::string cameraText(const Camera& camera, const PovraySettings& s) {
  const glm::dmat3 axes(camera.worldFromCamera);
  const double halfY = std::tan(0.5 * camera.yFov), halfX = halfY * s.width / s.height;
  if (camera.orthographic) cannotSay("an orthographic camera of ours");
  return fmt::format("camera {{ location {} direction {} right {} up {} }}\n",
                     vec(glm::dvec3(camera.worldFromCamera[3])), vec(-glm::normalize(axes[2])),
                     vec(2 * halfX * glm::normalize(axes[0])), vec(2 * halfY * glm::normalize(axes[1])));
}

std::string sceneText(const Scene& scene, const PovraySettings& s) {
  const std::string rest = s.shadows ? "" : " no_shadow";
  std::string text = fmt::format(
      "#version 3.7;\nglobal_settings {{ assumed_gamma 1.0 max_trace_level {} adc_bailout 0 }}\n"
      "background {{ {} }}\n",
      s.maxDepth + 1, rgb(scene.atmosphere.background));
  text += cameraText(scene.cameras.at(0), s) + fogText(scene.atmosphere);
  for (const Light& light : scene.lights) text += lightText(light);
  for (const ShapeInstance& shape : scene.shapes) {
    text += shapeText(shape) + materialOf(scene.materials[static_cast<std::size_t>(shape.material)], scene) + " " +
            matrixOf(shape.worldFromObject) + rest + " }\n";
  }
  for (const MeshInstance& mesh : scene.instances) {
    if (!mesh.replacedByShape)
      text += meshText(scene.meshes[static_cast<std::size_t>(mesh.mesh)], mesh.worldFromObject, scene, rest);
  }
  return text;
}

}  // namespace

bool havePovray() { return std::system("povray --version >/dev/null 2>&1") == 0; }

std::vector<std::array<float, 3>> drawPovray(const Scene& scene, const PovraySettings& settings,
                                             const std::filesystem::path& scratch) {
  const std::filesystem::path source = scratch / "scene.pov", picture = scratch / "scene.png",
                              log = scratch / "scene.log";
  std::ofstream(source) << sceneText(scene, settings);
  const std::string command =
      fmt::format("povray +I'{}' +O'{}' +W{} +H{} +FN16 -D -A File_Gamma=1.0 +WT1 >'{}' 2>&1", source.string(),
                  picture.string(), settings.width, settings.height, log.string());
  if (std::system(command.c_str()) != 0) {
    std::ifstream in(log);
    throw std::runtime_error("POV-Ray failed: " + std::string(std::istreambuf_iterator<char>(in), {}));
  }
  // The file says that its values are linear, which readers of PNG may or may not heed: the encoding is undone here.
  const Image image = readImage(picture);
  std::vector<std::array<float, 3>> pixels;
  const std::vector<float>& samples = image.picture().samples;
  const std::size_t channels = image.picture().channels();
  for (std::size_t i = 0; i + channels <= samples.size(); i += channels)
    pixels.push_back({srgbFromLinear(samples[i]), srgbFromLinear(samples[i + 1]), srgbFromLinear(samples[i + 2])});
  return pixels;
}

}  // namespace crosslight::testing
