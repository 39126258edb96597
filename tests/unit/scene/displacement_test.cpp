// Displaced meshes against closed forms, and their edges against cracks.
#include "scene/displacement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "base/error.h"
#include "scene/displacement_parts.h"
#include "scene/shape_mesh.h"

namespace crosslight::test {
namespace {

Scene sceneOf(Primitive primitive, TextureImage image, float scale, float bias) {
  Scene scene;
  scene.source = "made in a test";
  scene.images.push_back(std::move(image));
  Material& m = scene.materials.emplace_back();
  m.displacementTexture.image = 0;
  m.displacementTexture.wrapU = m.displacementTexture.wrapV = Wrap::clampToEdge;
  m.displacementScale = scale;
  m.displacementBias = bias;
  scene.meshes.push_back({"mesh", {std::move(primitive)}});
  scene.instances.emplace_back();
  scene.cameras.emplace_back();
  return scene;
}

TextureImage image(std::uint32_t size, const std::function<double(double, double)>& height) {
  TextureImage out{"heights", size, size, {}};
  for (std::uint32_t y = 0; y < size; ++y) {
    for (std::uint32_t x = 0; x < size; ++x) {
      const auto h = static_cast<float>(height((x + 0.5) / size, (y + 0.5) / size));
      out.rgba.insert(out.rgba.end(), {h, 0.0f, 0.0f, 1.0f});
    }
  }
  return out;
}

// The plane z = 0 over [-1/2, 1/2]^2.
Primitive square() {
  Primitive p;
  p.positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}};
  p.normals.assign(4, {0, 0, 1});
  p.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  p.indices = {0, 1, 2, 0, 2, 3};
  return p;
}

// A cap of the unit sphere from a plane, as the surface z' = 2 z - 1: scale and bias count.
struct Cap {
  std::size_t triangles = 0, vertices = 0;
  double off = 0;   // from the unit sphere, of the square of the radius
  double tilt = 0;  // of normals
};

Cap displacedCap(std::uint32_t level, std::uint32_t texels) {
  const auto height = [](double u, double v) { return std::sqrt(1 - (u - 0.5) * (u - 0.5) - (v - 0.5) * (v - 0.5)); };
  Scene scene = sceneOf(square(), image(texels, height), 2.0f, -1.0f);
  EXPECT_TRUE(displaceMeshes(scene, {.level = level}));
  const Primitive& p = scene.meshes[0].primitives[0];
  Cap cap{p.indices.size() / 3, p.positions.size()};
  for (std::size_t i = 0; i < p.positions.size(); ++i) {
    const glm::dvec3 at(p.positions[i]);
    // The border reads clamped heights; the normals beside it know of them.
    if (std::max(std::abs(at.x), std::abs(at.y)) > 0.5 - 1.5 / (1u << level)) continue;
    const double z = 0.5 * (at.z + 1);
    cap.off = std::max(cap.off, std::abs(at.x * at.x + at.y * at.y + z * z - 1));
    const glm::dvec3 n = glm::normalize(glm::dvec3(2 * at.x / z, 2 * at.y / z, 1));
    cap.tilt = std::max(cap.tilt, glm::length(n - glm::dvec3(p.normals[i])));
  }
  return cap;
}

TEST(Displacement, APlaneBecomesASpheresCap) {
  constexpr std::uint32_t kTexels = 512;
  const Cap coarse = displacedCap(5, kTexels), fine = displacedCap(6, kTexels);
  EXPECT_EQ(fine.triangles, 2u * 4096u);
  EXPECT_EQ(fine.vertices, 65u * 65u);
  // Heights between texels are linear: off by h'' / 8 / size^2 at most in each direction, h'' <= 1 / (1 - 1/2)^(3/2) =
  // 2.83 on the square; 2 z of that in z^2; floats.
  EXPECT_LE(fine.off, 2 * 2 * 2.83 / 8 / (kTexels * kTexels) + 1e-6);
  // Of second order in the edge's length.
  EXPECT_LE(fine.tilt, 1e-3);
  EXPECT_LE(fine.tilt, 0.35 * coarse.tilt);
}

