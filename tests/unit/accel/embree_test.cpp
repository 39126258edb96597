// An independent oracle: Embree 3 traces a million random rays through each of three meshes. It works in single
// precision, so it may differ where a ray passes an edge within its rounding error; nothing else is excused.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <thread>

#include "accel/intersect.h"
#include "meshes.h"
#include "support/embree_oracle.h"

namespace crosslight::oracle {
namespace {

using testing::Random;

struct Comparison {
  std::size_t rays = 0, hits = 0, atEdges = 0, unexplained = 0;
};

Comparison compare(const std::vector<Triangle>& triangles, const Bvh& bvh, const EmbreeScene& embree,
                   std::uint64_t seed, std::size_t rays) {
  Comparison result{.rays = rays};
  Random random(seed);
  for (std::size_t i = 0; i < rays; ++i) {
    const glm::vec3 origin(2.5 * random.direction()), target = random.inBox(1);
    const glm::vec3 direction = target - origin;
    const Ray ray{.origin = origin, .direction = direction};
    const auto expected = closestHit(bvh, triangles, ray);
    const auto got = embree.closest(origin, direction);
    result.hits += expected.has_value();
    if (!expected && !got) continue;
    const bool agrees = expected && got &&
                        (std::abs(expected->t - got->t) <= distanceBound(triangles[expected->id], ray) ||
                         std::abs(expected->t - got->t) <= distanceBound(triangles[got->id], ray));
    if (agrees) continue;
    const bool edge = passesAnEdge(triangles, ray);
    ++(edge ? result.atEdges : result.unexplained);
    if (!edge && result.unexplained <= 3) {
      ADD_FAILURE() << "ray " << i << " of seed " << seed << ": t " << (expected ? expected->t : -1) << " here, "
                    << (got ? got->t : -1) << " by Embree";
    }
  }
  return result;
}

struct Mesh {
  const char* name;
  std::vector<Triangle> triangles;
};

class AgainstEmbree : public ::testing::TestWithParam<int> {
 protected:
  static Mesh mesh(int which) {
    if (which == 0) return {"sphere", testing::uvSphere(32, 64, glm::dvec3(0), 0.9)};
    if (which == 1) return {"torusKnot", testing::torusKnot(240, 16)};
    return {"soup", testing::randomSoup(3000, 0.08, 99)};
  }
};

TEST_P(AgainstEmbree, AMillionRaysHitAndMissTheSameAtTheSameDistance) {
  const Mesh m = mesh(GetParam());
  std::vector<Bounds> bounds;
  for (const Triangle& t : m.triangles) bounds.push_back(t.bounds());
  const Bvh bvh = buildBvh(bounds);
  const EmbreeScene embree(m.triangles);
  constexpr std::size_t kParts = 2, kRaysPerPart = 500000;
  std::array<Comparison, kParts> parts;
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < kParts; ++i) {
      threads.emplace_back([&, i] { parts[i] = compare(m.triangles, bvh, embree, 1000 + i, kRaysPerPart); });
    }
  }
  Comparison all;
  for (const Comparison& p : parts) {
    all.rays += p.rays;
    all.hits += p.hits;
    all.atEdges += p.atEdges;
    all.unexplained += p.unexplained;
  }
  RecordProperty("hits", std::to_string(all.hits));
  RecordProperty("differencesAtEdges", std::to_string(all.atEdges));
  std::printf("%s: %zu rays, %zu hits, %zu differences at edges, %zu unexplained\n", m.name, all.rays, all.hits,
              all.atEdges, all.unexplained);
  EXPECT_EQ(all.unexplained, 0u);
  EXPECT_GT(all.hits, all.rays / 10);
  // At most as many as pass an edge within the bound on either side: the edges' length times that width, of at least
  // the 4 units of area that the box of targets shows to any side; corners are at most 2.5 + sqrt(3) away.
  double edges = 0;
  for (const Triangle& t : m.triangles) {
    const glm::dvec3 a(t.v0), b(t.v1), c(t.v2);
    edges += length(b - a) + length(c - b) + length(a - c);
  }
  const double share = edges * 2 * kEmbreeError * (2.5 + std::sqrt(3.0)) / 4;
  EXPECT_LE(static_cast<double>(all.atEdges), share * static_cast<double>(all.rays));
}

std::string nameOfMesh(const ::testing::TestParamInfo<int>& info) {
  return std::array{"sphere", "torusKnot", "soup"}[static_cast<std::size_t>(info.param)];
}
INSTANTIATE_TEST_SUITE_P(Meshes, AgainstEmbree, ::testing::Range(0, 3), nameOfMesh);

}  // namespace
}  // namespace crosslight::oracle
