// Files that others made: each renders by every method, shows what a double-precision ray on the host sees, and shows
// the same objects by raster and by rays. The files are found by the environment variable CROSSLIGHT_ASSETS.
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "accel/intersect.h"
#include "base/error.h"
#include "structs.h"
#include "support/render_fixture.h"

namespace crosslight::testing {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kWidth = 48, kHeight = 36;
constexpr std::uint32_t kStep = 4;        // every fourth pixel of every fourth row is asked of the host
constexpr double kSameObject = 0.999;     // of interior pixels
constexpr double kSeenAsExpected = 0.98;  // of the host's rays; some pass within rounding of a silhouette

fs::path assetsFolder() {
  const char* folder = std::getenv("CROSSLIGHT_ASSETS");
  return folder ? fs::path(folder) : fs::path();
}

// Without a complaint of Khronos' validator, whose report lies beside the file; scenes of other sources have none.
bool isValid(const fs::path& file) {
  std::ifstream report(file.string() + ".report.json");
  return !report || nlohmann::json::parse(report).at("issues").at("numErrors") == 0;
}

// Relative to the folder; one empty name where there is none, so that the skip is seen.
std::vector<std::string> assetFiles(std::initializer_list<const char*> groups) {
  std::vector<std::string> names;
  const fs::path assets = assetsFolder();
  for (const char* group : groups) {
    if (assets.empty() || !fs::is_directory(assets / group)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(assets / group)) {
      const fs::path extension = entry.path().extension();
      if ((extension != ".gltf" && extension != ".glb") || !isValid(entry.path())) continue;
      names.push_back(fs::relative(entry.path(), assets).string());
    }
  }
  std::sort(names.begin(), names.end());
  if (names.empty()) names.emplace_back();
  return names;
}

RenderSettings plainSettings(Method method) {
  RenderSettings s = settingsFor(method, kWidth, kHeight);
  s.shadows = s.reflection = s.refraction = false;  // what raster does not claim
  s.aovs = {"instanceId"};
  return s;
}

bool hitsAnything(const Image& image) {
  for (std::size_t i = 3; i < image.picture().samples.size(); i += 4) {
    if (image.picture().samples[i] > 0.0f) return true;
  }
  return false;
}

struct HostTriangle {
  oracle::Triangle corners;  // relative to the camera
  glm::dvec3 front;          // normal of the side whose corners run counter-clockwise
  bool bothSides;
};

// What must be seen: neither cut by a mask nor let through by blending.
std::vector<HostTriangle> solidTriangles(const Scene& scene, const glm::dvec3& origin) {
  std::vector<HostTriangle> triangles;
  for (const MeshInstance& instance : scene.instances) {
    const bool mirrors = glm::determinant(glm::dmat3(instance.worldFromObject)) < 0;
    for (const Primitive& p : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
      const Material& material = scene.materials[static_cast<std::size_t>(p.material)];
      if (material.alphaMode != AlphaMode::opaque) continue;
      const auto corner = [&](std::size_t i) {
        const glm::dvec4 object(glm::dvec3(p.positions[p.indices[i]]), 1.0);
        return glm::dvec3(instance.worldFromObject * object) - origin;
      };
      for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
        const glm::dvec3 a = corner(i), b = corner(i + 1), c = corner(i + 2);
        const glm::dvec3 n = glm::cross(b - a, c - a) * (mirrors ? -1.0 : 1.0);
        triangles.push_back({{glm::vec3(a), glm::vec3(b), glm::vec3(c)}, n, material.doubleSided});
      }
    }
  }
  return triangles;
}

// The camera's ray through a pixel's center; t counts along the view direction.
oracle::Ray rayThrough(const Camera& camera, std::uint32_t x, std::uint32_t y) {
  const glm::dmat3 axes(camera.worldFromCamera);
  const double halfY = camera.orthographic ? camera.yMag : std::tan(0.5 * camera.yFov);
  const double u = (2.0 * (x + 0.5) / kWidth - 1.0) * halfY * kWidth / kHeight;
  const double v = (1.0 - 2.0 * (y + 0.5) / kHeight) * halfY;
  const glm::dvec3 aside = u * axes[0] + v * axes[1];
  oracle::Ray ray;
  ray.origin = camera.orthographic ? aside : glm::dvec3(0.0);
  ray.direction = camera.orthographic ? -axes[2] : aside - axes[2];
  ray.tMin = camera.zNear;
  if (camera.zFar) ray.tMax = *camera.zFar;
  return ray;
}

// Of a sparse grid of pixels: how many the host's rays hit, and how many of these a picture shows.
struct Seen {
  std::size_t expected = 0, shown = 0;
};

Seen compareWithHost(const Scene& scene, const Image& image) {
  const Camera& camera = scene.cameras.at(0);
  const std::vector<HostTriangle> triangles = solidTriangles(scene, glm::dvec3(camera.worldFromCamera[3]));
  const std::vector<std::uint32_t>& ids = image.find("instanceId")->integers;
  Seen seen;
  for (std::uint32_t y = kStep / 2; y < kHeight; y += kStep) {
    for (std::uint32_t x = kStep / 2; x < kWidth; x += kStep) {
      const oracle::Ray ray = rayThrough(camera, x, y);
      const bool hit = std::any_of(triangles.begin(), triangles.end(), [&](const HostTriangle& t) {
        return (t.bothSides || glm::dot(t.front, ray.direction) < 0) &&
               oracle::intersectTriangle<double>(t.corners, ray).has_value();
      });
      seen.expected += hit;
      seen.shown += hit && ids[std::size_t{y} * kWidth + x] != shared::kNoId;
    }
  }
  return seen;
}

