// Primitives: modes, component types, sparse accessors, missing parts, repaired parts.
#include <cmath>
#include <limits>

#include "scene/mesh_repair.h"
#include "unit/scene/gltf_fixture.h"

namespace crosslight::test {
namespace {

using Indices = std::vector<std::uint32_t>;

// Five points of a zigzag, with normals so that the vertices stay shared.
GltfFile& zigzag(GltfFile& file, int mode) {
  const std::size_t positions = file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3");
  std::vector<float> up;
  for (int i = 0; i < 5; ++i) up.insert(up.end(), {0, 0, 1});
  const std::size_t normals = file.floats(up, "VEC3");
  file.node({{"mesh", file.mesh({{"mode", mode}, {"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}})}});
  return file;
}

const Primitive& only(const Scene& scene) { return scene.meshes.at(0).primitives.at(0); }

TEST(GltfMesh, AStripTurnsEverySecondTriangleAround) {
  GltfFile file;
  EXPECT_EQ(only(zigzag(file, 5).load()).indices, (Indices{0, 1, 2, 1, 3, 2, 2, 3, 4}));
}

TEST(GltfMesh, AFanBeginsEachTriangleWithItsOwnVertex) {
  GltfFile file;
  EXPECT_EQ(only(zigzag(file, 6).load()).indices, (Indices{1, 2, 0, 2, 3, 0, 3, 4, 0}));
}

TEST(GltfMesh, AListDropsAnIncompleteTriangleAndSaysSo) {
  GltfFile file;
  const Scene scene = zigzag(file, 4).load();
  EXPECT_EQ(only(scene).indices, (Indices{0, 1, 2}));
  EXPECT_TRUE(warned(file.folder().path().string() + "/scene.gltf: /meshes/0/primitives/0: its vertices do not fill"));
}

TEST(GltfMesh, StripsAreStitchedByRepeatedVerticesThatDrawNothing) {
  GltfFile file;
  zigzag(file, 5);
  file.json["meshes"][0]["primitives"][0]["indices"] = file.accessor<std::uint16_t>({0, 1, 2, 2, 3, 3, 4, 2}, "SCALAR");
  EXPECT_EQ(only(file.load()).indices, (Indices{0, 1, 2, 3, 2, 4}));
}

TEST(GltfMesh, PointsAndLinesAreNamedInOneWarningAndLeftOut) {
  GltfFile file;
  zigzag(file, 0);
  zigzag(file, 1);
  zigzag(file, 3);
  const Scene scene = file.load();
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_TRUE(
      warned(file.folder().path().string() +
             "/scene.gltf: /meshes/0/primitives/0: draws points or lines, which are left out (and 2 more like it)"));
}

TEST(GltfMesh, IndicesOfEveryTypeAreReadAndCheckedAgainstTheVertices) {
  GltfFile file;
  zigzag(file, 4);
  Json& indices = file.json["meshes"][0]["primitives"][0]["indices"];
  indices = file.accessor<std::uint8_t>({4, 2, 0}, "SCALAR");
  EXPECT_EQ(only(file.load()).indices, (Indices{4, 2, 0}));
  indices = file.accessor<std::uint16_t>({4, 2, 1}, "SCALAR");
  EXPECT_EQ(only(file.load()).indices, (Indices{4, 2, 1}));
  indices = file.accessor<std::uint32_t>({4, 3, 2}, "SCALAR");
  EXPECT_EQ(only(file.load()).indices, (Indices{4, 3, 2}));
  indices = file.accessor<std::uint32_t>({0, 1, 5}, "SCALAR");
  EXPECT_REFUSED(file, "/meshes/0/primitives/0/indices: index 2 is vertex 5, there are 5");
  indices = file.accessor<std::uint32_t>({0, 1, 0xffffffffu}, "SCALAR");
  EXPECT_REFUSED(file, "/meshes/0/primitives/0/indices");
}

TEST(GltfMesh, MissingNormalsSplitTheVerticesAndAreTheTrianglesOwn) {
  GltfFile file;
  // Two triangles over a shared edge, at a right angle.
  const std::size_t positions = file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
  const auto indices = file.accessor<std::uint8_t>({0, 1, 2, 1, 0, 3}, "SCALAR");
  file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}})}});
  const Scene scene = file.load();
  const Primitive& primitive = only(scene);
  EXPECT_TRUE(primitive.flatNormals);
  EXPECT_EQ(primitive.indices, (Indices{0, 1, 2, 3, 4, 5}));
  ASSERT_EQ(primitive.positions.size(), 6u);
  EXPECT_EQ(primitive.positions[5], glm::vec3(0, 0, 1));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(primitive.normals[i], glm::vec3(0, 0, 1));
  for (std::size_t i = 3; i < 6; ++i) EXPECT_EQ(primitive.normals[i], glm::vec3(0, 1, 0));
}

TEST(GltfMesh, NormalsThatAreZeroOrNotNumbersBecomeTheTriangles) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  GltfFile file;
  const std::size_t positions = file.floats(kTriangle, "VEC3");
  const std::size_t normals = file.floats({0, 0, 0, nan, 0, 1, 0, 3, 4}, "VEC3");
  file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}})}});
  const Scene scene = file.load();
  EXPECT_EQ(only(scene).normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(only(scene).normals[1], glm::vec3(0, 0, 1));
  EXPECT_EQ(only(scene).normals[2], glm::vec3(0, 0.6f, 0.8f));
  EXPECT_FALSE(only(scene).flatNormals);
}

