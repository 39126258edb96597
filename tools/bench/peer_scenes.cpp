#include "bench/peer_scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "scenegen/parts.h"
#include "upload/flatten.h"

namespace crosslight::bench {
namespace {

using glm::dvec3;

// What passes the glass is not dimmed: POV-Ray dims a shadow at every surface, we once per solid.
struct Ball {
  dvec3 center;
  double radius;
  bool glass;
};
constexpr double kGlassIndex = 1.5, kGlassTransmission = 1.0, kGlassMirror = 0.1, kMirror = 0.75, kShininess = 60.0;
const dvec3 kFloorPaint{0.55, 0.5, 0.42}, kMirrorPaint{0.1, 0.12, 0.15}, kHighlight{0.4}, kSky{0.2, 0.3, 0.45};
const dvec3 kLamp{0.75}, kLampPosition{-5.0, 9.0, 6.0};
constexpr double kAmbient = 0.25;

// Two rows, mirrors and glass in turns, the back row higher and larger.
std::vector<Ball> balls() {
  std::vector<Ball> result;
  for (int i = 0; i < 5; ++i) {
    const double x = -3.0 + 1.5 * i;
    result.push_back({{x, 0.6, 1.2}, 0.6, i % 2 == 0});
    result.push_back({{1.3 * x, 1.2, -1.4}, 0.9, i % 2 != 0});
  }
  return result;
}

struct View {
  dvec3 eye, right, up, forward;
  double tangent;  // of half the vertical field of view

  explicit View(const Camera& camera)
      : eye(camera.worldFromCamera[3]),
        right(camera.worldFromCamera[0]),
        up(camera.worldFromCamera[1]),
        forward(-dvec3(camera.worldFromCamera[2])),
        tangent(std::tan(camera.yFov / 2.0)) {}
};

// Small pieces of text, written at once in the end.
class Text {
 public:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Args>(args)...);
  }
  std::filesystem::path writeTo(const std::filesystem::path& file) const {
    std::ofstream out(file, std::ios::binary);
    out.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    out.close();
    if (!out) throw InputError(file.string(), "cannot be written");
    return file;
  }

 private:
  fmt::memory_buffer buffer_;
};

template <class Vector>
std::string pov(const Vector& v) {
  return fmt::format("<{},{},{}>", v.x, v.y, v.z);
}
template <class Vector>
std::string plain(const Vector& v) {
  return fmt::format("{} {} {}", v.x, v.y, v.z);
}

// POV-Ray's space is left-handed: `right` along our right, spelled out, keeps the picture from being mirrored.
void addPovHead(Text& text, const Scene& scene, unsigned traceLevel) {
  const View view(scene.cameras.at(0));
  const Light& light = scene.lights.at(0);
  text.add("#version 3.7;\nglobal_settings {{ assumed_gamma 1.0 max_trace_level {} adc_bailout 0 }}\n", traceLevel);
  text.add("camera {{ perspective location {} direction {} right {} up {} }}\n", pov(view.eye), pov(view.forward),
           pov(view.right * (2.0 * view.tangent)), pov(view.up * (2.0 * view.tangent)));
  text.add("light_source {{ {} color rgb {} }}\nbackground {{ color rgb {} }}\n", pov(light.worldPosition),
           pov(light.classic->diffuse), pov(scene.atmosphere.background));
}

// Its `ambient` is multiplied by the pigment; ours is ka Ia.
std::string povPaint(const dvec3& ambient, const dvec3& diffuse, const dvec3& highlight, double shininess) {
  const dvec3 share(ambient / glm::max(diffuse, dvec3(1e-9)));
  return fmt::format("pigment {{ color rgb {} }} finish {{ ambient rgb {} diffuse 1 specular {} roughness {} ",
                     pov(diffuse), pov(share), highlight.x, 1.0 / shininess);
}

FlatScene meshOf(const Scene& scene) { return flattenScene(scene, dvec3(0.0), false); }
const ClassicMaterial& paintOf(const Scene& scene, const FlatScene& mesh) {
  return scene.materials[mesh.draws.at(0).materialId].classic;
}

template <class Vector>
scenegen::Json listed(const Vector& v) {
  return {v.x, v.y, v.z};
}

template <class T>
void writeAll(std::ofstream& out, const std::vector<T>& values) {
  out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
}

}  // namespace