// Two nodes may put the same mesh in the same place (vulkan-samples' transparent scene does): which of them shows is
// nobody's promise, so the first stands for all.
std::vector<std::uint32_t> firstTwins(const Scene& scene) {
  std::vector<std::uint32_t> twin(scene.instanceCount);
  std::iota(twin.begin(), twin.end(), 0u);
  if (scene.instances.size() > 1000) return twin;  // pairs by the million: of no file so far
  for (const MeshInstance& a : scene.instances) {
    for (const MeshInstance& b : scene.instances) {
      const bool same = a.mesh == b.mesh && a.worldFromObject == b.worldFromObject;
      if (same && b.instanceId < a.instanceId) twin[a.instanceId] = std::min(twin[a.instanceId], b.instanceId);
    }
  }
  return twin;
}

void expectSameObjects(const Scene& scene, const Image& raster, const Image& rays) {
  const Interior insideRaster(raster), insideRays(rays);
  const std::vector<std::uint32_t> twin = firstTwins(scene);
  const auto objectAt = [&](const Interior& image, std::uint32_t x, std::uint32_t y) {
    const std::uint32_t id = image.idAt(x, y);
    return id == shared::kNoId ? id : twin.at(id);
  };
  std::size_t interior = 0, same = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      if (!insideRaster(x, y) || !insideRays(x, y)) continue;
      ++interior;
      same += objectAt(insideRaster, x, y) == objectAt(insideRays, x, y);
    }
  }
  EXPECT_TRUE(static_cast<double>(same) >= kSameObject * static_cast<double>(interior))
      << same << " of " << interior << " interior pixels show the same object";
}

class Assets : public ::testing::TestWithParam<std::string> {
 protected:
  // None, and the test skipped, where the file is absent or refused: which files must load is the loader's own test.
  std::optional<Scene> load() const {
    if (GetParam().empty()) return std::nullopt;
    try {
      return loadScene(assetsFolder() / GetParam());
    } catch (const InputError& error) {
      EXPECT_EQ(GetParam().rfind("gltf-validator", 0), 0u) << error.what();
      std::cout << "refused: " << error.what() << '\n';
      return std::nullopt;
    }
  }
};

constexpr const char* kAbsent =
    "set CROSSLIGHT_ASSETS to the folder that holds khronos-blender-io, vulkan-samples, ...; or the file was refused";

TEST_P(Assets, renderByEveryMethod) {
  const std::optional<Scene> loaded = load();
  if (!loaded) GTEST_SKIP() << kAbsent;
  const Scene& scene = *loaded;
  std::map<Method, Image> images;
  for (const Method method : allMethods()) {
    RenderResult result = render(device(), scene, plainSettings(method));
    EXPECT_EQ(result.report.nonfinite, 0u) << nameOf(method);
    for (const float v : result.image.picture().samples) ASSERT_TRUE(std::isfinite(v)) << nameOf(method);
    images[method] = std::move(result.image);
  }
  bool visible = false;
  for (const Method method : {Method::phong, Method::whitted}) {
    const Seen seen = compareWithHost(scene, images[method]);
    visible = seen.expected > 0;
    RecordProperty(std::string("expected_") + nameOf(method), std::to_string(seen.expected));
    EXPECT_TRUE(static_cast<double>(seen.shown) >= kSeenAsExpected * static_cast<double>(seen.expected))
        << nameOf(method) << " shows something in " << seen.shown << " of " << seen.expected << " pixels";
  }
  for (const auto& [method, image] : images) EXPECT_TRUE(!visible || hitsAnything(image)) << nameOf(method);
  expectSameObjects(scene, images[Method::phong], images[Method::whitted]);
}

// With everything that rays can do, where the difference to raster lies.
class Scenes : public Assets {};

TEST_P(Scenes, renderWithShadowsMirrorsAndGlass) {
  const std::optional<Scene> scene = load();
  if (!scene) GTEST_SKIP() << kAbsent;
  const RenderResult result = render(device(), *scene, settingsFor(Method::whitted, kWidth, kHeight));
  EXPECT_EQ(result.report.nonfinite, 0u);
  EXPECT_EQ(result.report.counters.at("traversalsCapped"), 0u);
}

std::string testName(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param.empty() ? "none" : info.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
}

const std::initializer_list<const char*> kSceneGroups{"khronos-blender-io", "vulkan-samples", "trimesh", "bevy"};
INSTANTIATE_TEST_SUITE_P(Files, Assets, ::testing::ValuesIn(assetFiles(kSceneGroups)), testName);
INSTANTIATE_TEST_SUITE_P(Files, Scenes, ::testing::ValuesIn(assetFiles(kSceneGroups)), testName);
INSTANTIATE_TEST_SUITE_P(ValidatorFiles, Assets, ::testing::ValuesIn(assetFiles({"gltf-validator"})), testName);

}  // namespace
}  // namespace crosslight::testing
