// Cases of shadows: surfaces that shade themselves, by rays and by maps, and lights at both ends of the scale.
#include <fmt/format.h>

#include "study/cases.h"
#include "study/naive.h"
#include "study/pictures.h"
#include "study/random_numbers.h"

namespace crosslight::study {
namespace {

constexpr std::uint32_t kSize = 96;

// A square floor of this half size, its normal +y, turned about x and moved.
Stage floorSeenFrom(double halfSize, double turn, double distance, const glm::dvec3& at) {
  Stage stage;
  Primitive p;
  const auto h = static_cast<float>(halfSize);
  p.positions = {{-h, 0, -h}, {-h, 0, h}, {h, 0, h}, {h, 0, -h}};
  p.normals.assign(4, {0, 1, 0});
  p.indices = {0, 1, 2, 0, 2, 3};
  p.material = stage.add(lambert(1));
  const glm::dmat3 about(glm::dvec3(1, 0, 0), glm::dvec3(0, std::cos(turn), std::sin(turn)),
                         glm::dvec3(0, -std::sin(turn), std::cos(turn)));
  glm::dmat4 place(about);
  place[3] = glm::dvec4(at, 1.0);
  stage.addMesh(p, place);
  const glm::dvec3 back = glm::normalize(glm::dvec3(0.3, 0.7, 0.5)),
                   right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back));
  Camera& camera = stage.scene.cameras[0];
  camera.worldFromCamera = glm::dmat4(about * glm::dmat3(right, glm::cross(back, right), back));
  camera.worldFromCamera[3] = glm::dvec4(at + about * (back * distance), 1.0);
  camera.zNear = 0.001 * distance;
  stage.scene.lights = {sunAlong(about * glm::dvec3(-0.8, -0.5, 0.3))};
  return stage;
}

struct Shaded {
  std::uint64_t lit = 0, dark = 0;
};

// Lit pixels, and those of them that shadows change where nothing casts one.
Shaded shadedPixels(const Bench& bench, const Stage& stage, RenderSettings s, CaseResult& result) {
  const Shot with = bench.draw(stage.scene, s);
  s.shadows = false;
  s.rasterShadows = RasterShadows::off;
  const Shot without = bench.draw(stage.scene, s);
  Shaded counts;
  for (std::size_t i = 0; i < with.image.pixels(); ++i) {
    const float a = with.image.picture().samples[4 * i], b = without.image.picture().samples[4 * i];
    counts.lit += b > 0;
    counts.dark += b > 0 && a != b;
  }
  if (counts.dark > 0 && result.pictures().size() < 4) result.show("with shadows; nothing casts one", with.image);
  return counts;
}

// How many points o + t d, moved up by `offset`, lie beneath the floor: rays of a picture in single precision.
double naiveBeneath(double distance, double at, float offset, std::size_t rays) {
  Random random(1);
  std::uint64_t beneath = 0;
  const glm::dvec3 eye = glm::normalize(glm::dvec3(0.3, 0.7, 0.5)) * distance + at;
  for (std::size_t i = 0; i < rays; ++i) {
    const glm::dvec3 target = at + distance * glm::dvec3(random.between(-0.3, 0.3), 0, random.between(-0.3, 0.3));
    const glm::vec3 p = naive::pointOnPlane(glm::vec3(eye), glm::vec3(glm::normalize(target - eye)), {0, 1, 0},
                                            static_cast<float>(at), offset);
    beneath += p.y < static_cast<float>(at);
  }
  return static_cast<double>(beneath);
}

// Points near the diagonal of a turned square whose shadow rays meet the triangle on the other side of it.
double naiveNeighbors(double turn, std::size_t rays) {
  Random random(2);
  const auto turned = [&](double x, double z) {
    return glm::dvec3(x, -std::sin(turn) * z, std::cos(turn) * z) + glm::dvec3(0.1, 0.2, 0.3);
  };
  const glm::dvec3 n(0, std::cos(turn), std::sin(turn)), eye = turned(0.9, 1.5) + 2.1 * n,
                                                         light = turned(0.8, -0.3) + 0.5 * n - turned(0, 0);
  const glm::vec3 a(turned(-1, -1)), b(turned(1, 1)), c(turned(1, -1)), d(turned(-1, 1));
  std::uint64_t met = 0;
  for (std::size_t i = 0; i < rays; ++i) {
    const double s = random.between(-0.9, 0.9), aside = random.between(-1, 1) * 1e-7;
    const glm::dvec3 target = turned(s + aside, s - aside);
    const glm::vec3 p = naive::pointOnPlane(glm::vec3(eye), glm::vec3(glm::normalize(target - eye)), glm::vec3(n),
                                            static_cast<float>(glm::dot(n, turned(0, 0))), 0);
    const glm::vec3 l(glm::normalize(light));
    met += aside > 0 ? naive::hitsTriangle(p, l, a, d, b) : naive::hitsTriangle(p, l, a, b, c);
  }
  return static_cast<double>(met);
}

