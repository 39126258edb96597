// What is found through the tree of boxes against all triangles one by one.
#include <glm/common.hpp>

#include "study/cases.h"
#include "study/naive.h"
#include "study/pictures.h"
#include "study/probe.h"
#include "study/random_numbers.h"

namespace crosslight::study {
namespace {

constexpr std::uint32_t kSize = 64;

// Small triangles in front of the camera; every other one is flat along an axis, so that its box has no thickness.
std::vector<oracle::Triangle> soup(std::size_t count) {
  Random random(11);
  std::vector<oracle::Triangle> triangles;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 middle(random.between(-2.5, 2.5), random.between(-2.5, 2.5), random.between(-9, -4));
    glm::vec3 corners[3];
    for (glm::vec3& c : corners) c = glm::vec3(middle) + random.inBox(0.5);
    for (int k = 1; i % 2 == 0 && k < 3; ++k) corners[k].z = corners[0].z;
    triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return triangles;
}

Stage staged(const std::vector<oracle::Triangle>& triangles) {
  Stage stage;
  stage.scene.cameras[0].yFov = 0.8;
  Material m = emitter(1);
  m.doubleSided = true;
  Primitive p;
  for (const oracle::Triangle& t : triangles) p.positions.insert(p.positions.end(), {t.v0, t.v1, t.v2});
  for (std::uint32_t i = 0; i < p.positions.size(); ++i) p.indices.push_back(i);
  p.normals.assign(p.positions.size(), {0, 0, 1});
  p.material = stage.add(m);
  stage.addMesh(p);
  return stage;
}

struct Box {
  glm::vec3 low, high;
};
Box boxOf(const oracle::Triangle& t) {
  return {glm::min(glm::min(t.v0, t.v1), t.v2), glm::max(glm::max(t.v0, t.v1), t.v2)};
}

// Rays aimed at the corners of triangles: where the triangle is met its box must be.
void boxesOfWhatIsMet(const Bench& bench, CaseResult& result) {
  const std::vector<oracle::Triangle> triangles = soup(bench.full ? 200000 : 20000);
  Random random(12);
  std::vector<ProbeArguments> rays, boxes;
  for (const oracle::Triangle& t : triangles) {
    const glm::vec3 o = random.inBox(10), d = t.v1 - o;
    const Box box = boxOf(t);
    rays.push_back({{t.v0, d.x}, {t.v1, d.y}, {t.v2, d.z}, {o, 3e38f}});
    boxes.push_back({{box.low, 0}, {box.high, 0}, {o, 0}, {d, 0}});
  }
  const auto met = askFunction(bench.device, Function::triangle, rays),
             entered = askFunction(bench.device, Function::slabs, boxes);
  std::uint64_t missed = 0, naive = 0, compared = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (met[i].a.w != 1.0f) continue;
    ++compared;
    missed += entered[i].a.x != 1.0f;
    naive +=
        !naive::hitsBox(glm::vec3(boxes[i].c), glm::vec3(boxes[i].d), glm::vec3(boxes[i].a), glm::vec3(boxes[i].b));
  }
  result.count("kernel", "rays that meet a corner of a triangle but not its box", missed, compared,
               static_cast<double>(naive));
}

void treeAgainstAll(const Bench& bench, CaseResult& result) {
  const std::vector<oracle::Triangle> triangles = soup(600);
  const Stage stage = staged(triangles);
  const Camera& camera = stage.scene.cameras[0];
  std::vector<Coverage> expected;
  for (std::uint32_t i = 0; i < kSize * kSize; ++i) {
    const double x = i % kSize + 0.5, y = i / kSize + 0.5;
    expected.push_back(coverageAt(camera, triangles, x, y, kSize, kSize, 1.0 / 64));
  }
  for (const Method method : kRasterAndRays) {
    RenderSettings s = settingsFor(method, kSize, kSize);
    s.aovs = {"primitiveId"};
    const Shot shot = bench.draw(stage.scene, s);
    const std::vector<std::uint32_t>& ids = shot.image.find("primitiveId")->integers;
    std::uint64_t wrong = 0, compared = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (!expected[i].certain) continue;
      ++compared;
      wrong += ids[i] != expected[i].id.value_or(0xffffffffu);
    }
    result.count(techniqueOf(method), "pixels that show another triangle than all of 600, one by one, say", wrong,
                 compared);
  }
  boxesOfWhatIsMet(bench, result);
}

}  // namespace

std::vector<HardCase> treeCases() {
  return {{"T11", "the tree finds what brute force finds",
           "a box of no thickness is missed by one rounding, and with it the triangle in it",
           "boxes widened by 2 gamma_3 (Ize 2013): none, 1/64 pixel from edges", true, treeAgainstAll}};
}

}  // namespace crosslight::study
