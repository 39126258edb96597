// Cases of triangles and boxes: closed meshes without gaps, boxes met in their faces and edges, rays that are none.
#include <array>
#include <numbers>

#include "study/cases.h"
#include "study/meshes.h"
#include "study/naive.h"
#include "study/probe.h"
#include "study/random_numbers.h"

namespace crosslight::study {
namespace {

bool naiveMisses(const glm::vec3& o, const glm::vec3& d, const std::vector<glm::vec3>& corners) {
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    if (naive::hitsTriangle(o, d, corners[i], corners[i + 1], corners[i + 2])) return false;
  }
  return true;
}

// From inside the mesh to its vertices, and to points on its edges.
std::vector<ProbeArguments> aimed(const std::vector<glm::vec3>& corners, const glm::dvec3& center, std::size_t count) {
  Random random(8);
  std::vector<ProbeArguments> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 origin(center + 0.8 * random.unit() * random.direction());
    const std::size_t t = 3 * random.below(corners.size() / 3), k = random.below(3);
    const glm::dvec3 a(corners[t + k]), b(corners[t + (k + 1) % 3]);
    const glm::dvec3 target = i % 2 == 0 ? a : a + random.unit() * (b - a);
    rays.push_back({{origin, 0}, {glm::vec3(target - glm::dvec3(origin)), 0}, {}, {}});
  }
  return rays;
}

void closedMeshes(const Bench& bench, CaseResult& result) {
  const std::size_t rays = bench.full ? 100000 : 8000;
  const std::array<std::pair<const char*, glm::dvec3>, 3> places{
      {{"at the origin", {0, 0, 0}},
       {"at (148376, 1234, -223423)", {148376, 1234, -223423}},
       {"at 1e6", {1e6, 1e6, 1e6}}}};
  for (const auto& [name, center] : places) {
    const std::vector<glm::vec3> corners = uvSphereCorners(24, 48, center, 2.0);
    const std::vector<ProbeArguments> arguments = aimed(corners, center, rays);
    std::uint64_t missed = 0, naive = 0;
    const auto answers = askFunction(bench.device, Function::mesh, arguments, corners);
    for (std::size_t i = 0; i < rays; ++i) {
      missed += !(answers[i].a.x >= 1.0f);
      if (i < 2000) naive += naiveMisses(glm::vec3(arguments[i].a), glm::vec3(arguments[i].b), corners);
    }
    result.count("kernel", std::string("rays to vertices and edges that leave a closed sphere ") + name, missed, rays,
                 static_cast<double>(naive));
  }
}

struct BoxRay {
  glm::vec3 origin, direction;
};

void boxesInTheirFaces(const Bench& bench, CaseResult& result) {
  const float z = 0.0f, m = -0.0f;
  const std::vector<BoxRay> rays{{{0, 0.5f, -1}, {z, 0, 1}}, {{0, 0.5f, -1}, {m, 0, 1}}, {{1, 0.5f, -1}, {z, 0, 1}},
                                 {{1, 0.5f, -1}, {m, 0, 1}}, {{0, 0, -1}, {z, z, 1}},    {{1, 1, -1}, {m, m, 1}},
                                 {{0, 0, -1}, {1, 0, 1}},    {{0.5f, 1, 0}, {1, z, 0}}};
  std::vector<ProbeArguments> arguments;
  std::uint64_t missed = 0, naive = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (i == 6)
      arguments.push_back({{0, 0, 0, 0}, {1, 1, 1, 0}, {glm::vec3(-1, 0, -1), 0}, {1, 0, 1, 0}});
    else
      arguments.push_back({{0, 0, 0, 0}, {1, 1, 1, 0}, {rays[i].origin, 0}, {rays[i].direction, 0}});
    naive += !naive::hitsBox(glm::vec3(arguments[i].c), glm::vec3(arguments[i].d), glm::vec3(0), glm::vec3(1));
  }
  for (const ProbeAnswer& answer : askFunction(bench.device, Function::slabs, arguments)) missed += answer.a.x != 1.0f;
  result.count("kernel", "rays in faces and edges of a closed box that miss it", missed, rays.size(),
               static_cast<double>(naive));
}

void raysThatAreNone(const Bench& bench, CaseResult& result) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const glm::vec3 a(-1, -1, 0), b(1, -1, 0), c(0, 1, 0);
  struct Row {
    glm::vec3 o, d;
    float tMax;
  };
  const std::vector<Row> rows{{{nan, 0, 1}, {0, 0, -1}, inf}, {{0, 0, 1}, {nan, 0, -1}, inf},
                              {{0, 0, 1}, {0, 0, nan}, inf},  {{0, 0, 1}, {0, 0, 0}, inf},
                              {{0, 0, inf}, {0, 0, -1}, inf}, {{0, 0, 1}, {0, 0, -inf}, inf},
                              {{0, 0, 1}, {0, 0, -1}, nan},   {{inf, 0, 1}, {0, 0, -1}, inf}};
  std::vector<ProbeArguments> triangles, spheres;
  std::uint64_t naive = 0;
  for (const Row& r : rows) {
    triangles.push_back({{a, r.d.x}, {b, r.d.y}, {c, r.d.z}, {r.o, r.tMax}});
    spheres.push_back({{static_cast<float>(ShapeKind::sphere), 0, r.tMax, 0}, {1, 0, 0, 0}, {r.o * 2.0f, 0}, {r.d, 0}});
    // The textbook's test written as reasons to reject, none of which holds of NaN.
    const glm::vec3 e1 = b - a, e2 = c - a, p = glm::cross(r.d, e2), s = r.o - a, q = glm::cross(s, e1);
    const float det = glm::dot(e1, p), u = glm::dot(s, p) / det, v = glm::dot(r.d, q) / det, t = glm::dot(e2, q) / det;
    naive += !(u < 0 || u > 1 || v < 0 || u + v > 1 || t < 0 || t > r.tMax);
  }
  std::uint64_t hits = 0;
  for (const ProbeAnswer& answer : askFunction(bench.device, Function::triangle, triangles)) hits += answer.a.w == 1.0f;
  result.count("kernel", "rays with NaN, infinity or no direction that meet a triangle", hits, rows.size(),
               static_cast<double>(naive));
  hits = 0;
  for (const ProbeAnswer& answer : askFunction(bench.device, Function::shape, spheres)) hits += answer.a.w == 1.0f;
  result.count("kernel", "the same rays that meet a sphere", hits, rows.size());
}

}  // namespace

std::vector<HardCase> meshCases() {
  return {
      {"T8", "a closed mesh has no holes",
       "tests that round each triangle by itself let rays through between two of them",
       "Woop, Benthin, Wald 2013: both sides of an edge compute the same bits, so none", true, closedMeshes},
      {"T10", "rays in the faces of a box", "0 times infinity: the slab test of a ray within a face compares with NaN",
       "a closed box contains its faces: none", true, boxesInTheirFaces},
      {"T24", "rays that are none", "a NaN passes every test that lists reasons to reject", "none may hit", true,
       raysThatAreNone},
  };
}

}  // namespace crosslight::study
