// Nothing outside the file's folder is read, and containers that are not what they say are refused.
#include <sys/stat.h>

#include "unit/scene/gltf_fixture.h"

namespace crosslight::test {
namespace {

namespace fs = std::filesystem;

// outer/secret.bin, outer/scene/inside.bin, outer/scene/scene.gltf: a triangle whose buffer is `uri`.
class Traversal : public testing::Test {
 protected:
  Traversal() {
    const std::string bytes(reinterpret_cast<const char*>(kTriangle.data()), kTriangle.size() * sizeof(float));
    outer_.write("secret.bin", bytes);
    outer_.write("scene/inside.bin", bytes);
    outer_.write("scene/sub/deep er.bin", bytes);
    outer_.write("scenery/neighbor.bin", bytes);
  }
  std::string refusalOf(const std::string& uri) {
    const Json json = {{"asset", {{"version", "2.0"}}},
                       {"buffers", {{{"uri", uri}, {"byteLength", 36}}}},
                       {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}},
                       {"accessors", {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}}},
                       {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
                       {"nodes", {{{"mesh", 0}}}}};
    try {
      const Scene scene = loadScene(outer_.write("scene/scene.gltf", json.dump()));
      EXPECT_EQ(scene.stats.triangles, 1u);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
  void expectRefused(const std::string& uri) {
    EXPECT_NE(refusalOf(uri).find("scene.gltf: /buffers/0/uri: "), std::string::npos) << uri << ": " << refusalOf(uri);
  }
  TempFolder outer_;
};

TEST_F(Traversal, PathsInsideTheFolderAreRead) {
  for (const char* uri : {"inside.bin", "./inside.bin", "sub/../inside.bin", "sub/deep%20er.bin", "sub/deep er.bin",
                          "%69nside.bin", "../scene/inside.bin"}) {
    EXPECT_EQ(refusalOf(uri), "") << uri;
  }
}

TEST_F(Traversal, PathsOutOfTheFolderAreRefused) {
  const std::string absolute = (outer_.path() / "secret.bin").string();
  for (const std::string& uri : {std::string("../secret.bin"),
                                 std::string("sub/../../secret.bin"),
                                 absolute,
                                 "/" + absolute,
                                 std::string("..%2Fsecret.bin"),
                                 std::string("%2e%2e/secret.bin"),
                                 std::string("%2E%2E%2F%73ecret.bin"),
                                 std::string("../scenery/neighbor.bin"),
                                 "file://" + absolute,
                                 "FILE:" + absolute,
                                 std::string("http://localhost/secret.bin"),
                                 std::string(".."),
                                 std::string("."),
                                 std::string("sub"),
                                 std::string(""),
                                 std::string("inside.bin%00.png"),
                                 std::string("inside%"),
                                 std::string("inside%4"),
                                 std::string("inside%zz.bin"),
                                 std::string("missing.bin")}) {
    expectRefused(uri);
  }
}

TEST_F(Traversal, SymbolicLinksOutOfTheFolderAreRefusedAndThoseInsideAreRead) {
  fs::create_symlink(outer_.path() / "secret.bin", outer_.path() / "scene/link.bin");
  fs::create_directory_symlink(outer_.path(), outer_.path() / "scene/up");
  fs::create_symlink("inside.bin", outer_.path() / "scene/alias.bin");
  fs::create_symlink("loop.bin", outer_.path() / "scene/loop.bin");
  expectRefused("link.bin");
  expectRefused("up/secret.bin");
  expectRefused("loop.bin");
  EXPECT_EQ(refusalOf("alias.bin"), "");
  EXPECT_EQ(refusalOf("up/scene/inside.bin"), "");
}

TEST_F(Traversal, PipesAndDevicesDoNotBlock) {
  ASSERT_EQ(::mkfifo((outer_.path() / "scene/pipe.bin").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", outer_.path() / "scene/zero.bin");
  expectRefused("pipe.bin");
  expectRefused("zero.bin");
  EXPECT_THROW(loadScene(outer_.path() / "scene/pipe.bin"), InputError);
  EXPECT_THROW(loadScene("/dev/zero"), InputError);
}

TEST_F(Traversal, DataUrisAreDecodedOrRefused) {
  EXPECT_EQ(refusalOf("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"), "");
  EXPECT_EQ(refusalOf("data:,%00%00%00%00%00%00%00%00%00%00%00%00%00%00%80%3f%00%00%00%00%00%00%00%00%00%00%00%00%00%00"
                      "%80%3f%00%00%00%00"),
            "");
  expectRefused("data:application/octet-stream;base64,AAAA!AAA");
  expectRefused("data:application/octet-stream;base64,AAAAA");
  expectRefused("data:application/octet-stream;;base64,AAAA");
  expectRefused("data:application/octet-stream;base64");
}

TEST_F(Traversal, FilesThatDoNotExistOrAreFoldersAreNamed) {
  EXPECT_THROW(loadScene(outer_.path() / "nothing.gltf"), InputError);
  EXPECT_THROW(loadScene(outer_.path()), InputError);
  EXPECT_THROW(loadScene(""), InputError);
}

TEST(GltfJson, DepthIsBoundedAndOddNumbersAreUnderstood) {
  TempFolder folder;
  const auto load = [&](const std::string& text) { return loadScene(folder.write("a.gltf", text)); };
  const std::string deep = std::string(1000000, '[') + std::string(1000000, ']');
  EXPECT_THROW(load("{\"asset\":{\"version\":\"2.0\",\"extras\":" + deep + "}}"), InputError);
  EXPECT_THROW(load(deep), InputError);
  EXPECT_THROW(load("[]"), InputError);
  EXPECT_THROW(load("3"), InputError);
  EXPECT_THROW(load("{\"asset\":{\"version\":\"1.0\"}}"), InputError);
  EXPECT_THROW(load("{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":18446744073709551615}]}"), InputError);
  EXPECT_THROW(load("{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":-1}]}"), InputError);
  EXPECT_THROW(load("{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0.5}]}"), InputError);
  EXPECT_THROW(load("{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"translation\":[1e300,0,0]}]}"), InputError);
  EXPECT_NO_THROW(load("{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{}],\"scene\":0.0}"));
}

TEST(GltfBudget, ManyUsesOfOneAccessorAreCountedEachTime) {
  GltfFile file;
  addTriangle(file);
  file.json["accessors"][0].erase("bufferView");
  file.json["accessors"][0]["count"] = 3000000;
  for (int i = 0; i < 1000; ++i) {
    file.json["meshes"].push_back(file.json["meshes"][0]);
    file.json["nodes"].push_back({{"mesh", i + 1}});
  }
  LoadOptions options;
  options.maxBytes = std::uint64_t{1} << 30;
  EXPECT_NE(refusal(file, options).find("more bytes, of the limit of"), std::string::npos);
}

TEST(GltfBudget, NamesAndWeightsThatAreCopiedManyTimesAreCounted) {
  LoadOptions options;
  options.maxBytes = std::uint64_t{64} << 20;
  GltfFile weights;
  addTriangle(weights);
  weights.json["meshes"][0]["primitives"][0]["targets"] = std::vector<Json>(5000, Json{{"POSITION", 0}});
  for (int i = 0; i < 5000; ++i) weights.node({{"mesh", 0}});
  EXPECT_NE(refusal(weights, options).find("more bytes, of the limit of"), std::string::npos);
  GltfFile names;
  addTriangle(names);
  names.json["nodes"][0]["name"] = std::string(1000000, 'n');
  names.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      names.floats(std::vector<float>(3000, 0.0f), "VEC3");
  EXPECT_NE(refusal(names, options).find("more bytes, of the limit of"), std::string::npos);
}

TEST(GltfJson, MessagesHoldNoControlCharactersAndNoPages) {
  GltfFile file;
  file.json["extensionsRequired"] = {"A\x1b[2J" + std::string(10000, 'x')};
  const std::string text = refusal(file);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_NE(text.find("'A?[2Jxxx"), std::string::npos);
  EXPECT_LT(text.size(), 1000u);
}

}  // namespace
}  // namespace crosslight::test
