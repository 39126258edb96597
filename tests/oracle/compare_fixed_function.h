// Our pictures beside OpenGL's: scenes that both can light, how far they are apart, and how far they may be.
#pragma once

#include <glm/geometric.hpp>
#include <ostream>

#include "oracle/fixed_function.h"
#include "structs.h"
#include "support/render_fixture.h"

namespace crosslight::testing {

// What is left between two float pipelines. A vertex's color goes through about twelve roundings on its way to N.L and
// N.H (two transforms, three normalisations): gamma_12 = 7e-7 of it. The exponent multiplies that by n, 77 for the
// teapot's bronze, but in the few pixels of a highlight only; squared and averaged it stays below the diffuse part's
// share of 1e-6. Twice that holds; 3.3e-7 was measured (llvmpipe on both sides, 2026-11-22).
inline constexpr double kSoftwareRmse = 2e-6;
// Hardware snaps vertices and interpolates on grids of its own, 1/256 pixel at best: what OSMesa itself shows against
// the exact image of the mesh, 1.3e-3, is what such a grid costs.
inline constexpr double kHardwareRmse = 2e-3;
// A convention taken the other way (R.V for N.H, the first vertex for the last, a local viewer for an infinite one)
// shows by at least this: five hundred times what is allowed, so that the tests above can fail.
inline constexpr double kWrongRmse = 1e-3;
inline constexpr double kSameTriangle = 0.999;  // of interior pixels

inline double allowedRmse() { return device().info().isSoftware ? kSoftwareRmse : kHardwareRmse; }

// Directions are askew, so that no vertex of a symmetric mesh lies on the terminator, where the last bit decides
// whether a highlight is cut off. Positions reach about 2 from the origin; cones of 12 degrees show their edge there.
inline Light lightFrom(LightType type, const glm::dvec3& towards, double distance, float strength) {
  Light light;
  light.type = type;
  light.worldPosition = glm::normalize(towards) * distance;
  light.worldDirection = -glm::normalize(towards);
  ClassicLight c;
  c.ambient = glm::vec3(0.02f, 0.03f, 0.05f) * strength;
  c.diffuse = glm::vec3(0.7f, 0.6f, 0.5f) * strength;
  c.specular = glm::vec3(0.5f, 0.6f, 0.7f) * strength;
  if (type != LightType::directional) c.attenuation = {0.4f, 0.03f, 0.002f};
  if (type == LightType::spot) c.spotExponent = 3.0f, c.spotCutoff = 12.0f;
  light.classic = c;
  return light;
}

inline Scene sceneLitBy(const std::string& name, LightType type, float strength = 1.0f) {
  Scene scene = sceneNamed(name);
  for (MeshInstance& instance : scene.instances) instance.replacedByShape = false;
  scene.shapes.clear();
  scene.lights = {lightFrom(type, {0.43, 0.77, 0.59}, 9.0, strength),
                  lightFrom(type, {-0.71, 0.53, 0.37}, 11.0, strength)};
  return scene;
}

// First triangle of each instance in the numbering of the oracle.
inline std::vector<std::uint32_t> firstTriangles(const Scene& scene) {
  std::vector<std::uint32_t> first(scene.instanceCount, 0);
  std::uint32_t next = 0;
  for (const MeshInstance& instance : scene.instances) {
    first[instance.instanceId] = next;
    for (const Primitive& p : scene.meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
      next += static_cast<std::uint32_t>(p.indices.size() / 3);
    }
  }
  return first;
}

struct Comparison {
  double rmse = 0;             // over the interior pixels that show the same triangle
  std::size_t interior = 0;    // pixels whose 3x3 neighbourhood shows one object
  std::size_t same = 0;        // of these, those that show the same triangle in both
  double peak = 0;             // largest value of ours
  std::uint32_t x = 0, y = 0;  // where they differ most
  double worst = 0;
};

inline std::ostream& operator<<(std::ostream& out, const Comparison& c) {
  return out << "RMSE " << c.rmse << ", worst " << c.worst << " at (" << c.x << ", " << c.y << "), same triangle in "
             << c.same << " of " << c.interior << " interior pixels, peak " << c.peak;
}

inline void addPixel(Comparison& c, const std::array<float, 4>& ours, const std::array<float, 4>& theirs,
                     std::uint32_t x, std::uint32_t y) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = std::abs(static_cast<double>(ours[k]) - theirs[k]);
    c.rmse += d * d;  // the sum for now
    c.peak = std::max(c.peak, static_cast<double>(ours[k]));
    if (!(d <= c.worst)) c.worst = d, c.x = x, c.y = y;
  }
}

inline Comparison compare(const Image& ours, const FixedFunctionImage& theirs, const Scene& scene) {
  const Interior isInterior(ours);
  const std::vector<std::uint32_t> first = firstTriangles(scene);
  const std::vector<std::uint32_t>& primitives = ours.find("primitiveId")->integers;
  Comparison c;
  for (std::uint32_t y = 0; y < ours.height; ++y) {
    for (std::uint32_t x = 0; x < ours.width; ++x) {
      const std::uint32_t id = isInterior.idAt(x, y);
      if (!isInterior(x, y) || id == shared::kNoId) continue;
      const std::size_t at = std::size_t{y} * ours.width + x;
      ++c.interior;
      if (first[id] + primitives[at] != theirs.triangle[at]) continue;
      ++c.same;
      addPixel(c, pixelAt(ours, x, y), theirs.color[at], x, y);
    }
  }
  c.rmse = std::sqrt(c.rmse / static_cast<double>(3 * c.same));
  return c;
}

inline void expectAgreement(const Comparison& c) {
  ::testing::Test::RecordProperty("rmse", std::to_string(c.rmse));
  EXPECT_GT(c.interior, 4000u) << c;
  EXPECT_TRUE(static_cast<double>(c.same) >= kSameTriangle * static_cast<double>(c.interior)) << c;
  EXPECT_TRUE(c.rmse <= allowedRmse()) << c << "; float rounding in two pipelines explains " << allowedRmse();
}

}  // namespace crosslight::testing
