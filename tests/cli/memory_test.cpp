// What a large scene takes is what the program reckons with beforehand: the estimate decides what is refused. Scaled
// down from 20 million triangles; figures of those are in the commit that brought this.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace crosslight::test {
namespace {

using Json = nlohmann::json;

// A wavy sheet of side x side x 2 triangles, NAME.gltf and NAME.bin.
void writeSheet(const std::filesystem::path& file, std::uint32_t side) {
  std::vector<float> positions, normals;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i <= side; ++i) {
    for (std::uint32_t j = 0; j <= side; ++j) {
      const float x = static_cast<float>(j) / static_cast<float>(side),
                  y = static_cast<float>(i) / static_cast<float>(side);
      positions.insert(positions.end(), {2 * x - 1, 2 * y - 1, 0.2f * std::sin(9 * x) * std::cos(7 * y)});
      normals.insert(normals.end(), {0, 0, 1});
      if (i == side || j == side) continue;
      const std::uint32_t a = i * (side + 1) + j, b = a + side + 1;
      indices.insert(indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  }
  const auto bytes = [](const auto& list) { return list.size() * sizeof(list[0]); };
  std::ofstream bin(std::filesystem::path(file).replace_extension(".bin"), std::ios::binary);
  bin.write(reinterpret_cast<const char*>(positions.data()), static_cast<std::streamsize>(bytes(positions)));
  bin.write(reinterpret_cast<const char*>(normals.data()), static_cast<std::streamsize>(bytes(normals)));
  bin.write(reinterpret_cast<const char*>(indices.data()), static_cast<std::streamsize>(bytes(indices)));
  const std::size_t vertices = positions.size() / 3;
  const Json gltf = {
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0, 1}}}}},
      {"nodes", {{{"mesh", 0}}, {{"camera", 0}, {"translation", {0, 0, 4}}}}},
      {"cameras", {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}}}}}}},
      {"buffers",
       {{{"byteLength", 2 * bytes(positions) + bytes(indices)},
         {"uri", std::filesystem::path(file).filename().replace_extension(".bin").string()}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteLength", bytes(positions)}},
        {{"buffer", 0}, {"byteOffset", bytes(positions)}, {"byteLength", bytes(positions)}},
        {{"buffer", 0}, {"byteOffset", 2 * bytes(positions)}, {"byteLength", bytes(indices)}}}},
      {"accessors",
       {{{"bufferView", 0},
         {"componentType", 5126},
         {"count", vertices},
         {"type", "VEC3"},
         {"min", {-1, -1, -0.2}},
         {"max", {1, 1, 0.2}}},
        {{"bufferView", 1}, {"componentType", 5126}, {"count", vertices}, {"type", "VEC3"}},
        {{"bufferView", 2}, {"componentType", 5125}, {"count", indices.size()}, {"type", "SCALAR"}}}}};
  std::ofstream(file) << gltf;
}

// Bins of triangles and vertices that are on their way (llvmpipe has two scenes of 36 MiB, whatever is drawn), and one
// step of the program's heap (app/large_pages), which it keeps when what lay there is let go.
constexpr double kBesideBytes = (2 * 36.0 + 128.0) * (1 << 20);

struct Taken {
  double peak = 0, needed = 0, loaded = 0;  // bytes
};

class Memory : public CliTest {
 protected:
  Taken take(const std::string& name, const std::string& method) {
    const Outcome outcome =
        run({"render", name, "-o", "out.png", "-m", method, "-r", "64x64", "--json", "record.json"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    if (outcome.exitCode != 0) return {};
    const Json record = Json::parse(read("record.json"));
    return {static_cast<double>(outcome.peakBytes), record.at("neededBytes"), record.at("scene").at("hostBytes")};
  }
};

// The picture is the same whether its tree was built, loaded, or found damaged and built again; it is kept on request
// only where asked for, and of large scenes only.
TEST_F(Memory, ofTreesOnDiskChangesNoPicture) {
  writeSheet(path("large.gltf"), 330);
  writeSheet(path("small.gltf"), 20);
  const std::string folder = path("trees").string();
  const auto draw = [&](const std::string& scene, const std::string& cache) {
    const Outcome outcome = run({"render", scene, "-o", "out.pfm", "-m", "whitted", "-r", "64x64", "--bvh-cache", cache,
                                 "--json", "record.json"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return outcome;
  };
  const auto loaded = [&] { return Json::parse(read("record.json")).at("tree").at("loaded").get<int>(); };
  draw("small.gltf", folder);
  EXPECT_FALSE(std::filesystem::exists(folder));
  draw("large.gltf", "off");
  const std::string expected = read("out.pfm");
  draw("large.gltf", folder);
  EXPECT_EQ(loaded(), 0);
  EXPECT_EQ(read("out.pfm"), expected);
  std::vector<std::filesystem::path> kept;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) kept.push_back(entry.path());
  ASSERT_EQ(kept.size(), 1u);
  draw("large.gltf", folder);
  EXPECT_EQ(loaded(), 1);
  EXPECT_EQ(read("out.pfm"), expected);
  std::filesystem::resize_file(kept[0], std::filesystem::file_size(kept[0]) / 2);
  const Outcome outcome = draw("large.gltf", folder);
  EXPECT_NE(outcome.err.find("damaged"), std::string::npos) << outcome.err;
  EXPECT_EQ(loaded(), 0);
  EXPECT_EQ(read("out.pfm"), expected);
  draw("large.gltf", folder);
  EXPECT_EQ(loaded(), 1) << "the damaged file is replaced";
}

TEST_F(Memory, ofALargeSceneIsWhatWasEstimated) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer's own memory would be counted";
#endif
  writeSheet(path("small.gltf"), 2);
  writeSheet(path("large.gltf"), 1200);
  for (const std::string method : {"phong", "whitted"}) {
    SCOPED_TRACE(method);
    for (const char* name : {"small.gltf", "large.gltf"}) take(name, method);  // compiles, which takes memory too
    const Taken small = take("small.gltf", method), large = take("large.gltf", method);
    const double estimated = large.needed - small.needed + large.loaded;
    EXPECT_GT(estimated, 1.5e8);
    EXPECT_LT(large.peak - small.peak, estimated + kBesideBytes);
    EXPECT_GT(large.peak - small.peak, 0.5 * estimated) << "scenes would be refused that fit";
  }
}

}  // namespace
}  // namespace crosslight::test
