// The ray kernels on the device against Embree 3: a million random rays through each of three meshes. Both work in
// single precision, so each may err by its own rounding where a ray passes an edge; nothing else is excused.
#include <array>
#include <cstdio>

#include "bench/ray_kernels.h"
#include "support/embree_oracle.h"
#include "support/render_fixture.h"
#include "unit/accel/meshes.h"

namespace crosslight::testing {
namespace {

using oracle::Ray;
using oracle::Triangle;

constexpr std::size_t kRays = 1000000;

// Corners unshared and double-sided, seen from the origin: render space is then the meshes' own.
Scene sceneOf(const std::vector<Triangle>& triangles) {
  Scene scene;
  scene.source = "made in a test";
  Primitive p;
  for (const Triangle& t : triangles) p.positions.insert(p.positions.end(), {t.v0, t.v1, t.v2});
  p.normals.assign(p.positions.size(), {0, 0, 1});
  for (std::uint32_t i = 0; i < p.positions.size(); ++i) p.indices.push_back(i);
  scene.meshes.push_back({"mesh", {p}});
  scene.materials.emplace_back().doubleSided = true;
  scene.instances.emplace_back();
  scene.instanceCount = 1;
  scene.cameras.emplace_back();
  scene.lights.emplace_back();
  return scene;
}

std::vector<shared::RayRecord> randomRays(std::uint64_t seed) {
  Random random(seed);
  std::vector<shared::RayRecord> rays(kRays);
  for (shared::RayRecord& ray : rays) {
    ray = {};
    ray.origin = glm::vec3(2.5 * random.direction());
    ray.direction = random.inBox(1) - ray.origin;
    ray.tMax = std::numeric_limits<float>::infinity();
    ray.kind = shared::kRayReflection;
    ray.medium = shared::kNoRayNode;
    ray.from = shared::kNoHit;
  }
  return rays;
}

std::vector<Triangle> meshNumber(int which) {
  if (which == 0) return uvSphere(32, 64, glm::dvec3(0), 0.9);
  if (which == 1) return torusKnot(240, 16);
  return randomSoup(3000, 0.08, 99);
}

class KernelAgainstEmbree : public ::testing::TestWithParam<int> {};

TEST_P(KernelAgainstEmbree, aMillionRaysHitAndMissTheSameAtTheSameDistance) {
  const std::vector<Triangle> triangles = meshNumber(GetParam());
  const Scene scene = sceneOf(triangles);
  const RenderSettings settings = settingsFor(Method::whitted, 8, 8);
  FlatScene flat = flattenScene(scene, glm::dvec3(0.0), true);
  const FlatBvh bvh = buildFlatBvh(flat, scene, settings);
  GpuScene gpuScene(device(), scene, settings, std::move(flat), &bvh);
  const Plan plan = makePlan(scene, settings);
  bench::RayKernels kernels(device(), gpuScene, plan, settings);
  const std::vector<shared::RayRecord> rays = randomRays(4242);
  kernels.setBounceRays(rays);
  kernels.bounce();
  const std::vector<shared::HitRecord> hits = kernels.bounceHits();
  EXPECT_EQ(kernels.takeCounts().capped, 0u);

  const oracle::EmbreeScene embree(triangles);
  std::size_t found = 0, atEdges = 0, unexplained = 0;
  for (std::size_t i = 0; i < kRays; ++i) {
    const Ray ray{.origin = rays[i].origin, .direction = rays[i].direction};
    const auto expected = embree.closest(rays[i].origin, rays[i].direction);
    const bool hit = hits[i].primitive != shared::kNoHit;
    found += hit;
    if (!hit && !expected) continue;
    if (hit && expected) {
      const Triangle& ours = triangles[bvh.primitives[hits[i].primitive].id];
      const double difference = std::abs(static_cast<double>(hits[i].t) - expected->t);
      // Each side may be off by the bound.
      if (difference <= 2 * oracle::distanceBound(ours, ray)) continue;
      if (difference <= 2 * oracle::distanceBound(triangles[expected->id], ray)) continue;
    }
    const bool edge = oracle::passesAnEdge(triangles, ray);
    ++(edge ? atEdges : unexplained);
    if (!edge && unexplained <= 3) {
      ADD_FAILURE() << "ray " << i << ": t " << (hit ? hits[i].t : -1.0f) << " here, "
                    << (expected ? expected->t : -1.0) << " by Embree";
    }
  }
  std::printf("%zu rays, %zu hits, %zu differences at edges, %zu unexplained\n", kRays, found, atEdges, unexplained);
  EXPECT_EQ(unexplained, 0u);
  EXPECT_GT(found, kRays / 10);
  EXPECT_LE(atEdges, kRays / 10000);  // one in 10,000: the meshes' edges cover far less of what rays see
}

INSTANTIATE_TEST_SUITE_P(Meshes, KernelAgainstEmbree, ::testing::Range(0, 3), [](const auto& i) {
  return std::string(std::array{"sphere", "torusKnot", "soup"}[static_cast<std::size_t>(i.param)]);
});

}  // namespace
}  // namespace crosslight::testing
