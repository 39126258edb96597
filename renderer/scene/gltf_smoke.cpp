// CROSSLIGHT_scene_atmosphere's `smoke`: what scenes/schema/CROSSLIGHT_scene_atmosphere.schema.json says, in code.
#include <fmt/format.h>

#include "scene/gltf_build.h"

namespace crosslight::gltf {
namespace {

// Cells along an axis: a cube of them is 512 MiB.
constexpr std::int64_t kMostCells = 512;
// Beyond it the peak of Henyey's and Greenstein's function is narrower than a float's cosine tells.
constexpr double kMostAnisotropy = 0.99;

SmokeShape shapeOf(const std::string& name) {
  if (name == "everywhere") return SmokeShape::everywhere;
  return name == "box" ? SmokeShape::box : SmokeShape::sphere;
}

void readGrid(const Source& source, const JsonAt& grid, Smoke& smoke) {
  grid.onlyKnows({"cellsX", "cellsY", "cellsZ", "densities"});
  const char* const keys[3] = {"cellsX", "cellsY", "cellsZ"};
  std::size_t cells = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t count = grid.at(keys[axis]).integer(1, kMostCells);
    smoke.grid[axis] = static_cast<std::uint32_t>(count);
    cells *= static_cast<std::size_t>(count);
  }
  const JsonAt densities = grid.at("densities");
  const std::size_t accessor = densities.reference(source.document.count("accessors"), "accessor");
  const JsonAt at = source.document.entry("accessors", accessor);
  if (at.at("type").string() != "SCALAR") densities.fail("must be an accessor of SCALAR, one density per cell");
  if (static_cast<std::size_t>(at.at("count").integer()) != cells) {
    densities.fail(fmt::format("has {} densities, and the grid {} cells: {} x {} x {}", at.at("count").integer(), cells,
                               smoke.grid[0], smoke.grid[1], smoke.grid[2]));
  }
  source.document.budget.charge(cells * sizeof(float), grid);
  smoke.densities = readFinite(source, accessor, 1);
  for (const float density : smoke.densities) {
    if (density < 0.0f) densities.fail(fmt::format("holds a density of {:g}; densities are 0 or more", density));
  }
}

}  // namespace

Smoke readSmoke(const Source& source, const JsonAt& extension) {
  extension.onlyKnows({"shape", "center", "size", "radius", "absorption", "scattering", "anisotropy", "grid"});
  Smoke smoke;
  smoke.shape = shapeOf(extension.at("shape").oneOf({"everywhere", "box", "sphere"}));
  smoke.center = glm::dvec3(vec3Or(extension, "center", glm::vec3(0.0f)));
  smoke.size = glm::dvec3(vec3Or(extension, "size", glm::vec3(1.0f), Range::above(0.0)));
  smoke.radius = numberOr(extension, "radius", 1.0, Range::above(0.0));
  smoke.absorption = vec3Or(extension, "absorption", glm::vec3(0.0f), Range::atLeast(0.0));
  smoke.scattering = vec3Or(extension, "scattering", glm::vec3(0.0f), Range::atLeast(0.0));
  smoke.anisotropy =
      static_cast<float>(numberOr(extension, "anisotropy", 0.0, Range::between(-kMostAnisotropy, kMostAnisotropy)));
  if (const auto grid = extension.find("grid")) {
    if (smoke.shape != SmokeShape::box) grid->fail("needs the shape box: the grid's cells fill it");
    readGrid(source, *grid, smoke);
  }
  return smoke;
}

}  // namespace crosslight::gltf
