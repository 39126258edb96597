// Cases of projection: which of two surfaces is in front, what is on the screen, where on a surface a pixel lies.
#include <fmt/format.h>

#include "study/cases.h"
#include "study/pictures.h"

namespace crosslight::study {
namespace {

constexpr std::uint32_t kSize = 96;

RenderSettings withIds(Method method) {
  RenderSettings s = settingsFor(method, kSize, kSize);
  s.aovs = {"instanceId"};
  return s;
}

// A tilted square that fills the view at this distance; `nearer` shrinks it towards the eye, so that the gap is the
// same share of the distance everywhere.
Primitive tiltedSquare(double distance, double nearer, int material) {
  Primitive p;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const double z = distance * (1 + 0.15 * x) * (1 - nearer);
    p.positions.emplace_back(glm::dvec3(0.6 * x * z, 0.6 * y * z, -z));
  }
  p.normals.assign(4, {0, 0, 1});
  p.indices = {0, 1, 2, 0, 2, 3};
  p.material = material;
  return p;
}

// Pixels at which the standard projection, z' = f/(f-n) (1 - n/z) in single precision, cannot tell the two apart.
std::uint64_t lostByStandardDepth(double distance, double gap) {
  const auto depth = [](double z) { return static_cast<float>(1e4 / (1e4 - 0.1) * (1 - 0.1 / z)); };
  std::uint64_t lost = 0;
  for (std::uint32_t x = 0; x < kSize; ++x) {
    const double z = distance * (0.85 + 0.3 * (x + 0.5) / kSize);
    lost += !(depth(z * (1 - gap)) < depth(z));
  }
  return lost * kSize;
}

void closeSurfaces(const Bench& bench, CaseResult& result) {
  for (const Method method : kRasterAndRays) {
    // Rays meet both by their own rounded distance: a dozen roundings each. Raster's depth is n / z, one.
    const double gap = method == Method::whitted ? 2e-6 : 4e-7;
    for (const double distance : {10.0, 100.0, 1000.0, 7000.0}) {
      std::uint64_t wrong = 0;
      for (const bool frontFirst : {true, false}) {
        Stage stage;
        stage.scene.cameras[0].zNear = 0.1;
        stage.scene.cameras[0].yFov = 1.0;
        const int front = stage.add(emitter(1)), back = stage.add(emitter(0.25f));
        for (const bool isFront : {frontFirst, !frontFirst})
          stage.addMesh(tiltedSquare(distance, isFront ? gap : 0, isFront ? front : back));
        const Shot shot = bench.draw(stage.scene, withIds(method));
        for (std::size_t i = 0; i < shot.image.pixels(); ++i)
          wrong += objectAt(shot.image, i) != (frontFirst ? 0u : 1u);
        if (wrong > 0 && distance > 5000) result.show("the white square is in front", shot.image);
      }
      result.count(techniqueOf(method),
                   fmt::format("pixels that show the square behind, {:g} of the distance {:g} apart", gap, distance),
                   wrong, 2 * kSize * kSize, static_cast<double>(2 * lostByStandardDepth(distance, gap)));
    }
  }
}

// Squares that face the eye, apart by two units in the last place of their distance.
void depthSteps(const Bench& bench, CaseResult& result) {
  std::uint64_t wrong = 0, naive = 0, compared = 0;
  for (const double distance : {1.0, 10.0, 100.0, 1000.0, 9000.0}) {
    const double gap = 2 * kUlp;
    Stage stage;
    stage.scene.cameras[0].zNear = 0.1;
    const int front = stage.add(emitter(1)), back = stage.add(emitter(0.25f));
    for (const bool isFront : {false, true}) {
      Primitive p = tiltedSquare(distance, isFront ? gap : 0, isFront ? front : back);
      for (glm::vec3& v : p.positions) v.z = static_cast<float>(-distance * (isFront ? 1 - gap : 1));
      stage.addMesh(p);
    }
    const Shot shot = bench.draw(stage.scene, withIds(Method::phong));
    for (std::size_t i = 0; i < shot.image.pixels(); ++i) wrong += objectAt(shot.image, i) == 0u;
    compared += shot.image.pixels();
    naive += lostByStandardDepth(distance, gap);
  }
  result.count("phong", "pixels that show the square behind, 2.4e-7 of the distance nearer, from 1 to 9000", wrong,
               compared, static_cast<double>(naive));
}

void hugeTriangles(const Bench& bench, CaseResult& result, const std::vector<double>& sizes) {
  for (const Method method : kRasterAndRays) {
    std::uint64_t missing = 0;
    for (const double k : sizes) {
      Stage stage;
      Primitive p;
      p.positions = {glm::vec3(glm::dvec3(-k, -k, -1)), glm::vec3(glm::dvec3(3 * k, -k, -1)),
                     glm::vec3(glm::dvec3(-k, 3 * k, -1))};
      p.normals.assign(3, {0, 0, 1});
      p.indices = {0, 1, 2};
      p.material = stage.add(emitter(1));
      stage.addMesh(p);
      const Shot shot = bench.draw(stage.scene, withIds(method));
      for (std::size_t i = 0; i < shot.image.pixels(); ++i) missing += objectAt(shot.image, i) != 0u;
    }
    result.count(
        techniqueOf(method),
        fmt::format("pixels that a triangle {:g} to {:g} screens wide leaves open", sizes.front(), sizes.back()),
        missing, sizes.size() * kSize * kSize);
  }
}

void largeTriangles(const Bench& bench, CaseResult& result) { hugeTriangles(bench, result, {1, 1e2, 1e4, 1e5}); }
void endlessTriangles(const Bench& bench, CaseResult& result) { hugeTriangles(bench, result, {1e6, 1e8, 1e10, 1e15}); }

// Triangles that reach behind the eye, in camera coordinates.
std::vector<oracle::Triangle> behindTheEye() {
  return {{{-100, -1, 50}, {100, -1, 50}, {0, -1, -1e4f}},
          {{-1, 3, 2}, {-1, 3, -50}, {-1, -2, -3}},
          {{2, 0, 0}, {2, 1, -6}, {2, -1, -6}},
          {{-5, -5, 1}, {5, -5, 1}, {0, 5, 3}}};
}

// Divides by w before anything is clipped.
bool naiveCovers(const oracle::Triangle& t, const glm::dvec3& ray) {
  glm::dvec2 p[3];
  for (int i = 0; const glm::vec3& v : {t.v0, t.v1, t.v2}) p[i++] = glm::dvec2(v) / static_cast<double>(-v.z);
  const auto side = [&](const glm::dvec2& a, const glm::dvec2& b) {
    return (b.x - a.x) * (ray.y - a.y) - (b.y - a.y) * (ray.x - a.x);
  };
  const double a = side(p[0], p[1]), b = side(p[1], p[2]), c = side(p[2], p[0]);
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

void acrossTheEye(const Bench& bench, CaseResult& result) {
  for (const Method method : kRasterAndRays) {
    std::uint64_t wrong = 0, compared = 0, nonfinite = 0, naive = 0;
    for (const oracle::Triangle& t : behindTheEye()) {
      Stage stage;
      stage.scene.cameras[0].yFov = 1.4;
      Primitive p;
      p.positions = {t.v0, t.v1, t.v2};
      p.normals.assign(3, {0, 1, 0});
      p.indices = {0, 1, 2};
      Material m = emitter(1);
      m.doubleSided = true;
      p.material = stage.add(m);
      stage.addMesh(p);
      const Shot shot = bench.draw(stage.scene, withIds(method));
      nonfinite += shot.nonfinite;
      const Camera& camera = stage.scene.cameras[0];
      for (std::uint32_t y = 0; y < kSize; ++y) {
        for (std::uint32_t x = 0; x < kSize; ++x) {
          // Raster snaps vertices to 1/256 of a pixel, those that clipping makes too.
          const Coverage c = coverageAt(camera, {t}, x + 0.5, y + 0.5, kSize, kSize, 1.0 / 64);
          if (!c.certain) continue;
          ++compared;
          wrong += (objectAt(shot.image, std::size_t{y} * kSize + x) == 0u) != c.id.has_value();
          naive += naiveCovers(t, rayThrough(camera, x + 0.5, y + 0.5, kSize, kSize)) != c.id.has_value();
        }
      }
    }
    result.count(techniqueOf(method), "pixels wrong of four triangles that reach behind the eye", wrong, compared,
                 static_cast<double>(naive));
    result.count(techniqueOf(method), "values that are not finite", nonfinite, compared);
  }
}

// Fills the view; its left edge is 0.1 away, its right edge 100,000; u runs from 0 to 1.
Stage deepWall() {
  Stage stage;
  stage.scene.cameras[0].yFov = 1.0;
  const double half = std::tan(0.5);
  Primitive p;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const double z = x < 0 ? 0.1 : 1e5;
    p.positions.emplace_back(glm::dvec3(x * z * half, 1.5 * y * z * half, -z));
    p.uv0.emplace_back(x < 0 ? 0.0f : 1.0f, y < 0 ? 0.0f : 1.0f);
  }
  p.normals.assign(4, {0, 0, 1});
  p.indices = {0, 1, 2, 0, 2, 3};
  p.material = stage.add(emitter(1));
  stage.addMesh(p);
  return stage;
}

void deepPerspective(const Bench& bench, CaseResult& result) {
  const Stage stage = deepWall();
  for (const Method method : kRasterAndRays) {
    RenderSettings s = withIds(method);
    s.aovs.push_back("uv");
    const Shot shot = bench.draw(stage.scene, s);
    Worst worst;
    for (std::uint32_t x = 0; x < kSize; ++x) {
      const double across = (x + 0.5) / kSize;  // 1/w is linear on the screen, and u/w
      const double u = across / 1e5 / ((1 - across) / 0.1 + across / 1e5);
      const double got = vectorAt(shot.image, "uv", std::size_t{kSize / 2} * kSize + x).x;
      // By raster 1/w, which falls from 10 to almost 0, has the roundings of 10 everywhere. By rays each place has its
      // own: those of the edge functions there.
      const double share = method == Method::whitted ? 1 : 1 - across;
      worst.add(got, u, share * std::abs(got / u - 1));
      worst.addNaive(share * std::abs(across / u - 1));
    }
    const bool rays = method == Method::whitted;
    result.measure(techniqueOf(method), "texture coordinate along a wall from 0.1 to 100,000 away", worst,
                   rays ? 1e-5 : 8 * kU, rays ? "relative" : "of 1/w at the near edge");
    result.count(techniqueOf(method), "values that are not finite", shot.nonfinite, shot.image.pixels());
  }
}

}  // namespace