TEST(GltfMesh, PositionsThatAreNotNumbersAreRefused) {
  GltfFile file;
  std::vector<float> positions = kTriangle;
  positions[4] = std::numeric_limits<float>::infinity();
  file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", file.floats(positions, "VEC3")}}}})}});
  EXPECT_REFUSED(file, "/accessors/0: element 1 is not a finite number");
}

TEST(GltfMesh, SparseAccessorsReplaceElementsOfTheirBaseOrOfZeros) {
  GltfFile file;
  addTriangle(file);
  const auto indices = file.view(std::vector<std::uint16_t>{1, 2});
  const auto values = file.view(std::vector<float>{7, 0, 0, 0, 8, 0});
  const Json sparse = {{"count", 2},
                       {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                       {"values", {{"bufferView", values}}}};
  file.json["accessors"][0]["sparse"] = sparse;
  const std::vector<glm::vec3> expected = {{0, 0, 0}, {7, 0, 0}, {0, 8, 0}};
  EXPECT_EQ(only(file.load()).positions, expected);
  file.json["accessors"][0].erase("bufferView");
  EXPECT_EQ(only(file.load()).positions, expected);
  file.json["accessors"][0]["sparse"]["indices"]["bufferView"] = file.view(std::vector<std::uint16_t>{2, 1});
  EXPECT_REFUSED(file, "/accessors/0/sparse/indices");
  file.json["accessors"][0]["sparse"]["indices"]["bufferView"] = file.view(std::vector<std::uint16_t>{1, 3});
  EXPECT_REFUSED(file, "/accessors/0/sparse/indices");
}

TEST(GltfMesh, AnAccessorWithoutViewIsZeroAlsoForIndices) {
  GltfFile file;
  addTriangle(file);
  file.json["accessors"].push_back({{"componentType", 5125}, {"count", 3}, {"type", "SCALAR"}});
  file.json["meshes"][0]["primitives"][0]["indices"] = 1;
  const Scene scene = file.load();
  for (const glm::vec3& p : only(scene).positions) EXPECT_EQ(p, glm::vec3(0));
}

TEST(GltfMesh, QuantizedAttributesAreScaledAsTheSpecificationSays) {
  GltfFile file;
  file.extension("KHR_mesh_quantization");
  const auto positions = file.accessor<std::int16_t>({-32767, 0, 32767, -32768, 100, 0, 0, 0, 0}, "VEC3", true);
  file.json["bufferViews"].back()["byteStride"] = 8;
  // Elements of 6 bytes at a stride of 8: written again with padding.
  file.json["accessors"].back()["bufferView"] =
      file.view(std::vector<std::int16_t>{-32767, 0, 32767, 0, -32768, 100, 0, 0, 0, 0, 0, 0});
  file.json["bufferViews"].back()["byteStride"] = 8;
  const auto uv = file.accessor<std::uint16_t>({3, 0, 0, 9, 0, 0}, "VEC2");
  const auto normals = file.accessor<std::int8_t>({0, 0, 127, 0, 0, 127, 0, 0, -128}, "VEC3", true);
  file.json["accessors"].back()["bufferView"] =
      file.view(std::vector<std::int8_t>{0, 0, 127, 0, 0, 0, 127, 0, 0, 0, -128, 0});
  file.json["bufferViews"].back()["byteStride"] = 4;
  file.node(
      {{"mesh", file.mesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uv}, {"NORMAL", normals}}}})}});
  const Scene scene = file.load();
  EXPECT_EQ(only(scene).positions[0], glm::vec3(-1, 0, 1));
  EXPECT_EQ(only(scene).positions[1], glm::vec3(-1, 100.0f / 32767.0f, 0));
  EXPECT_EQ(only(scene).uv0[0], glm::vec2(3, 0));
  EXPECT_EQ(only(scene).uv0[1], glm::vec2(0, 9));
  EXPECT_EQ(only(scene).normals[2], glm::vec3(0, 0, -1));
  file.json.erase("extensionsUsed");
  EXPECT_REFUSED(file, "/meshes/0/primitives/0/attributes/");
}

