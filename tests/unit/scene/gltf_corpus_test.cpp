// Every file of Khronos' validator corpus loads or is refused, as its report says; every scene among the assets loads.
#include <cstdlib>
#include <iostream>
#include <set>

#include "unit/scene/gltf_fixture.h"

namespace crosslight::test {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> assets() {
  const char* folder = std::getenv("CROSSLIGHT_ASSETS");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  return fs::path(folder);
}

std::vector<fs::path> gltfFilesBelow(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Codes of the validator that this loader lives with, because they change neither what the file means nor where it
// reads. Every other error, and the warnings in the second set, must be refused.
const std::set<std::string> kToleratedErrors = {
    "ACCESSOR_NORMALIZED_INVALID",
    "BUFFER_DATA_URI_MIME_TYPE_INVALID",
    "BUFFER_VIEW_INVALID_BYTE_STRIDE",  // where only its target says so; a sparse part's stride is refused
    "BUFFER_VIEW_TARGET_OVERRIDE",
    "EMPTY_ENTITY",
    "IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE",
    "IMAGE_DATA_INVALID",  // an image that no material uses is never decoded
    "IMAGE_MIME_TYPE_INVALID",
    "IMAGE_UNEXPECTED_EOS",  // likewise
    "MESH_PRIMITIVE_ACCESSOR_UNALIGNED",
    "MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE",
    "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT",  // of application-specific attributes
    "MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY",
    "MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE",
    "MESH_PRIMITIVE_INVALID_ATTRIBUTE",
    "MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS",
    "MESH_PRIMITIVE_TOO_FEW_TEXCOORDS",
    "NODE_MATRIX_NON_TRS",
    "NODE_MATRIX_TRS",
    "NODE_SKIN_NO_SCENE",
    "NODE_SKIN_WITH_NON_SKINNED_MESH",
    "ROTATION_NON_UNIT",
    "SKIN_IBM_ACCESSOR_WITH_BYTESTRIDE",
    "SKIN_NO_COMMON_ROOT",
    "SKIN_SKELETON_INVALID",
    "UNSATISFIED_DEPENDENCY"};
const std::set<std::string> kRefusedWarnings = {"NON_RELATIVE_URI", "VALUE_NOT_IN_LIST"};
// One code, two weights: what the codes above cannot say.
const std::set<std::string> kRefusedAllTheSame = {"invalid_sparse_count_and_stride.gltf"};
const std::set<std::string> kLoadedAllTheSame = {
    // A data URI of another image type than its content: the content decides.
    "invalid_data_uri_mime_type.gltf"};

bool mustBeRefused(const Json& report) {
  for (const Json& message : report.at("issues").at("messages")) {
    const std::string code = message.at("code");
    const int severity = message.at("severity");
    if (severity == 0 && !kToleratedErrors.contains(code)) return true;
    if (severity == 1 && kRefusedWarnings.contains(code)) return true;
  }
  return false;
}

TEST(ValidatorCorpus, EveryFileLoadsOrIsRefusedAsItsReportSays) {
  if (!assets()) GTEST_SKIP() << "set CROSSLIGHT_ASSETS to a folder with gltf-validator/ to run this";
  const fs::path corpus = *assets() / "gltf-validator";
  std::size_t loaded = 0;
  std::size_t refused = 0;
  for (const fs::path& file : gltfFilesBelow(corpus)) {
    std::ifstream in(file.string() + ".report.json");
    const Json report = Json::parse(in);
    std::string got;
    try {
      loadScene(file);
      ++loaded;
    } catch (const InputError& error) {
      got = error.what();
      ++refused;
      EXPECT_NE(got.find(file.filename().string() + ": "), std::string::npos) << "the message does not name the file";
    }
    std::cout << fs::relative(file, corpus).string() << ": " << (got.empty() ? "loads" : got) << '\n';
    const bool expected = kLoadedAllTheSame.contains(file.filename().string())    ? false
                          : kRefusedAllTheSame.contains(file.filename().string()) ? true
                                                                                  : mustBeRefused(report);
    EXPECT_EQ(!got.empty(), expected) << file << " " << got << "\n" << report.at("issues").dump(1);
  }
  EXPECT_GE(loaded + refused, 150u) << "the corpus is not complete";
  std::cout << loaded << " load, " << refused << " are refused\n";
}

TEST(Assets, EverySceneLoads) {
  if (!assets()) GTEST_SKIP() << "set CROSSLIGHT_ASSETS to run this";
  std::size_t count = 0;
  for (const char* folder : {"khronos-blender-io", "vulkan-samples", "trimesh", "bevy"}) {
    for (const fs::path& file : gltfFilesBelow(*assets() / folder)) {
      EXPECT_NO_THROW({
        const Scene scene = loadScene(file);
        EXPECT_FALSE(scene.cameras.empty());
        for (const Mesh& mesh : scene.meshes) {
          for (const Primitive& primitive : mesh.primitives) {
            EXPECT_EQ(primitive.normals.size(), primitive.positions.size());
            EXPECT_LT(static_cast<std::size_t>(primitive.material), scene.materials.size());
          }
        }
      }) << file;
      ++count;
    }
  }
  EXPECT_GE(count, 30u);
}

}  // namespace
}  // namespace crosslight::test