std::filesystem::path writeSpheresScene(const std::filesystem::path& folder) {
  using namespace scenegen;
  GltfBuilder gltf("spheres");
  const int floor =
      gltf.addMaterial(classicMaterial("floor", {.model = "lambert", .ka = kFloorPaint, .kd = kFloorPaint}));
  const int mirror = gltf.addMaterial(classicMaterial(
      "mirror",
      {.ka = kMirrorPaint, .kd = kMirrorPaint, .ks = kHighlight, .shininess = kShininess, .kr = dvec3(kMirror)}));
  Json glassy = classicMaterial("glass", {.ka = dvec3(0.0),
                                          .kd = dvec3(0.0),
                                          .ks = dvec3(0.0),
                                          .transparency = kGlassTransmission,
                                          .kr = dvec3(kGlassMirror)});
  glassy["extensions"]["KHR_materials_ior"] = {{"ior", kGlassIndex}};
  const int glass = gltf.addMaterial(std::move(glassy));
  gltf.addRoot(shapeNode(gltf, "floor", {ShapeKind::plane, dvec3(0.0), 8}, floor));
  for (const Ball& b : balls()) {
    const int material = b.glass ? glass : mirror;
    gltf.addRoot(shapeNode(gltf, "ball", {.params = {b.radius, 0.0, 0.0}, .segments = 24}, material, b.center));
  }
  addPointLight(gltf, "lamp", kLampPosition, {.color = kLamp});
  addCamera(gltf, {.eye = {0.5, 3.6, 9.0}, .target = {0.0, 0.8, -0.3}, .yFovDegrees = 46.0, .zNear = 0.5});
  setAtmosphere(gltf, kAmbient, kSky);
  gltf.write(folder, "spheres");
  return folder / "spheres.gltf";
}

std::filesystem::path writePovSpheres(const Scene& spheres, const std::filesystem::path& folder) {
  Text text;
  addPovHead(text, spheres, 6);  // it counts the camera's segment too
  text.add("#declare Mirror = texture {{ {} reflection {{ {} }} }} }}\n",
           povPaint(kMirrorPaint * kAmbient, kMirrorPaint, kHighlight, kShininess), kMirror);
  text.add(
      "#declare Glass = texture {{ pigment {{ color rgbt <0,0,0,{}> }} finish {{ ambient 0 diffuse 0 reflection "
      "{{ {} }} }} }}\n",
      kGlassTransmission, kGlassMirror);
  text.add("plane {{ y, 0 {} }} }}\n", povPaint(kFloorPaint * kAmbient, kFloorPaint, dvec3(0.0), 1.0));
  for (const Ball& b : balls()) {
    text.add("sphere {{ {}, {} texture {{ {} }} interior {{ ior {} }} }}\n", pov(b.center), b.radius,
             b.glass ? "Glass" : "Mirror", b.glass ? kGlassIndex : 1.0);
  }
  return text.writeTo(folder / "spheres.pov");
}

std::filesystem::path writePovMesh(const Scene& scene, const std::filesystem::path& folder) {
  const FlatScene mesh = meshOf(scene);
  const ClassicMaterial& m = paintOf(scene, mesh);
  Text text;
  addPovHead(text, scene, 1);
  text.add("mesh2 {{\nvertex_vectors {{ {}", mesh.positions.size());
  for (const glm::vec3& p : mesh.positions) text.add(",\n{}", pov(p));
  text.add(" }}\nnormal_vectors {{ {}", mesh.attributes.size());
  for (const shared::VertexAttributes& a : mesh.attributes) text.add(",\n{}", pov(a.renderNormal));
  text.add(" }}\nface_indices {{ {}", mesh.triangleCount());
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    text.add(",\n<{},{},{}>", mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
  }
  const dvec3 ambient = dvec3(m.ambientFactor) * dvec3(scene.atmosphere.ambient);
  text.add(" }}\n{} }}\n}}\n", povPaint(ambient, m.diffuseFactor, m.specularFactor, static_cast<double>(m.shininess)));
  return text.writeTo(folder / "mesh.pov");
}