TEST(GltfMesh, ColorsOfEveryKindBecomeLinearRgba) {
  GltfFile file;
  addTriangle(file);
  Json& color = file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"];
  color = file.floats({1, 0, 0.5f, 1, 0, 0.5f, 1, 0, 0.5f}, "VEC3");
  EXPECT_EQ(only(file.load()).colors[2], glm::vec4(1, 0, 0.5f, 1));
  color = file.accessor<std::uint8_t>({255, 0, 51, 102, 255, 0, 51, 102, 255, 0, 51, 102}, "VEC4", true);
  EXPECT_EQ(only(file.load()).colors[0], glm::vec4(1, 0, 0.2f, 0.4f));
  color = file.accessor<std::uint16_t>({65535, 0, 13107, 0, 65535, 0, 13107, 0, 65535, 0, 13107, 0}, "VEC4", true);
  EXPECT_EQ(only(file.load()).colors[1], glm::vec4(1, 0, 0.2f, 0));
}

TEST(GltfMesh, InterleavedViewsAreReadByTheirStride) {
  GltfFile file;
  std::vector<float> data;
  for (int i = 0; i < 3; ++i) {
    data.insert(data.end(), {kTriangle[i * 3u], kTriangle[i * 3u + 1], kTriangle[i * 3u + 2], float(i), float(-i)});
  }
  const std::size_t view = file.view(data);
  file.json["bufferViews"][view]["byteStride"] = 20;
  file.json["accessors"] = {
      {{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
      {{"bufferView", view}, {"byteOffset", 12}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}}};
  file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", 0}, {"TEXCOORD_1", 1}}}})}});
  const Scene scene = file.load();
  EXPECT_EQ(only(scene).positions[1], glm::vec3(1, 0, 0));
  EXPECT_EQ(only(scene).uv1[2], glm::vec2(2, -2));
  EXPECT_TRUE(only(scene).uv0.empty());
  file.json["accessors"][1]["byteOffset"] = 16;
  EXPECT_REFUSED(file, "/accessors/1: needs 64 bytes of its view, which has 60");
}

TEST(GltfMesh, AMissingMaterialBecomesOneDefaultMaterialAtTheEnd) {
  GltfFile file;
  addTriangle(file);
  addTriangle(file);
  file.json["materials"] = {{{"name", "own"}}};
  const Scene scene = file.load();
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[1].name, "default");
  EXPECT_EQ(scene.meshes[0].primitives[0].material, 1);
  EXPECT_EQ(scene.meshes[1].primitives[0].material, 1);
}

TEST(MeshRepair, TangentsFollowIncreasingUAndTheirHandTellsMirroredCoordinates) {
  Primitive primitive;
  // A square in the plane z = 0; v downwards, as glTF has it, so that the picture reads right.
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  primitive.normals.assign(4, glm::vec3(0, 0, 1));
  primitive.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  primitive.indices = {0, 1, 2, 0, 2, 3};
  Primitive mirrored = primitive;
  makeTangents(primitive, primitive.uv0);
  for (const glm::vec4& tangent : primitive.tangents) EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1));
  for (glm::vec2& uv : mirrored.uv0) uv.x = 1 - uv.x;
  makeTangents(mirrored, mirrored.uv0);
  for (const glm::vec4& tangent : mirrored.tangents) EXPECT_EQ(tangent, glm::vec4(-1, 0, 0, -1));
}

TEST(MeshRepair, VerticesWhereMirroredAndUnmirroredCoordinatesMeetAreSplit) {
  Primitive primitive;
  // Two triangles on both sides of x = 0; u grows away from the middle on both.
  primitive.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}};
  primitive.normals.assign(4, glm::vec3(0, 0, 1));
  primitive.uv0 = {{0, 1}, {0, 0}, {1, 1}, {1, 1}};
  primitive.indices = {0, 2, 1, 0, 1, 3};
  makeTangents(primitive, primitive.uv0);
  ASSERT_EQ(primitive.positions.size(), 6u);
  ASSERT_EQ(primitive.uv0.size(), 6u);
  for (std::size_t corner = 0; corner < 6; ++corner) {
    const glm::vec4 expected = corner < 3 ? glm::vec4(1, 0, 0, 1) : glm::vec4(-1, 0, 0, -1);
    EXPECT_EQ(primitive.tangents[primitive.indices[corner]], expected) << corner;
  }
}

TEST(MeshRepair, TangentsThatCannotBeUsedLieAcrossTheNormal) {
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  primitive.normals.assign(3, glm::vec3(0, 0, 1));
  primitive.indices = {0, 1, 2};
  primitive.tangents = {{0, 0, 0, 1}, {0, 0, 5, -1}, {3, 0, 4, -1}};
  EXPECT_EQ(repairTangents(primitive), 2u);
  for (const glm::vec4& tangent : primitive.tangents) {
    EXPECT_EQ(tangent.z, 0.0f);
    EXPECT_EQ(tangent.x * tangent.x + tangent.y * tangent.y, 1.0f);
  }
  EXPECT_EQ(primitive.tangents[2], glm::vec4(1, 0, 0, -1));
}

}  // namespace
}  // namespace crosslight::test
