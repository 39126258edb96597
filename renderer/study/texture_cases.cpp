// Cases of texture coordinates: far from zero, beside the seam of a repetition, mirrored.
#include "scene/mesh_repair.h"
#include "study/cases.h"
#include "study/pictures.h"
#include "study/probe.h"

namespace crosslight::study {
namespace {

constexpr std::uint32_t kSize = 64;

// A square that fills the view; the texture coordinates of its corners, counter-clockwise from the lower left.
Primitive squareWith(const std::vector<glm::vec2>& uv, double side = 1) {
  Primitive p;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    p.positions.emplace_back(glm::dvec3(side * x, y, -1));
  p.normals.assign(4, {0, 0, 1});
  p.uv0 = uv;
  p.indices = side > 0 ? std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3} : std::vector<std::uint32_t>{0, 2, 1, 0, 3, 2};
  return p;
}

void offsetCoordinates(const Bench& bench, CaseResult& result) {
  Stage stage;
  const float base = 1e6f;
  Primitive p = squareWith({{base, 0}, {base + 4, 0}, {base + 4, 1}, {base, 1}});
  p.material = stage.add(emitter(1));
  stage.addMesh(p);
  stage.scene.cameras[0].yFov = 1.2;
  for (const Method method : kRasterAndRays) {
    RenderSettings s = settingsFor(method, kSize, kSize);
    s.aovs = {"uv"};
    const Shot shot = bench.draw(stage.scene, s);
    Worst worst;
    for (std::uint32_t x = 0; x < kSize; ++x) {
      const double across = rayThrough(stage.scene.cameras[0], x + 0.5, kSize / 2 + 0.5, kSize, kSize).x;
      const double exact = static_cast<double>(base) + 2 * (1 + across);
      worst.addAbsolute(vectorAt(shot.image, "uv", std::size_t{kSize / 2} * kSize + x).x, exact);
    }
    // 0.0625 at a million; the sum of three products rounds at most three times.
    result.measure(techniqueOf(method), "texture coordinate on a ramp from 1,000,000 to 1,000,004", worst, 3 * 0.0625,
                   "absolute");
  }
}

// A texture of three columns, read at places that are exact in single precision.
Stage columnsAt(float u) {
  Stage stage;
  Material m = emitter(0);
  m.emissiveFactor = glm::vec3(1);
  m.emissiveTexture.image = 0;
  m.emissiveTexture.filter = m.emissiveTexture.minFilter = Filter::nearest;
  stage.scene.images.push_back({"columns", 3, 1, {0, 0, 0, 1, 0.5f, 0.5f, 0.5f, 1, 1, 1, 1, 1}});
  Primitive p = squareWith(std::vector<glm::vec2>(4, glm::vec2(u, 0.5f)));
  p.material = stage.add(m);
  stage.addMesh(p);
  return stage;
}

void repeatedFarAway(const Bench& bench, CaseResult& result) {
  const float places[] = {0.25f, 1000000.25f, 1000000.5f, 1000000.75f, -999999.75f, -1e-9f, -1e-30f, 0, 349525.5f};
  for (const Method method : kRasterAndRays) {
    std::uint64_t wrong = 0, naive = 0;
    for (const float u : places) {
      const Shot shot = bench.draw(columnsAt(u).scene, settingsFor(method, 9, 9));
      const double texel = std::floor(3 * static_cast<double>(u)), column = texel - 3 * std::floor(texel / 3);
      // Black, gray, whether decoded from sRGB or not, and white.
      const float got = pixelAt(shot.image, 4, 4)[0];
      const double shown = got < 0.1f ? 0 : got > 0.9f ? 2 : 1;
      wrong += shown != column;
      const float fraction = u - std::floor(u);  // 1 for what lies just below 0
      naive += static_cast<int>(fraction * 3) > 2;
    }
    result.count(techniqueOf(method), "wrong columns of three, repeated, at u of 1,000,000 and just below 0", wrong,
                 std::size(places), static_cast<double>(naive));
  }
}

// A tilted map on a square, and on its mirror image with the same coordinates, under mirrored light.
Stage bumped(double side) {
  Stage stage;
  Material m = lambert(1);
  m.normalTexture.image = 0;
  stage.scene.images.push_back({"tilt", 1, 1, {200 / 255.0f, 180 / 255.0f, 220 / 255.0f, 1}});
  Primitive p = squareWith({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, side);
  makeTangents(p, std::vector<glm::vec2>(p.uv0));
  p.material = stage.add(m);
  stage.addMesh(p);
  stage.scene.lights = {lampAt({side * 0.8, 0.5, 0})};
  return stage;
}

void mirroredCoordinates(const Bench& bench, CaseResult& result) {
  for (const Method method : kRasterAndRays) {
    const RenderSettings s = settingsFor(method, kSize, kSize);
    const Shot right = bench.draw(bumped(1).scene, s), left = bench.draw(bumped(-1).scene, s);
    const Image back = mirrored(left.image);
    Worst worst;
    compareColors(back, right.image, worst);
    // The bitangent as n x t: up becomes down where the texture is mirrored.
    const glm::dvec3 local = glm::normalize((glm::dvec3(200, 180, 220) - 128.0) / 127.0);
    worst.addNaive(2 * local.y);
    result.measure(techniqueOf(method), "bumps on mirrored coordinates, in a mirrored picture", worst, 1e-5,
                   "absolute");
    result.show(std::string(techniqueOf(method)) + ": bumps under a lamp", right.image);
    result.show(std::string(techniqueOf(method)) + ": mirrored, and mirrored back", back);
  }
}

// A sphere's pole in the middle of the picture; rays only: raster draws a mesh with coordinates of its own.
void poles(const Bench& bench, CaseResult& result) {
  Stage stage;
  stage.addShape(ShapeKind::sphere, {1, 0, 0, 0}, {0, 0, -3}, stage.add(emitter(1)));
  glm::dmat4& place = stage.scene.shapes[0].worldFromObject;
  place[0] = {1, 0, 0, 0};
  place[1] = {0, 0, 1, 0};  // its axis points at the camera
  place[2] = {0, -1, 0, 0};
  stage.scene.cameras[0].yFov = 0.6;
  RenderSettings s = settingsFor(Method::whitted, kSize + 1, kSize + 1);
  s.aovs = {"uv"};
  const Shot shot = bench.draw(stage.scene, s);
  std::uint64_t outside = 0;
  for (std::size_t i = 0; i < shot.image.pixels(); ++i) {
    const glm::dvec3 uv = vectorAt(shot.image, "uv", i);
    outside += !(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1);
  }
  const float beyond = askOperation(bench.device, Operation::arcCosine, {{std::nextafter(1.0f, 2.0f), 0, 0}})[0];
  Worst pole;
  pole.addAbsolute(vectorAt(shot.image, "uv", shot.image.pixels() / 2).y, 0);
  pole.addNaive(std::abs(static_cast<double>(beyond)));
  result.count("whitted", "texture coordinates of a sphere outside of [0, 1]", outside, shot.image.pixels());
  // Vulkan: atan to 4096 ulp, acos by it.
  result.measure("whitted", "v at the pole", pole, 4.9e-4, "absolute");
}

}  // namespace

std::vector<HardCase> textureCases() {
  return {
      {"R11", "texture coordinates around a million", "steps of a sixteenth are all that single precision has there",
       "three roundings of a million", true, offsetCoordinates, nullptr,
       "the digits are gone in the file already; what is held is that no more go"},
      {"R20", "repetitions far from zero, and just below it",
       "the fraction of -1e-9 rounds to 1: an index beyond the texture", "the column by the floor, exactly", true,
       repeatedFarAway},
      {"X4", "poles of spheres", "acos of what rounds to just above 1 is NaN, and the longitude of a pole atan(0, 0)",
       "4096 ulp of atan, by Vulkan", true, poles},
      {"X2", "mirrored texture coordinates", "without the sign of their handedness bumps become dents",
       "the picture mirrored back; "
       "positions and tangents are exact mirrors",
       true, mirroredCoordinates},
  };
}

}  // namespace crosslight::study
