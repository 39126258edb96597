// Draco and meshopt: encoded here by the libraries' own encoders, then loaded.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wconversion"
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#pragma GCC diagnostic pop
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "unit/scene/fuzzer.h"
#include "unit/scene/gltf_fixture.h"

namespace crosslight::test {
namespace {

// A square of two triangles, lossless.
std::string dracoSquare() {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
  const std::array<std::array<float, 3>, 4> p = {{{0, 0, 0}, {2, 0, 0}, {2, 2, 1}, {0, 2, 0}}};
  const auto corner = [&](int face, std::array<std::size_t, 3> c) {
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<std::uint32_t>(face)), p[c[0]].data(),
                                      p[c[1]].data(), p[c[2]].data());
    builder.SetAttributeValuesForFace(uv, draco::FaceIndex(static_cast<std::uint32_t>(face)), p[c[0]].data(),
                                      p[c[1]].data(), p[c[2]].data());
  };
  corner(0, {0, 1, 2});
  corner(1, {0, 2, 3});
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::Encoder encoder;
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()) throw std::runtime_error("Draco does not encode");
  return std::string(buffer.data(), buffer.size());
}

struct DracoFile {
  GltfFile file;
  DracoFile() {
    file.extension("KHR_draco_mesh_compression");
    file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    const std::size_t view = file.view(dracoSquare());
    file.json["accessors"] = {{{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
                              {{"componentType", 5126}, {"count", 4}, {"type", "VEC2"}},
                              {{"componentType", 5125}, {"count", 6}, {"type", "SCALAR"}}};
    file.node(
        {{"mesh", file.mesh({{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}},
                             {"indices", 2},
                             {"extensions",
                              {{"KHR_draco_mesh_compression",
                                {{"bufferView", view}, {"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}}}}}})}});
  }
  Json& extension() { return file.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]; }
};

TEST(GltfDraco, CornersComeBackWithAllTheirAttributes) {
  DracoFile draco;
  const Scene scene = draco.file.load();
  const Primitive& primitive = scene.meshes.at(0).primitives.at(0);
  ASSERT_EQ(primitive.indices.size(), 6u);
  std::vector<std::array<float, 3>> corners;
  for (const std::uint32_t i : primitive.indices) {
    const glm::vec3 p = primitive.positions[i];
    EXPECT_EQ(primitive.uv0[i], glm::vec2(p));
    corners.push_back({p.x, p.y, p.z});
  }
  std::sort(corners.begin(), corners.end());
  const std::vector<std::array<float, 3>> expected = {{0, 0, 0}, {0, 0, 0}, {0, 2, 0}, {2, 0, 0}, {2, 2, 1}, {2, 2, 1}};
  EXPECT_EQ(corners, expected);
  EXPECT_GT(primitive.normals[0].z, 0.0f);
}

TEST(GltfDraco, BrokenOrInconsistentDataAreRefused) {
  const std::string place = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
  DracoFile id;
  id.extension()["attributes"]["POSITION"] = 17;
  EXPECT_REFUSED(id.file, place + "/attributes/POSITION");
  DracoFile count;
  for (int i : {0, 1}) count.file.json["accessors"][i]["count"] = 5;
  EXPECT_REFUSED(count.file, "/meshes/0/primitives/0/attributes/POSITION: its accessor has 5 elements");
  DracoFile garbage;
  garbage.extension()["bufferView"] = garbage.file.view(std::string(64, 'x'));
  EXPECT_REFUSED(garbage.file, place);
  DracoFile cut;
  cut.extension()["bufferView"] = cut.file.view(dracoSquare().substr(0, 40));
  EXPECT_REFUSED(cut.file, place);
}

// A view of compressed data, whose uncompressed twin is a fallback buffer that has no bytes.
struct MeshoptFile {
  GltfFile file;
  std::size_t compressedView(const std::string& data, std::size_t count, std::size_t stride, const std::string& mode,
                             const std::string& filter = "NONE") {
    const std::size_t raw = file.view(data);
    const Json range = file.json["bufferViews"][raw];
    Json view = {{"buffer", 1},
                 {"byteLength", count * stride},
                 {"extensions",
                  {{"EXT_meshopt_compression",
                    {{"buffer", 0},
                     {"byteOffset", range["byteOffset"]},
                     {"byteLength", range["byteLength"]},
                     {"byteStride", stride},
                     {"count", count},
                     {"mode", mode},
                     {"filter", filter}}}}}};
    if (mode == "ATTRIBUTES") view["byteStride"] = stride;
    file.json["bufferViews"].push_back(view);
    file.json["buffers"] = {
        Json::object(), {{"byteLength", 1 << 20}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    return file.json["bufferViews"].size() - 1;
  }
  std::size_t accessor(std::size_t view, int component, std::size_t count, const std::string& type,
                       bool normalized = false) {
    file.json["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
    if (normalized) file.json["accessors"].back()["normalized"] = true;
    return file.json["accessors"].size() - 1;
  }
};

std::string encodedVertices(const void* data, std::size_t count, std::size_t stride) {
  std::vector<unsigned char> out(meshopt_encodeVertexBufferBound(count, stride));
  out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), data, count, stride));
  return std::string(out.begin(), out.end());
}

TEST(GltfMeshopt, AttributesAndTrianglesComeBackExactly) {
  MeshoptFile meshopt;
  GltfFile& file = meshopt.file;
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.25f};
  const std::size_t vertexView = meshopt.compressedView(encodedVertices(positions.data(), 4, 12), 4, 12, "ATTRIBUTES");
  const std::vector<unsigned> indices = {0, 1, 2, 2, 3, 0};
  std::vector<unsigned char> encoded(meshopt_encodeIndexBufferBound(6, 4));
  encoded.resize(meshopt_encodeIndexBuffer(encoded.data(), encoded.size(), indices.data(), 6));
  const std::size_t indexView = meshopt.compressedView(std::string(encoded.begin(), encoded.end()), 6, 2, "TRIANGLES");
  const std::size_t position = meshopt.accessor(vertexView, 5126, 4, "VEC3");
  const std::size_t index = meshopt.accessor(indexView, 5123, 6, "SCALAR");
  const std::size_t normals = file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normals}}}, {"indices", index}})}});
  const Scene scene = file.load();
  const Primitive& primitive = scene.meshes.at(0).primitives.at(0);
  ASSERT_EQ(primitive.positions.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(primitive.positions[i], glm::vec3(positions[i * 3], positions[i * 3 + 1], positions[i * 3 + 2]));
  }
  // The codec may rotate a triangle's corners, not turn it around.
  std::vector<std::vector<std::uint32_t>> triangles;
  for (std::size_t t = 0; t < 2; ++t) {
    std::vector<std::uint32_t> triangle(primitive.indices.begin() + static_cast<std::ptrdiff_t>(t * 3),
                                        primitive.indices.begin() + static_cast<std::ptrdiff_t>(t * 3 + 3));
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    triangles.push_back(triangle);
  }
  EXPECT_EQ(triangles, (std::vector<std::vector<std::uint32_t>>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(GltfMeshopt, IndexSequencesComeBackInOrder) {
  MeshoptFile meshopt;
  GltfFile& file = meshopt.file;
  const std::vector<unsigned> strip = {2, 0, 1};
  std::vector<unsigned char> encoded(meshopt_encodeIndexSequenceBound(3, 3));
  encoded.resize(meshopt_encodeIndexSequence(encoded.data(), encoded.size(), strip.data(), 3));
  const std::size_t view = meshopt.compressedView(std::string(encoded.begin(), encoded.end()), 3, 4, "INDICES");
  const std::size_t index = meshopt.accessor(view, 5125, 3, "SCALAR");
  const std::size_t positions = file.floats(kTriangle, "VEC3");
  const std::size_t normals = file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  file.node(
      {{"mesh",
        file.mesh({{"mode", 5}, {"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"indices", index}})}});
  EXPECT_EQ(file.load().meshes.at(0).primitives.at(0).indices, (std::vector<std::uint32_t>{2, 0, 1}));
}

TEST(GltfMeshopt, TheOctahedralFilterGivesUnitNormals) {
  MeshoptFile meshopt;
  GltfFile& file = meshopt.file;
  file.extension("KHR_mesh_quantization");
  const std::vector<float> normals = {0, 0, 1, 0, 0.6f, 0, 0.8f, 0, -0.48f, 0.6f, -0.64f, 0};
  std::vector<signed char> octahedral(12);
  meshopt_encodeFilterOct(octahedral.data(), 3, 4, 8, normals.data());
  const std::size_t view =
      meshopt.compressedView(encodedVertices(octahedral.data(), 3, 4), 3, 4, "ATTRIBUTES", "OCTAHEDRAL");
  const std::size_t normal = meshopt.accessor(view, 5120, 3, "VEC3", true);
  file.node(
      {{"mesh", file.mesh({{"attributes", {{"POSITION", file.floats(kTriangle, "VEC3")}, {"NORMAL", normal}}}})}});
  const Scene scene = file.load();
  const Primitive& primitive = scene.meshes.at(0).primitives.at(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec3 expected(normals[i * 4], normals[i * 4 + 1], normals[i * 4 + 2]);
    // Eight bits per octahedral coordinate: steps of 1/127, at most doubled by the unfolding.
    EXPECT_LE(glm::distance(primitive.normals[i], expected), 2.0f / 127.0f) << i;
  }
}

TEST(GltfMeshopt, TheExponentialFilterGivesPositions) {
  MeshoptFile meshopt;
  std::vector<std::uint32_t> exponential(9);
  meshopt_encodeFilterExp(exponential.data(), 3, 12, 15, kTriangle.data());
  const std::size_t view =
      meshopt.compressedView(encodedVertices(exponential.data(), 3, 12), 3, 12, "ATTRIBUTES", "EXPONENTIAL");
  const std::size_t position = meshopt.accessor(view, 5126, 3, "VEC3");
  meshopt.file.node({{"mesh", meshopt.file.mesh({{"attributes", {{"POSITION", position}}}})}});
  const Scene scene = meshopt.file.load();
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec3 expected(kTriangle[i * 3], kTriangle[i * 3 + 1], kTriangle[i * 3 + 2]);
    EXPECT_LE(glm::distance(scene.meshes[0].primitives[0].positions[i], expected), 1.0f / (1 << 13)) << i;
  }
}

TEST(GltfMeshopt, BrokenDataAndImpossibleCombinationsAreRefused) {
  const auto broken = [](const auto& change) {
    auto meshopt = std::make_unique<MeshoptFile>();
    const std::size_t view = meshopt->compressedView(encodedVertices(kTriangle.data(), 3, 12), 3, 12, "ATTRIBUTES");
    const std::size_t position = meshopt->accessor(view, 5126, 3, "VEC3");
    meshopt->file.node({{"mesh", meshopt->file.mesh({{"attributes", {{"POSITION", position}}}})}});
    change(meshopt->file.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"]);
    return refusal(meshopt->file);
  };
  const std::string place = "/bufferViews/1";
  EXPECT_EQ(broken([](Json&) {}), "");
  for (const auto& change :
       std::vector<void (*)(Json&)>{[](Json& e) { e["byteLength"] = 8; }, [](Json& e) { e["mode"] = "TRIANGLES"; },
                                    [](Json& e) { e["count"] = 4; }, [](Json& e) { e["filter"] = "QUATERNION"; },
                                    [](Json& e) { e["byteOffset"] = 1 << 20; }, [](Json& e) { e["buffer"] = 2; },
                                    [](Json& e) { e["mode"] = "MAGIC"; }, [](Json& e) { e["byteStride"] = 10; }}) {
    EXPECT_NE(broken(change).find(place), std::string::npos) << broken(change);
  }
}

TEST(GltfFuzz, DamagedDracoDataNeverCrash) {
  const std::string base = dracoSquare();
  EXPECT_GE(tryMany(2000, "a.gltf",
                    [&](Fuzzer& f) {
                      DracoFile draco;
                      draco.extension()["bufferView"] = draco.file.view(f.damaged(base) + '\0');
                      return draco.file.embedded();
                    }),
            50u);
}

TEST(GltfFuzz, DamagedMeshoptDataNeverCrash) {
  const std::string base = encodedVertices(kTriangle.data(), 3, 12);
  const std::vector<const char*> modes = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
  EXPECT_GE(tryMany(2000, "a.gltf",
                    [&](Fuzzer& f) {
                      MeshoptFile meshopt;
                      const std::string mode = modes[f.below(3)];
                      const std::string filter = mode == "ATTRIBUTES" && f.below(2) == 0 ? "EXPONENTIAL" : "NONE";
                      const std::size_t view =
                          meshopt.compressedView(f.damaged(base) + '\0', mode == "ATTRIBUTES" ? 3 : 9,
                                                 mode == "ATTRIBUTES" ? 12 : 4, mode, filter);
                      const std::size_t position = meshopt.accessor(view, 5126, 3, "VEC3");
                      meshopt.file.node({{"mesh", meshopt.file.mesh({{"attributes", {{"POSITION", position}}}})}});
                      return meshopt.file.embedded();
                    }),
            50u);
}

}  // namespace
}  // namespace crosslight::test