std::vector<HardCase> depthCases() {
  return {
      {"R1", "depth steps by distance", "standard depth with its near plane at 0.1 resolves 25 units at 9000",
       "twice the float's own step, 2^-23 of the distance", true, depthSteps},
      {"R2", "nearly coincident surfaces",
       "standard depth cannot tell surfaces apart that are 1 % of their distance away "
       "from each other",
       "reversed depth n / z rounds once, 2^-24: twice that on each side and on the vertices", true, closeSurfaces},
      {"R8", "triangles far larger than the screen",
       "clip coordinates overflow what a rasterizer's edge functions hold", "the triangle covers every pixel", true,
       largeTriangles, nullptr, "clipping is the device's; what lies beyond its reach is the next case"},
      {"R8", "triangles a million screens wide", "beyond |x / w| = 100,000 the rasterizer's edge functions lose pixels",
       "the triangle covers every pixel", true, endlessTriangles,
       "lavapipe's rasterizer loses pixels of triangles beyond |x / w| = 1e5; rays do not",
       "clipping is the device\'s"},
      {"R9", "triangles that reach behind the eye",
       "projected before it is clipped, what is behind appears in front, upside down",
       "coverage in double, 1/64 pixel from edges", true, acrossTheEye},
      {"R10", "a wall from arm's length to the horizon",
       "interpolated linearly on the screen, its middle would be half way",
       "raster: two products and sums each of u/w and 1/w, a quotient; rays: 1e-5 as the catalog has it", true,
       deepPerspective},
  };
}

}  // namespace crosslight::study
