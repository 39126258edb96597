// Cases of meshes and their attributes: normals that cancel, triangles without area, shared edges, coplanar doubles,
// texture coordinates that say nothing, flat normal maps.
#include <numbers>

#include "study/cases.h"
#include "study/pictures.h"

namespace crosslight::study {
namespace {

constexpr std::uint32_t kSize = 65;

RenderSettings withAovs(Method method) {
  RenderSettings s = settingsFor(method, kSize, kSize);
  s.aovs = {"instanceId", "normal", "geometricNormal"};
  return s;
}

Primitive square(double half, double z, int material) {
  Primitive p;
  const auto h = static_cast<float>(half), at = static_cast<float>(z);
  p.positions = {{-h, -h, at}, {h, -h, at}, {h, h, at}, {-h, h, at}};
  p.normals.assign(4, {0, 0, 1});
  p.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  p.indices = {0, 1, 2, 0, 2, 3};
  p.material = material;
  return p;
}

void cancelingNormals(const Bench& bench, CaseResult& result) {
  Stage stage;
  Primitive p = square(4, -2, stage.add(lambert(1)));
  p.normals = {{0, 0, 1}, {0, 0, -1}, {0, 0, -1}, {0, 0, 1}};  // in the middle column they cancel exactly
  stage.addMesh(p);
  stage.scene.lights = {sunAlong({0, 0.1, -1})};
  for (const Method method : kRasterAndRays) {
    const Shot shot = bench.draw(stage.scene, withAovs(method));
    Worst length;
    for (std::size_t i = 0; i < shot.image.pixels(); ++i)
      length.addAbsolute(glm::length(vectorAt(shot.image, "normal", i)), 1);
    const glm::vec3 middle = 0.5f * p.normals[0] + 0.5f * p.normals[1];
    length.addNaive(std::abs(static_cast<double>(glm::length(middle / glm::length(middle))) - 1));
    result.measure(techniqueOf(method), "length of normals between one and its opposite", length, 4 * kUlp, "absolute");
    result.count(techniqueOf(method), "values that are not finite", shot.nonfinite, shot.image.pixels());
  }
}

// A square of two triangles, and others that have no area, among them one that is as long as the picture.
void degenerateTriangles(const Bench& bench, CaseResult& result) {
  const auto staged = [](bool degenerate) {
    Stage stage;
    Primitive p = square(0.5, -2, stage.add(lambert(1)));
    p.positions.insert(p.positions.end(), {{-4, 0, -2}, {0, 0, -2}, {4, 0, -2}, {-4, 1e-7f, -2}, {4, 1, -2}});
    p.normals.assign(p.positions.size(), {0, 0, 1});
    p.uv0.clear();
    if (degenerate) p.indices.insert(p.indices.end(), {4, 5, 6, 0, 0, 2, 7, 7, 7, 4, 6, 4, 8, 6, 8});
    stage.addMesh(p);
    stage.scene.lights = {sunAlong({0, 0, -1})};
    return stage;
  };
  const glm::vec3 naive = glm::cross(glm::vec3(4, 0, 0), glm::vec3(8, 0, 0));
  for (const Method method : kRasterAndRays) {
    const Shot with = bench.draw(staged(true).scene, withAovs(method)),
               without = bench.draw(staged(false).scene, withAovs(method));
    Worst color;
    compareColors(with.image, without.image, color);
    const double unit = static_cast<double>(naive.z / glm::length(naive));
    color.addNaive(std::abs(unit));  // light by a normal of 0 / 0
    result.measure(techniqueOf(method), "a mesh with triangles that have no area against one without", color, 0,
                   "absolute");
    result.count(techniqueOf(method), "values that are not finite", with.nonfinite, with.image.pixels());
  }
}

// A fan of slivers about a point beside every pixel's center, half transparent: each pixel must see one of them.
void sharedEdges(const Bench& bench, CaseResult& result) {
  constexpr int kSlivers = 300;
  Stage stage;
  Material m = emitter(1);
  m.classic.transparency = 0.5f;
  m.doubleSided = true;
  Primitive p;
  p.positions = {{0.1234567f, -0.0712345f, -2}};
  for (int i = 0; i < kSlivers; ++i) {
    const double phi = 2 * std::numbers::pi * i / kSlivers;
    p.positions.emplace_back(glm::dvec3(6 * std::cos(phi), 6 * std::sin(phi), -2 - 0.5 * std::cos(5 * phi)));
    p.indices.insert(p.indices.end(),
                     {0u, 1u + static_cast<unsigned>(i), 1u + static_cast<unsigned>((i + 1) % kSlivers)});
  }
  p.normals.assign(p.positions.size(), {0, 0, 1});
  p.material = stage.add(m);
  stage.addMesh(p);
  const float once = 0.5f;
  for (const Method method : kRasterAndRays) {
    RenderSettings s = settingsFor(method, 128, 128);
    const Shot shot = bench.draw(stage.scene, s);
    std::uint64_t missed = 0, twice = 0;
    for (std::size_t i = 0; i < shot.image.pixels(); ++i) {
      const float value = shot.image.picture().samples[4 * i];
      missed += value < once;
      twice += value > once;
    }
    result.count(techniqueOf(method), "pixels that fall between 300 slivers", missed, shot.image.pixels());
    result.count(techniqueOf(method), "pixels that see two of them", twice, shot.image.pixels());
    if (missed + twice > 0) result.show("each pixel once: even gray", shot.image);
  }
}

void coplanarDoubles(const Bench& bench, CaseResult& result) {
  Stage stage;
  const int first = stage.add(emitter(1)), second = stage.add(emitter(0.25f));
  Primitive turned = square(4, -2, second);
  turned.indices = {1, 2, 3, 1, 3, 0};  // the other diagonal: other rounding of the same depth
  stage.addMesh(square(4, -2, first));
  stage.addMesh(turned);
  for (const Method method : kRasterAndRays) {
    std::uint64_t other = 0, compared = 0;
    std::optional<Shot> before;
    for (const KernelFamily kernel : {KernelFamily::automatic, KernelFamily::perLane}) {
      RenderSettings s = withAovs(method);
      s.kernel = kernel;
      Shot shot = bench.draw(stage.scene, s);
      if (before) {
        other += differentObjects(shot.image, before->image);
        compared += shot.image.pixels();
      }
      before = std::move(shot);
    }
    result.count(techniqueOf(method), "pixels of two squares in one plane that depend on how the scene is walked",
                 other, compared);
  }
}

Stage mapped(bool withMap, std::vector<glm::vec2> uv) {
  Stage stage;
  Material m = lambert(1);
  if (withMap) {
    m.normalTexture.image = 0;
    stage.scene.images.push_back({"flat", 1, 1, {128 / 255.0f, 128 / 255.0f, 1.0f, 1.0f}});
  }
  Primitive p = square(4, -2, stage.add(m));
  p.uv0 = std::move(uv);
  p.tangents.assign(4, {1, 0, 0, 1});
  stage.addMesh(p);
  stage.scene.lights = {sunAlong({1, 0, -1})};
  return stage;
}

void flatNormalMaps(const Bench& bench, CaseResult& result) {
  const std::vector<glm::vec2> uv{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const Method method : kRasterAndRays) {
    const Shot with = bench.draw(mapped(true, uv).scene, withAovs(method)),
               without = bench.draw(mapped(false, uv).scene, withAovs(method));
    Worst tilt;
    const glm::dvec3 naive = glm::normalize(glm::dvec3(128, 128, 255) / 255.0 * 2.0 - 1.0);
    for (std::size_t i = 0; i < with.image.pixels(); ++i) {
      const glm::dvec3 a = vectorAt(with.image, "normal", i), b = vectorAt(without.image, "normal", i);
      tilt.add(a.x, b.x, glm::length(a - b));
    }
    tilt.addNaive(glm::length(naive - glm::dvec3(0, 0, 1)));
    result.measure(techniqueOf(method), "tilt of a surface by a map of 8-bit 128s", tilt, 4 * kUlp, "radians");
  }
}

void emptyTexturePlane(const Bench& bench, CaseResult& result) {
  const std::vector<glm::vec2> same(4, glm::vec2(0.5f)), line{{0, 0}, {0.5f, 0.5f}, {1, 1}, {0.25f, 0.25f}};
  const glm::vec2 e1 = same[1] - same[0], e2 = same[2] - same[0];
  const float inverse = 1 / (e1.x * e2.y - e1.y * e2.x);
  for (const Method method : kRasterAndRays) {
    std::uint64_t nonfinite = 0, compared = 0;
    Worst length;
    for (const auto& uv : {same, line}) {
      Stage stage = mapped(true, uv);
      stage.scene.meshes[0].primitives[0].tangents.clear();  // to be made of texture coordinates that span nothing
      const Shot shot = bench.draw(stage.scene, withAovs(method));
      nonfinite += shot.nonfinite;
      compared += shot.image.pixels();
      for (std::size_t i = 0; i < shot.image.pixels(); ++i)
        length.addAbsolute(glm::length(vectorAt(shot.image, "normal", i)), 1);
    }
    length.addNaive(std::abs(static_cast<double>(inverse * e2.y)));
    result.measure(techniqueOf(method), "length of mapped normals where texture coordinates span no plane", length,
                   1e-6, "absolute");
    result.count(techniqueOf(method), "values that are not finite", nonfinite, compared);
  }
}

}  // namespace

std::vector<HardCase> surfaceCases() {
  return {
      {"R5", "shared edges of slivers", "pixels between triangles are missed, or counted twice",
       "Vulkan: each sample of a "
       "shared edge belongs to one of them; each ray leaves a sheet once",
       true, sharedEdges, nullptr, "a rasterizer's rule for shared edges is the device's; rays: see T8"},
      {"R7", "triangles without area", "their normal is 0 / 0", "they cover nothing: the same bits", true,
       degenerateTriangles},
      {"R18", "normals that cancel", "half way between a normal and its opposite lies 0 / 0",
       "two ulp of inversesqrt, "
       "and the products",
       true, cancelingNormals},
      {"T12", "two surfaces in one plane", "which is seen is a matter of the order in which a tree is walked",
       "the lowest id: the same picture", true, coplanarDoubles, nullptr,
       "the order of a walk is no formula; tests draw it by all kernel families"},
      {"X1", "texture coordinates that span nothing", "1 / 0 in the tangent, NaN in every normal", "unit to 1e-6", true,
       emptyTexturePlane},
      {"X3", "flat normal maps", "8-bit 128 decoded as 2 b / 255 - 1 tilts a flat surface by a third of a degree",
       "(128 - 128) / 127 is 0; the normal's own roundings", true, flatNormalMaps},
  };
}

}  // namespace crosslight::study
