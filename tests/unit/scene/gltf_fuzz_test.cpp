// Thousands of damaged files, in this process, from fixed seeds: each loads or throws a crosslight::Error. Run under
// the sanitizers this is also the check that nothing reads out of bounds.

#include <array>

#include "unit/scene/fuzzer.h"
#include "unit/scene/gltf_fixture.h"

namespace crosslight::test {
namespace {

namespace fs = std::filesystem;

// A file that uses much of the format, small.
std::string baseGltf() {
  GltfFile file;
  addTriangle(file);
  Json& primitive = file.json["meshes"][0]["primitives"][0];
  primitive["attributes"]["NORMAL"] = file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  primitive["attributes"]["TEXCOORD_0"] = file.floats({0, 1, 1, 1, 0, 0}, "VEC2");
  primitive["attributes"]["JOINTS_0"] = file.accessor<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
  primitive["attributes"]["WEIGHTS_0"] = file.floats({1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0}, "VEC4");
  primitive["indices"] = file.accessor<std::uint16_t>({0, 1, 2}, "SCALAR");
  primitive["targets"] = {{{"POSITION", file.floats(kTriangle, "VEC3")}}};
  primitive["material"] = 0;
  file.json["meshes"][0]["weights"] = {0.5};
  file.json["nodes"][0]["skin"] = 0;
  file.node({{"translation", {10, 0, 0}}, {"children", {2, 3}}});
  file.node({{"rotation", {0, 0, 0, 1}}, {"camera", 0}});
  file.node({{"extensions",
              {{"KHR_lights_punctual", {{"light", 0}}},
               {"CROSSLIGHT_node_shape", {{"kind", "torus"}, {"radius", 2}, {"tubeRadius", 1}}}}}});
  file.json["skins"] = {
      {{"joints", {1, 2}}, {"inverseBindMatrices", file.floats(std::vector<float>(32, 1.0f), "MAT4")}}};
  file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.25}}}}};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", {{"outerConeAngle", 0.3}}}}};
  file.json["images"] = {
      {{"uri",
        "data:image/"
        "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVQYV2P4z/AfAAQAAf+I0P3MAAAAAElFTkSuQmCC"}}};
  file.json["samplers"] = {{{"wrapS", 33071}}};
  file.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
  file.json["materials"] = {
      {{"normalTexture", {{"index", 0}}},
       {"extensions", {{"CROSSLIGHT_materials_classic", {{"model", "phong"}, {"preset", "brass"}}}}}}};
  const std::size_t input = file.floats({0, 1}, "SCALAR");
  const std::size_t output = file.floats({0, 0, 0, 4, 0, 0}, "VEC3");
  file.json["animations"] = {{{"samplers", {{{"input", input}, {"output", output}}}},
                              {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}}};
  const auto sparse = file.view(std::vector<std::uint16_t>{1});
  file.json["accessors"][2]["sparse"] = {{"count", 1},
                                         {"indices", {{"bufferView", sparse}, {"componentType", 5123}}},
                                         {"values", {{"bufferView", file.view(std::vector<float>{1, 2})}}}};
  return file.embedded();
}

void appendWord(std::string& out, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 0xffu);
}

std::string baseGlb() {
  GltfFile file;
  addTriangle(file);
  Json json = file.json;
  json["buffers"] = {{{"byteLength", file.bin().size()}}};
  std::string text = json.dump();
  while (text.size() % 4 != 0) text += ' ';
  std::string out = "glTF";
  appendWord(out, 2);
  appendWord(out, static_cast<std::uint32_t>(28 + text.size() + file.bin().size()));
  appendWord(out, static_cast<std::uint32_t>(text.size()));
  out += "JSON" + text;
  appendWord(out, static_cast<std::uint32_t>(file.bin().size()));
  out += std::string("BIN\0", 4) + file.bin();
  return out;
}

TEST(GltfFuzz, TheUndamagedBaseFilesLoad) {
  const TempFolder folder;
  EXPECT_EQ(loadScene(folder.write("base.gltf", baseGltf())).stats.triangles, 1u);
  EXPECT_EQ(loadScene(folder.write("base.glb", baseGlb())).stats.triangles, 1u);
}

TEST(GltfFuzz, DamagedBytesOfATextFileNeverCrash) {
  const std::string base = baseGltf();
  EXPECT_GE(tryMany(2000, "a.gltf", [&](Fuzzer& f) { return f.damaged(base); }), 100u);
}

TEST(GltfFuzz, DamagedBytesOfABinaryFileNeverCrash) {
  const std::string base = baseGlb();
  EXPECT_GE(tryMany(2000, "a.glb", [&](Fuzzer& f) { return f.damaged(base); }), 100u);
}

TEST(GltfFuzz, DamagedValuesOfAWellFormedFileNeverCrash) {
  const Json base = Json::parse(baseGltf());
  EXPECT_GE(tryMany(4000, "a.gltf", [&](Fuzzer& f) { return f.damaged(base).dump(); }), 100u);
}