// Points of a floor in the light that lie farther from it than the middle of their texel.
double naiveBelowMap(double radians, std::size_t points) {
  Random random(3);
  std::uint64_t below = 0;
  const auto slope = static_cast<float>(std::tan(radians));
  for (std::size_t i = 0; i < points; ++i) {
    const auto u = static_cast<float>(random.between(0, 256));
    below += slope * u > slope * (std::floor(u) + 0.5f);
  }
  return static_cast<double>(below);
}

void selfIntersection(const Bench& bench, CaseResult& result) {
  for (const Method method : kRasterAndRays) {
    Shaded all;
    double naive = 0;
    for (const double at : {0.0, 1.0, 1e3, 1e6}) {
      for (const double distance : {10.0, 1e4}) {
        for (const double turn : {0.4, 2.0}) {
          RenderSettings s = settingsFor(method, kSize, kSize);
          s.rasterShadows = RasterShadows::rays;
          const Shaded one = shadedPixels(bench, floorSeenFrom(distance, turn, distance, glm::dvec3(at)), s, result);
          all.lit += one.lit;
          all.dark += one.dark;
          naive += naiveBeneath(distance, at, 1e-4f, 1000);
        }
      }
    }
    result.count(techniqueOf(method), "pixels of floors that shade themselves, in 16 configurations", all.dark, all.lit,
                 naive);
  }
}

void shadowsBesideEdges(const Bench& bench, CaseResult& result) {
  for (const Method method : kRasterAndRays) {
    Shaded all;
    for (const double turn : {0.0, 0.3, 0.7, 1.1, 1.9, 2.6}) {
      Stage stage = floorSeenFrom(1, turn, 3, {0.1, 0.2, 0.3});
      // Seen from far along the diagonal of the two triangles: half of the pixels lie beside the shared edge.
      stage.scene.cameras[0].yFov = 0.05;
      RenderSettings s = settingsFor(method, kSize, kSize);
      s.rasterShadows = RasterShadows::rays;
      const Shaded one = shadedPixels(bench, stage, s, result);
      all.lit += one.lit;
      all.dark += one.dark;
    }
    // Skipping the triangle that the ray leaves does not skip its neighbor across the edge.
    result.count(techniqueOf(method), "pixels beside a shared edge that the neighbor shades", all.dark, all.lit,
                 naiveNeighbors(0.7, 10000));
  }
}

void mapAcne(const Bench& bench, CaseResult& result) {
  for (const double degrees : {0.0, 45.0, 60.0, 80.0, 85.0}) {
    Stage stage = floorSeenFrom(3, 0.4, 8, {0, 0, 0});
    const double a = degrees * static_cast<double>(kPiReal) / 180;
    const glm::dmat3 about(stage.scene.instances[0].worldFromObject);
    stage.scene.lights = {sunAlong(about * glm::dvec3(-std::sin(a), -std::cos(a), 0.0))};
    RenderSettings s = settingsFor(Method::phong, kSize, kSize);
    s.rasterShadows = RasterShadows::maps;
    s.shadowMaps.size = 256;
    const Shaded counts = shadedPixels(bench, stage, s, result);
    result.count("phong", fmt::format("pixels of a floor under light at {:g} degrees that its own map shades", degrees),
                 counts.dark, counts.lit, naiveBelowMap(a, 10000));
  }
}

// A wall that stands on a floor, seen from above; a spot light from the left, 37 degrees off the floor's normal.
Stage wallOnFloor() {
  Stage stage;
  const int material = stage.add(lambert(1));
  Primitive wall;
  wall.positions = {{0, -1, -4}, {0, 1, -4}, {0, 1, -3}, {0, -1, -3}};
  wall.normals.assign(4, {-1, 0, 0});
  wall.indices = {0, 3, 2, 0, 2, 1};
  wall.material = stage.add(lambert(0));
  stage.scene.materials.back().doubleSided = true;
  stage.addWall(-4.0, material);
  stage.addMesh(wall);
  Light spot;
  spot.type = LightType::spot;
  spot.classic = ClassicLight{};
  spot.classic->spotCutoff = 30;
  spot.worldPosition = {-3, 0, 0};
  spot.worldDirection = glm::normalize(glm::dvec3(3, 0, -4));
  stage.scene.lights = {spot};
  Camera& camera = stage.scene.cameras[0];
  camera.orthographic = true;
  camera.xMag = camera.yMag = 1.5;
  camera.zFar = 10;
  return stage;
}