TEST(Displacement, ASphereOfConstantHeightStaysClosedAndAsRoundAsItWas) {
  Primitive ball = tessellateShape(ShapeKind::sphere, {1, 0, 0, 0}, 24, 1);
  Scene scene = sceneOf(ball, image(4, [](double, double) { return 0.5; }), 1.0f, 0.25f);
  ASSERT_TRUE(displaceMeshes(scene, {.level = 0}));
  for (const glm::vec3& v : scene.meshes[0].primitives[0].positions) EXPECT_NEAR(glm::length(v), 1.75f, 2e-6f);
}

// Every edge of the displaced ball has a triangle on both sides, by position: none is torn open, at the seam neither.
TEST(Displacement, NoEdgeOpensWhereTextureCoordinatesDoNotMeet) {
  for (const float edgePixels : {0.0f, 12.0f}) {
    Scene scene =
        sceneOf(tessellateShape(ShapeKind::sphere, {1, 0, 0, 0}, 12, 1),
                image(16, [](double u, double v) { return u + 0.3 * v; }), 0.5f, 0.0f);  // unlike at u = 0 and 1
    scene.cameras[0].worldFromCamera[3] = {0.8, 0.4, 3.0, 1.0};
    ASSERT_TRUE(displaceMeshes(scene, {.level = 3, .edgePixels = edgePixels, .width = 200, .height = 200}));
    const Primitive& p = scene.meshes[0].primitives[0];
    std::map<std::array<float, 6>, int> sides;
    std::size_t triangles = 0;
    for (std::size_t t = 0; t + 2 < p.indices.size(); t += 3) {
      const auto at = [&](std::size_t c) { return p.positions[p.indices[t + c % 3]]; };
      if (at(0) == at(1) || at(1) == at(2) || at(2) == at(0)) continue;  // the poles'
      ++triangles;
      for (std::size_t c = 0; c < 3; ++c) {
        const glm::vec3 a = at(c), b = at(c + 1);
        const bool forward = std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        const glm::vec3 low = forward ? a : b, high = forward ? b : a;
        sides[{low.x, low.y, low.z, high.x, high.y, high.z}] += forward ? 1 : -1;
      }
    }
    EXPECT_GT(triangles, 2000u);
    std::size_t open = 0;
    for (const auto& [edge, balance] : sides) open += balance != 0;
    EXPECT_EQ(open, 0u) << "of " << sides.size() << " edges, edge length " << edgePixels;
  }
}

TEST(Displacement, EdgesOnTheScreenDecideHowFineAMeshBecomes) {
  const auto trianglesAt = [](double distance) {
    Scene scene = sceneOf(square(), image(4, [](double, double) { return 0.0; }), 1.0f, 0.0f);
    scene.cameras[0].worldFromCamera[3] = {0, 0, distance, 1};
    displaceMeshes(scene, {.edgePixels = 16.0f, .width = 512, .height = 512});
    return scene.meshes[0].primitives[0].indices.size() / 3;
  };
  EXPECT_GT(trianglesAt(1.0), 3 * trianglesAt(2.0));
  EXPECT_EQ(trianglesAt(1000.0), 2u);
}

TEST(Displacement, ACubesEdgesStaySharpAndClosed) {
  Scene scene = sceneOf(tessellateShape(ShapeKind::box, {1, 1, 1, 0}, 3, 1),
                        image(4, [](double, double) { return 1.0; }), 0.25f, 0.0f);
  ASSERT_TRUE(displaceMeshes(scene, {.level = 2}));
  const Primitive& p = scene.meshes[0].primitives[0];
  std::map<std::array<float, 3>, glm::vec3> first;
  std::size_t sharp = 0;
  for (std::size_t i = 0; i < p.positions.size(); ++i) {
    const auto [found, isNew] = first.try_emplace({p.positions[i].x, p.positions[i].y, p.positions[i].z}, p.normals[i]);
    sharp += !isNew && glm::dot(found->second, p.normals[i]) < 0.9f;
  }
  EXPECT_GT(sharp, 12u);
}

TEST(Displacement, AMeshThatWouldNotFitIsRefusedWithItsRemedy) {
  Primitive ball = tessellateShape(ShapeKind::sphere, {1, 0, 0, 0}, 400, 1);
  Scene scene = sceneOf(ball, image(4, [](double, double) { return 0.0; }), 1.0f, 0.0f);
  EXPECT_THROW(
      try { displaceMeshes(scene, {.level = 5}); } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("displacement-level"), std::string::npos);
        throw;
      },
      InputError);
}

}  // namespace
}  // namespace crosslight::test