std::filesystem::path writeTachyonMesh(const Scene& scene, std::uint32_t size, const std::filesystem::path& folder) {
  const FlatScene mesh = meshOf(scene);
  const ClassicMaterial& m = paintOf(scene, mesh);
  const View view(scene.cameras.at(0));
  const Light& light = scene.lights.at(0);
  // Its ambient light takes the paint's color; a grey one of the same mean is the nearest.
  const glm::vec3 ambient = m.ambientFactor * scene.atmosphere.ambient;
  const float share = (ambient.x + ambient.y + ambient.z) / (m.diffuseFactor.x + m.diffuseFactor.y + m.diffuseFactor.z);
  // Its space is left-handed, and its camera takes no right-hand side: all of the scene is mirrored instead.
  const auto mirrored = [](const auto& v) { return plain(dvec3(-v.x, v.y, v.z)); };
  Text text;
  text.add("BEGIN_SCENE\nRESOLUTION {} {}\nCAMERA\n  ZOOM {}\n  ASPECTRATIO 1.0\n  ANTIALIASING 0\n  RAYDEPTH 1\n",
           size, size, 0.5 / view.tangent);
  text.add("  CENTER {}\n  VIEWDIR {}\n  UPDIR {}\nEND_CAMERA\nBACKGROUND {}\n", mirrored(view.eye),
           mirrored(view.forward), mirrored(view.up), plain(scene.atmosphere.background));
  text.add("LIGHT CENTER {} RAD 0.001 COLOR {}\n", mirrored(light.worldPosition), plain(light.classic->diffuse));
  text.add("TEXDEF paint AMBIENT {} DIFFUSE 1 SPECULAR 0 OPACITY 1 PHONG PLASTIC {} PHONG_SIZE {} COLOR {} TEXFUNC 0\n",
           share, m.specularFactor.x, m.shininess, plain(m.diffuseFactor));
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::uint32_t v[] = {mesh.indices[i], mesh.indices[i + 2], mesh.indices[i + 1]};  // as mirrored
    text.add("STRI V0 {} V1 {} V2 {} ", mirrored(mesh.positions[v[0]]), mirrored(mesh.positions[v[1]]),
             mirrored(mesh.positions[v[2]]));
    text.add("N0 {} N1 {} N2 {} paint\n", mirrored(mesh.attributes[v[0]].renderNormal),
             mirrored(mesh.attributes[v[1]].renderNormal), mirrored(mesh.attributes[v[2]].renderNormal));
  }
  text.add("END_SCENE\n");
  return text.writeTo(folder / "mesh.tachyon");
}

std::filesystem::path writeBlenderMesh(const Scene& scene, const std::filesystem::path& folder) {
  const FlatScene mesh = meshOf(scene);
  const ClassicMaterial& m = paintOf(scene, mesh);
  const Light& light = scene.lights.at(0);
  const Camera& camera = scene.cameras.at(0);
  std::ofstream out(folder / "mesh.bin", std::ios::binary);
  writeAll(out, mesh.positions);
  writeAll(out, mesh.indices);
  out.close();
  if (!out) throw InputError((folder / "mesh.bin").string(), "cannot be written");
  scenegen::Json told = {{"vertices", mesh.positions.size()},
                         {"indices", mesh.indices.size()},
                         {"diffuse", listed(m.diffuseFactor)},
                         {"ambient", listed(m.ambientFactor * scene.atmosphere.ambient)},
                         {"light", listed(light.classic->diffuse)},
                         {"lamp", listed(light.worldPosition)},
                         {"yFov", camera.yFov}};
  for (int row = 0; row < 4; ++row) {
    const glm::dmat4& c = camera.worldFromCamera;
    told["camera"].push_back({c[0][row], c[1][row], c[2][row], c[3][row]});
  }
  Text text;
  text.add("{}", told.dump());
  return text.writeTo(folder / "mesh.json");
}

std::filesystem::path writeWithoutLights(const std::filesystem::path& gltf, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::ifstream in(gltf);
  scenegen::Json root = scenegen::Json::parse(in);
  for (const char* key : {"cameras", "extensions", "extensionsUsed", "extensionsRequired"}) root.erase(key);
  for (scenegen::Json& scene : root.at("scenes")) scene.erase("extensions");
  for (scenegen::Json& node : root.at("nodes")) node.erase("camera"), node.erase("extensions");
  for (scenegen::Json& material : root.at("materials")) material.erase("extensions");
  for (const scenegen::Json& buffer : root.at("buffers")) {
    const std::string name = buffer.at("uri");
    std::filesystem::copy_file(gltf.parent_path() / name, folder / name,
                               std::filesystem::copy_options::overwrite_existing);
  }
  Text text;
  text.add("{}", root.dump());
  return text.writeTo(folder / gltf.filename());
}

}  // namespace crosslight::bench