// How far lit and dark pixels of a row that rays and the map tell differently are from the next edge of the rays'
// shadow, in pixels.
int farthestFromEdge(const std::vector<bool>& rays, const std::vector<bool>& map) {
  int farthest = 0;
  const int width = static_cast<int>(rays.size());
  for (int x = 0; x < width; ++x) {
    if (rays[static_cast<std::size_t>(x)] == map[static_cast<std::size_t>(x)]) continue;
    int reach = 1;
    const auto differs = [&](int at) {
      return at >= 0 && at < width && rays[static_cast<std::size_t>(at)] != rays[static_cast<std::size_t>(x)];
    };
    while (reach < width && !differs(x - reach) && !differs(x + reach)) ++reach;
    farthest = std::max(farthest, reach);
  }
  return farthest;
}

void detachedShadows(const Bench& bench, CaseResult& result) {
  constexpr std::uint32_t kWide = 256;
  const Stage stage = wallOnFloor();
  RenderSettings s = settingsFor(Method::phong, kWide, kWide);
  s.rasterShadows = RasterShadows::rays;
  const Shot rays = bench.draw(stage.scene, s);
  s.rasterShadows = RasterShadows::maps;
  s.shadowMaps.size = 512;
  s.shadowMaps.filterSize = 1;
  const Shot map = bench.draw(stage.scene, s);
  int farthest = 0;
  std::uint64_t compared = 0;
  for (std::uint32_t y = kWide / 4; y < 3 * kWide / 4; ++y) {
    std::vector<bool> a, b;
    for (std::uint32_t x = 0; x < kWide; ++x) {
      a.push_back(pixelAt(rays.image, x, y)[0] > 0);
      b.push_back(pixelAt(map.image, x, y)[0] > 0);
    }
    farthest = std::max(farthest, farthestFromEdge(a, b));
    compared += kWide;
  }
  // A texel on the floor, and a pixel: the map covers the cone at the light's distance of 5, slanted by 37 degrees.
  const double texel = 2 * 5 * std::tan(30 * static_cast<double>(kPiReal) / 180) / 512 / 0.8, pixel = 3.0 / kWide;
  Worst gap;
  const double most = farthest * pixel / texel;
  gap.add(most, 0, most);
  for (std::uint64_t i = 1; i < compared; ++i) gap.add(0, 0, 0);
  // A constant offset that keeps floors free of acne up to 85 degrees, along light 37 degrees off the normal.
  gap.addNaive(std::tan(85 * static_cast<double>(kPiReal) / 180) * 0.6);
  result.measure("phong", "gap between a wall and its shadow", gap, 3, "texels");
  result.show("by rays", rays.image);
  result.show("by a map of 512 texels", map.image);
}

void lightsAtBothEnds(const Bench& bench, CaseResult& result) {
  for (const Method method : kRasterAndRays) {
    std::uint64_t dark = 0, lit = 0;
    double naive = 0;
    for (const double height : {1e-5, 1e-3, 1.0, 1e3, 1e6}) {
      Stage stage = floorSeenFrom(3, 0.4, 8, {0, 0, 0});
      const glm::dmat3 about(stage.scene.instances[0].worldFromObject);
      stage.scene.lights = {lampAt(about * glm::dvec3(0.1, height, 0.2))};
      RenderSettings s = settingsFor(method, kSize, kSize);
      s.rasterShadows = RasterShadows::rays;
      const Shaded one = shadedPixels(bench, stage, s, result);
      dark += one.dark;
      lit += one.lit;
      naive += naiveBeneath(8, 0, 0, 1000);
    }
    result.count(techniqueOf(method), "dark pixels under a lamp 1e-5 ... 1e6 above a floor", dark, lit, naive);
  }
}

}  // namespace

std::vector<HardCase> shadowCases() {
  return {
      {"T1", "surfaces that shade themselves",
       "o + t d lies beneath the surface about every second time, and farther than any "
       "fixed offset where t is large",
       "the point by barycentrics, offset by its gamma_7: none", true, selfIntersection},
      {"T2", "shadows beside shared edges",
       "leaving out the triangle that a ray leaves does not leave out its neighbor", "none", true, shadowsBesideEdges},
      {"T25", "lamps that almost touch, and lamps far away",
       "offsets at either end of a shadow ray put the surface or the light "
       "on the wrong side",
       "nothing stands between: none", true, lightsAtBothEnds},
      {"R14", "shadows that come off their objects",
       "the offset that keeps tilted floors free of stripes moves every shadow away",
       "a texel of the map, one of its offset along the light, and the pixel's own", true, detachedShadows},
      {"R13", "shadow maps on tilted floors",
       "a texel's depth is that of its middle: half of a tilted floor lies below it",
       "offset of texel times tan(angle), widened by the filter: none up to 85 degrees", true, mapAcne},
  };
}

}  // namespace crosslight::study
