// Cases of transforms: far from the origin, in any unit, stretched, mirrored, shrunk almost to nothing.
#include <fmt/format.h>

#include "scene/shape_mesh.h"
#include "study/cases.h"
#include "study/naive.h"
#include "study/pictures.h"
#include "study/random_numbers.h"

namespace crosslight::study {
namespace {

constexpr std::uint32_t kWidth = 96, kHeight = 72;

glm::dmat4 scaledAt(const glm::dvec3& scale, const glm::dvec3& at) {
  glm::dmat4 m(1.0);
  for (int i = 0; i < 3; ++i) m[i][i] = scale[i];
  m[3] = glm::dvec4(at, 1.0);
  return m;
}

Material shiny() {
  Material m;
  m.model = IlluminationModel::blinnPhong;
  m.classic.ambientFactor = glm::vec3(0.0f);
  m.classic.diffuseFactor = {0.8f, 0.5f, 0.3f};
  m.classic.specularFactor = glm::vec3(0.4f);
  m.classic.shininess = 40;
  return m;
}

// A ball on a floor under a lamp, five away from the camera. In every unit: lengths times `unit`, and the lamp's light,
// which falls with the square of the distance, times its square.
Stage ballOnFloor(double unit, const glm::dvec3& at) {
  Stage stage;
  const int material = stage.add(shiny());
  Primitive ball = tessellateShape(ShapeKind::sphere, {1, 0, 0, 0}, 24);
  Primitive floor;
  floor.positions = {{-6, -1, 4}, {6, -1, 4}, {6, -1, -6}, {-6, -1, -6}};
  floor.normals.assign(4, {0, 1, 0});
  floor.indices = {0, 1, 2, 0, 2, 3};
  ball.material = floor.material = material;
  stage.addMesh(ball, scaledAt(glm::dvec3(unit), at));
  stage.addMesh(floor, scaledAt(glm::dvec3(unit), at));
  Light lamp;
  lamp.worldPosition = at + unit * glm::dvec3(-2, 4, 3);
  lamp.intensity = static_cast<float>(20 * unit * unit);
  stage.scene.lights = {lamp};
  Camera& camera = stage.scene.cameras[0];
  camera.zNear = 0.1 * unit;
  camera.yFov = 1.0;
  camera.worldFromCamera[3] = glm::dvec4(at + unit * glm::dvec3(0, 0, 5), 1.0);
  return stage;
}

RenderSettings shadowed(Method method) {
  RenderSettings s = settingsFor(method, kWidth, kHeight);
  s.rasterShadows = RasterShadows::rays;
  s.aovs = {"instanceId", "normal"};
  return s;
}

// Where positions are stored in single precision: the same picture with vertices rounded so far out.
std::uint64_t objectsMovedByRounding(const Bench& bench, const Image& expected, double x) {
  Stage stage = ballOnFloor(1, glm::dvec3(0));
  for (Mesh& mesh : stage.scene.meshes) {
    for (glm::vec3& p : mesh.primitives[0].positions)
      p = glm::vec3(glm::dvec3(p + glm::vec3(static_cast<float>(x))) - glm::dvec3(x));
  }
  RenderSettings s = shadowed(Method::phong);
  return differentObjects(bench.draw(stage.scene, s).image, expected);
}

void farFromTheOrigin(const Bench& bench, CaseResult& result) {
  for (const Method method : kRasterAndRays) {
    const Shot near = bench.draw(ballOnFloor(1, glm::dvec3(0)).scene, shadowed(method));
    Worst color;
    std::uint64_t moved = 0;
    for (const double x : {1e3, 1e5, 1e7}) {
      const Shot far = bench.draw(ballOnFloor(1, glm::dvec3(x)).scene, shadowed(method));
      compareColors(far.image, near.image, color);
      moved += differentObjects(far.image, near.image);
      if (x < 1e6) continue;
      result.show(fmt::format("{}: 10,000,000 from the origin", techniqueOf(method)), far.image);
      result.show(fmt::format("{}: difference, 10,000 times", techniqueOf(method)),
                  differenceOf(far.image, near.image, 1e4f));
    }
    const double naive = static_cast<double>(objectsMovedByRounding(bench, near.image, 1e7));
    result.count(techniqueOf(method), "pixels that show another object at 1e3, 1e5 and 1e7", moved,
                 3 * kWidth * kHeight, naive);
    // Object and camera differ by a double at 1e7: 2^-53 1e7 = 1e-9 of a length of 1, against 2^-24 of what follows.
    result.measure(techniqueOf(method), "colors there against those at the origin", color, 1e-3, "absolute");
    result.show(fmt::format("{}: at the origin", techniqueOf(method)), near.image);
  }
}

// Points of the floor whose shadow of the ball is wrong where shadow rays begin at o + t d, 1e-4 above the floor.
std::uint64_t wrongByFixedOffset(double unit) {
  Random random(4);
  const glm::dvec3 eye = unit * glm::dvec3(0, 0, 5), lamp = unit * glm::dvec3(-2, 4, 3);
  const auto isShaded = [&](const glm::dvec3& p) {
    const glm::dvec3 d = glm::normalize(lamp - p);
    const double along = -glm::dot(p, d);
    return along > 0 && glm::length(p + along * d) < unit;
  };
  std::uint64_t wrong = 0;
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 target = unit * glm::dvec3(random.between(-2, 2), -1, random.between(-2, 2));
    const glm::vec3 o(eye), d(glm::normalize(target - eye));
    const glm::vec3 p = naive::pointOnPlane(o, d, {0, 1, 0}, static_cast<float>(-unit), 1e-4f);
    wrong += (p.y < -unit || isShaded(glm::dvec3(p))) != isShaded(target);
  }
  return wrong;
}

void anyUnit(const Bench& bench, CaseResult& result) {
  for (const Method method : kRasterAndRays) {
    const Shot one = bench.draw(ballOnFloor(1, glm::dvec3(0)).scene, shadowed(method));
    Worst color;
    std::uint64_t moved = 0, naive = 0;
    for (const double unit : {1e-6, 1e-4, 1e-2, 1e2, 1e4, 1e6}) {
      const Shot other = bench.draw(ballOnFloor(unit, glm::dvec3(0)).scene, shadowed(method));
      compareColors(other.image, one.image, color);
      moved += differentObjects(other.image, one.image);
      naive += wrongByFixedOffset(unit);
      if (unit != 1e-6 && unit != 1e6) continue;
      result.show(fmt::format("{}: unit {:g}", techniqueOf(method), unit), other.image);
      result.show(fmt::format("{}: difference, 10,000 times", techniqueOf(method)),
                  differenceOf(other.image, one.image, 1e4f));
    }
    result.count(techniqueOf(method), "pixels that show another object in units of 1e-6 ... 1e6", moved,
                 6 * kWidth * kHeight, static_cast<double>(naive));
    result.measure(techniqueOf(method), "colors in these units against those of 1", color, 1e-3, "absolute");
  }
}

// A square that faces the camera, whose normals say otherwise.
Primitive squareWithNormal(const glm::vec3& normal, double size) {
  Primitive p;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    p.positions.emplace_back(glm::dvec3(x * size, y * size, 0));
  p.normals.assign(4, normal);
  p.indices = {0, 1, 2, 0, 2, 3};
  return p;
}

glm::dvec3 normalShown(const Bench& bench, Method method, const Primitive& square, const glm::dmat4& worldFromObject) {
  Stage stage;
  stage.add(lambert(1));
  stage.addMesh(square, worldFromObject);
  stage.scene.lights = {sunAlong({0, 0, -1})};
  RenderSettings s = settingsFor(method, 9, 9);
  s.aovs = {"normal"};
  return vectorAt(bench.draw(stage.scene, s).image, "normal", 40);
}

void stretchedNormals(const Bench& bench, CaseResult& result) {
  const glm::vec3 n = glm::normalize(glm::vec3(1, 1, 0.5f));
  for (const Method method : kRasterAndRays) {
    Worst worst;
    for (const glm::dvec3& scale : {glm::dvec3(1, 10, 1), glm::dvec3(1e-3, 1, 1), glm::dvec3(1, 1, 1e4)}) {
      const glm::dvec3 exact = glm::normalize(glm::dvec3(n) / scale), naive = glm::normalize(glm::dvec3(n) * scale);
      const glm::dvec3 got = normalShown(bench, method, squareWithNormal(n, 4), scaledAt(scale, {0, 0, -3}));
      worst.add(got.y, exact.y, glm::length(got - exact));
      worst.addNaive(glm::length(naive - exact));
    }
    result.measure(techniqueOf(method), "normals of a mesh stretched tenfold, thousandfold and 10,000-fold", worst,
                   4e-7, "absolute");
  }
}

void tinyTransforms(const Bench& bench, CaseResult& result) {
  const glm::vec3 n = glm::normalize(glm::vec3(1, 2, 3));
  for (const Method method : kRasterAndRays) {
    Worst worst;
    for (const double scale : {1e-15, 1e-12, 1e12, 1e15}) {
      const glm::dvec3 got =
          normalShown(bench, method, squareWithNormal(n, 4 / scale), scaledAt(glm::dvec3(scale), {0, 0, -3}));
      worst.add(got.z, n.z, glm::length(got - glm::dvec3(n)));
      // The inverse by the determinant, in single precision: it underflows, or overflows.
      const auto s = static_cast<float>(scale);
      const float determinant = s * s * s;
      const glm::vec3 naive = glm::normalize(glm::vec3(s * s / determinant) * n);
      worst.addNaive(glm::length(glm::dvec3(naive) - glm::dvec3(n)));
    }
    result.measure(techniqueOf(method), "normals of meshes scaled by 1e-15 ... 1e15", worst, 4e-7, "absolute");
  }
}

// Half a ball, so that left and right differ.
Stage wedge(double side) {
  Stage stage;
  Primitive p;
  p.positions = {{0, -1, 0}, {2, -1, -1}, {0, 1, 0.5f}, {-0.5f, -0.5f, -2}};
  p.normals = {{0, 0, 1}, {0.8f, 0, 0.6f}, {0, 0.8f, 0.6f}, {-0.6f, 0, 0.8f}};
  p.indices = {0, 1, 2, 0, 2, 3, 0, 3, 1};
  p.material = stage.add(shiny());
  glm::dmat4 at = scaledAt({side, 1, 1}, {0, 0, -4});
  stage.addMesh(p, at);
  stage.scene.lights = {lampAt({side * 2.0, 3, 0})};
  return stage;
}

// Unit normal of the first triangle by its corners after the transform, the winding taken as it comes.
glm::dvec3 crossOfFirst(double side) {
  const Scene scene = wedge(side).scene;
  const Primitive& p = scene.meshes[0].primitives[0];
  const glm::vec3 s(static_cast<float>(side), 1, 1);
  return glm::dvec3(
      glm::normalize(glm::cross(s * (p.positions[1] - p.positions[0]), s * (p.positions[2] - p.positions[0]))));
}

void mirroredMeshes(const Bench& bench, CaseResult& result) {
  for (const Method method : kRasterAndRays) {
    const Shot right = bench.draw(wedge(1).scene, shadowed(method)),
               left = bench.draw(wedge(-1).scene, shadowed(method));
    const Image back = mirrored(left.image);
    Worst color;
    std::uint64_t edges = 0, shown = 0;
    for (std::size_t i = 0; i < right.image.pixels(); ++i) {
      const auto x = static_cast<std::uint32_t>(i % kWidth), y = static_cast<std::uint32_t>(i / kWidth);
      const bool here = objectAt(right.image, i) == 0u,
                 there = objectAt(left.image, std::size_t{y} * kWidth + kWidth - 1 - x) == 0u;
      edges += here != there;
      shown += here;
      for (std::size_t c = 0; here && there && c < 3; ++c)
        color.addAbsolute(pixelAt(back, x, y)[c], pixelAt(right.image, x, y)[c]);
    }
    color.addNaive(glm::length(crossOfFirst(-1) - glm::dvec3(-1, 1, 1) * crossOfFirst(1)));
    result.measure(techniqueOf(method), "a mesh mirrored by its transform, in a mirrored picture", color, 1e-4,
                   "absolute");
    // The rule for pixels whose center lies on an edge has sides: at most the outline's own pixels.
    result.count(techniqueOf(method), "pixels of the outline that differ, beyond one in a hundred",
                 edges > shown / 100 ? edges : 0, shown);
    result.show(fmt::format("{}: as it is", techniqueOf(method)), right.image);
    result.show(fmt::format("{}: mirrored, and mirrored back", techniqueOf(method)), back);
    result.show(fmt::format("{}: difference, 10,000 times", techniqueOf(method)),
                differenceOf(back, right.image, 1e4f));
  }
}

}  // namespace

std::vector<HardCase> transformCases() {
  return {
      {"R12", "far from the origin", "10,000,000 units out, single-precision vertices are a unit apart: objects tear",
       "camera-relative in double: what is left is the rounding of the scene at the origin", true, farFromTheOrigin},
      {"M1", "stretched meshes", "normals that are transformed like positions lean the wrong way",
       "inverse transpose: some eight roundings", true, stretchedNormals},
      {"M2", "mirrored meshes", "a negative determinant turns triangles and normals inside out",
       "the picture mirrored back; vertices round differently: 1e-4", true, mirroredMeshes},
      {"M3", "meshes scaled almost to nothing",
       "the determinant of a scale of 1e-15 underflows: the inverse is infinite",
       "directions do not depend on uniform scale", true, tinyTransforms},
      {"M4", "any unit of length", "every hard-coded epsilon is wrong in some unit",
       "1e-3 as the catalog has it; powers of ten are not exact in binary", true, anyUnit},
  };
}

}  // namespace crosslight::study
