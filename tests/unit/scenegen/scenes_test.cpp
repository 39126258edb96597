// The generated files: the same bytes as those that are committed, and cameras that see what they are about.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "scenegen/png.h"
#include "scenegen/registry.h"
#include "unit/scenegen/scene_file.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;
namespace fs = std::filesystem;

const fs::path kCommitted = fs::path(CROSSLIGHT_SOURCE_DIR) / "scenes";

std::set<std::string> generatedNames(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).generic_string();
    const bool isSchema = name.starts_with("schema/");
    if (entry.is_regular_file() && !isSchema) names.insert(name);
  }
  return names;
}

TEST(Scenegen, regeneratesWhatIsCommittedByteForByte) {
  const fs::path folder = fs::path(testing::TempDir()) / "crosslight_scenegen";
  fs::remove_all(folder);
  writeAllScenes(folder);
  const auto fresh = generatedNames(folder);
  EXPECT_EQ(fresh, generatedNames(kCommitted)) << "run `scenegen scenes` and commit, or remove what has no generator";
  for (const std::string& name : fresh) {
    EXPECT_TRUE(contentsOf(folder / name) == contentsOf(kCommitted / name)) << name << ": run `scenegen scenes`";
  }
  fs::remove_all(folder);
}

TEST(Scenegen, staysSmall) {
  std::uintmax_t bytes = 0;
  for (const std::string& name : generatedNames(kCommitted)) bytes += fs::file_size(kCommitted / name);
  EXPECT_LE(bytes, 10u << 20);
}

TEST(Scenegen, namesEverySceneOnce) {
  std::set<std::string> paths;
  for (const SceneRow& row : allScenes()) {
    EXPECT_TRUE(paths.insert(row.path).second) << row.path;
    EXPECT_GT(std::string(row.purpose).size(), 10u);
  }
  EXPECT_GE(paths.size(), 40u);
}

struct Extent {
  double low = INFINITY, high = -INFINITY;
  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

struct Picture {
  Extent x, y, depth;  // x, y: -1 to 1 is a square picture
};

Picture pictureOf(const PlacedMesh& mesh, const PlacedCamera& camera) {
  Picture picture;
  const glm::dmat4 cameraFromWorld = glm::inverse(camera.worldFromCamera);
  for (const dvec3& corner : mesh.corners) {
    const dvec3 p(cameraFromWorld * glm::dvec4(corner, 1.0));
    const double halfHeight = -p.z * std::tan(0.5 * camera.yFov);
    picture.depth.add(-p.z);
    picture.x.add(p.x / halfHeight);
    picture.y.add(p.y / halfHeight);
  }
  return picture;
}

// What a scene stands on or before may leave the frame.
bool isBackdrop(const std::string& name) { return name == "floor" || name == "wall"; }

// In a square picture, hence in every wider one.
class SceneFrame : public testing::TestWithParam<SceneRow> {};

TEST_P(SceneFrame, showsEveryObjectWholeAndLarge) {
  const fs::path path = kCommitted / (std::string(GetParam().path) + ".gltf");
  for (const SceneFile& scene : readScenes(path)) {
    ASSERT_EQ(scene.cameras.size(), 1u);
    Picture all;
    for (const PlacedMesh& mesh : scene.meshes) {
      if (isBackdrop(mesh.name)) continue;
      const Picture picture = pictureOf(mesh, scene.cameras[0]);
      EXPECT_GT(picture.depth.low, 0.0) << mesh.name << " reaches behind the camera";
      EXPECT_GE(picture.x.low, -1.0) << mesh.name;
      EXPECT_LE(picture.x.high, 1.0) << mesh.name;
      EXPECT_GE(picture.y.low, -1.0) << mesh.name;
      EXPECT_LE(picture.y.high, 1.0) << mesh.name;
      for (const double x : {picture.x.low, picture.x.high}) all.x.add(x);
      for (const double y : {picture.y.low, picture.y.high}) all.y.add(y);
    }
    if (all.x.low > all.x.high) continue;  // backdrops only
    const double larger = std::max(all.x.high - all.x.low, all.y.high - all.y.low);
    EXPECT_GT(larger, 1.0) << "the objects fill less than half of the picture";
  }
}

INSTANTIATE_TEST_SUITE_P(scenes, SceneFrame, testing::ValuesIn(allScenes()), [](const auto& row) {
  std::string name = row.param.path;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
});

TEST(Cornell, hasTheRedWallOnTheLeft) {
  const SceneFile scene = readScenes(kCommitted / "showcase/cornell.gltf").at(0);
  double left = 0.0, right = 0.0;
  for (const PlacedMesh& mesh : scene.meshes) {
    if (mesh.name == "left wall") left = pictureOf(mesh, scene.cameras[0]).x.low;
    if (mesh.name == "right wall") right = pictureOf(mesh, scene.cameras[0]).x.high;
  }
  EXPECT_LT(left, -0.9);
  EXPECT_GT(right, 0.9);
  const nlohmann::json root = nlohmann::json::parse(contentsOf(kCommitted / "showcase/cornell.gltf"));
  for (const auto& node : root["nodes"]) {
    if (node["name"] != "left wall") continue;
    const auto& primitive = root["meshes"][node["mesh"].get<std::size_t>()]["primitives"][0];
    EXPECT_EQ(root["materials"][primitive["material"].get<std::size_t>()]["name"], "red");
  }
}

// The point P = (0,2,0) is the picture's center, and the camera's x axis is the world's: the red light is on the left.
TEST(Exercise, looksAtThePointFromAboveWithoutARoundedNumber) {
  const SceneFile scene = readScenes(kCommitted / "analytic/exercise_phong.gltf").at(0);
  const glm::dmat4 pose = scene.cameras.at(0).worldFromCamera;
  EXPECT_EQ(dvec3(pose[0]), dvec3(1.0, 0.0, 0.0));
  EXPECT_EQ(dvec3(pose[1]), dvec3(0.0, 0.0, -1.0));
  EXPECT_EQ(dvec3(pose[2]), dvec3(0.0, 1.0, 0.0));
  EXPECT_EQ(dvec3(pose[3]), dvec3(0.0, 20.0, 0.0));
}

TEST(Png, hasTheStructureOfItsStandard) {
  const auto bytes = makePng(300, 300, 3, [](std::uint32_t x, std::uint32_t y, std::uint8_t* out) {
    out[0] = static_cast<std::uint8_t>(x);
    out[1] = static_cast<std::uint8_t>(y);
    out[2] = 7;
  });
  const auto at = [&](std::size_t i) { return std::to_integer<unsigned>(bytes[i]); };
  const auto big32 = [&](std::size_t i) { return at(i) << 24 | at(i + 1) << 16 | at(i + 2) << 8 | at(i + 3); };
  EXPECT_EQ(big32(0), 0x89504e47u);
  EXPECT_EQ(big32(16), 300u);
  EXPECT_EQ(big32(20), 300u);
  // 270300 bytes of rows take five stored blocks of at most 65535 bytes, 5 bytes each, and zlib's 2 + 4.
  const std::size_t idat = 8 + 12 + 13;
  EXPECT_EQ(big32(idat), 300u * 901u + 5u * 5u + 6u);
  EXPECT_EQ(bytes.size(), idat + 12 + big32(idat) + 12);
  // The CRC of an empty IEND chunk is known from every PNG file.
  EXPECT_EQ(big32(bytes.size() - 4), 0xae426082u);
}

}  // namespace
}  // namespace crosslight::scenegen