TEST(GltfFuzz, DamagedForeignFilesNeverCrash) {
  const char* assets = std::getenv("CROSSLIGHT_ASSETS");
  if (assets == nullptr) GTEST_SKIP() << "set CROSSLIGHT_ASSETS to run this";
  for (const char* name : {"trimesh/BoxTextured.glb", "trimesh/BoxInterleaved.glb", "bevy/CornellBox.glb"}) {
    std::ifstream in(fs::path(assets) / name, std::ios::binary);
    const std::string base((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    ASSERT_FALSE(base.empty()) << name;
    EXPECT_GE(tryMany(500, "a.glb", [&](Fuzzer& f) { return f.damaged(base); }), 50u);
  }
}

// 16x16 pixels, progressive, with restart intervals: the decoder's longest way.
const std::string kProgressiveJpeg =
    "data:image/jpeg;base64,"
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAA0JCgsKCA0LCgsODg0PEyAVExISEyccHhcgLikxMC4pLSwzOko+MzZGNywtQFdBRkxO"
    "UlNSMj5aYVpQYEpRUk//2wBDAQ4ODhMREyYVFSZPNS01T09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09P"
    "T09PT09PT0//wgARCAAQABADASIAAhEBAxEB/8QAFgABAQEAAAAAAAAAAAAAAAAABQME/8QAFAEBAAAAAAAAAAAAAAAAAAAAAP/d"
    "AAQAAf/aAAwDAQACEAMQAAABJQ13P//EABYQAAMAAAAAAAAAAAAAAAAAAAACA//aAAgBAQABBQJZn//QWZ//0Vmf/9JZn//EABYR"
    "AQEBAAAAAAAAAAAAAAAAAAQAEf/aAAgBAwEBPwEqNv/EABcRAAMBAAAAAAAAAAAAAAAAAAACAxP/2gAIAQIBAT8Be+B//8QAFBAB"
    "AAAAAAAAAAAAAAAAAAAAAP/aAAgBAQAGPwJ//9B//9F//9J//8QAFhAAAwAAAAAAAAAAAAAAAAAAABFB/9oACAEBAAE/IVQ//9BU"
    "P//RVD//0lQ//9oADAMBAAIAAwAAABAz/8QAFREBAQAAAAAAAAAAAAAAAAAAIQD/2gAIAQMBAT8QM3//xAAYEQACAwAAAAAAAAAA"
    "AAAAAAARoVGx0f/aAAgBAgEBPxCYStKr/8QAFxAAAwEAAAAAAAAAAAAAAAAAAAEh8P/aAAgBAQABPxCPEf/QjxH/0Y8R/9KPEf/Z";

// A material's normal texture is the image; everything else is well-formed.
std::string gltfWithImage(const std::string& uri) {
  return Json{{"asset", {{"version", "2.0"}}},
              {"images", {{{"uri", uri}}}},
              {"textures", {{{"source", 0}}}},
              {"materials", {{{"normalTexture", {{"index", 0}}}}}}}
      .dump();
}

TEST(GltfFuzz, DamagedProgressiveJpegsNeverCrash) {
  const TempFolder folder;
  const Scene scene = loadScene(folder.write("jpeg.gltf", gltfWithImage(kProgressiveJpeg)));
  ASSERT_EQ(scene.images.at(0).width, 16u);
  // The last pixel as libjpeg-turbo decodes it; the two filter the halved chroma differently.
  const std::array<float, 3> expected = {0xe9, 0xe3, 0x29};
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(scene.images[0].rgba[255 * 4 + c] * 255.0f, expected[c], 8.0f);
  const std::string prefix = "data:image/jpeg;base64,";
  const std::string base = base64Decoded(kProgressiveJpeg.substr(prefix.size()));
  EXPECT_GE(
      tryMany(2000, "a.gltf", [&](Fuzzer& f) { return gltfWithImage("data:," + percentEncoded(f.damaged(base))); }),
      50u);
}

TEST(GltfFuzz, DamagedImagesNeverCrash) {
  const char* assets = std::getenv("CROSSLIGHT_ASSETS");
  if (assets == nullptr) GTEST_SKIP() << "set CROSSLIGHT_ASSETS to run this";
  for (const char* name : {"cyan.jpg", "magenta.png", "npot.png"}) {
    std::ifstream in(fs::path(assets) / "gltf-validator/image" / name, std::ios::binary);
    const std::string base((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    ASSERT_FALSE(base.empty()) << name;
    EXPECT_GE(
        tryMany(1500, "a.gltf", [&](Fuzzer& f) { return gltfWithImage("data:," + percentEncoded(f.damaged(base))); }),
        50u);
  }
}

}  // namespace
}  // namespace crosslight::test
