// The way from a file to a Scene, step by step, and the last net under it: whatever a library throws becomes an
// InputError with the file's name.
#include <tiny_gltf.h>

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <new>

#include "base/error.h"
#include "base/log.h"
#include "scene/gltf_build.h"
#include "scene/load.h"
#include "scene/shape_mesh.h"

namespace crosslight {
namespace {

using namespace gltf;

// Index of the entry with this name or number; UsageError lists what there is.
template <class Entry>
int chooseNamed(const std::vector<Entry>& entries, const char* what, const std::string& wanted,
                const Document& document) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].name == wanted) return static_cast<int>(i);
  }
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  const bool isNumber = error == std::errc() && end == wanted.data() + wanted.size();
  if (isNumber && index < entries.size()) return static_cast<int>(index);
  std::string known;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    known += fmt::format("{}{} '{}'", i == 0 ? "" : ", ", i, entries[i].name);
  }
  throw UsageError(
      fmt::format("there is no {} '{}'; {} has {}", what, wanted, document.fileName, known.empty() ? "none" : known));
}

// -1: the file has no scenes, all its nodes are drawn.
int chooseScene(const tinygltf::Model& model, const Document& document, const std::string& wanted) {
  if (!wanted.empty()) return chooseNamed(model.scenes, "scene", wanted, document);
  if (model.scenes.empty()) {
    logInfo(document.fileName + ": has no scene, all its nodes are drawn");
    return -1;
  }
  return model.defaultScene >= 0 ? model.defaultScene : 0;
}

// Above this many vertices times instances the corners of the meshes' boxes stand for their vertices.
constexpr std::uint64_t kExactBoundsWork = 50'000'000;

void addTransformed(DBounds& bounds, const DBounds& box, const glm::dmat4& worldFromObject) {
  if (box.empty()) return;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 p(corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                       corner & 4 ? box.upper.z : box.lower.z, 1.0);
    bounds.add(glm::dvec3(worldFromObject * p));
  }
}

DBounds boundsOf(const Mesh& mesh) {
  DBounds bounds;
  for (const Primitive& primitive : mesh.primitives) {
    for (const std::uint32_t index : primitive.indices) bounds.add(glm::dvec3(primitive.positions[index]));
  }
  return bounds;
}

void fillBoundsAndCounts(Scene& scene) {
  std::vector<DBounds> boxes;
  std::vector<std::uint64_t> triangles(scene.meshes.size(), 0);
  std::vector<std::uint64_t> vertices(scene.meshes.size(), 0);
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    boxes.push_back(boundsOf(scene.meshes[m]));
    for (const Primitive& primitive : scene.meshes[m].primitives) {
      triangles[m] += primitive.indices.size() / 3;
      vertices[m] += primitive.positions.size();
    }
  }
  std::uint64_t corners = 0;
  for (const MeshInstance& instance : scene.instances) {
    const auto mesh = static_cast<std::size_t>(instance.mesh);
    scene.stats.triangles += triangles[mesh];
    scene.stats.vertices += vertices[mesh];
    corners += triangles[mesh] * 3;
  }
  for (const MeshInstance& instance : scene.instances) {
    const auto mesh = static_cast<std::size_t>(instance.mesh);
    if (corners > kExactBoundsWork) {
      addTransformed(scene.worldBounds, boxes[mesh], instance.worldFromObject);
      continue;
    }
    for (const Primitive& primitive : scene.meshes[mesh].primitives) {
      for (const std::uint32_t index : primitive.indices) {
        const glm::dvec4 p(glm::dvec3(primitive.positions[index]), 1.0);
        scene.worldBounds.add(glm::dvec3(instance.worldFromObject * p));
      }
    }
  }
  for (const ShapeInstance& shape : scene.shapes) {
    if (const auto box = shapeBounds(shape.kind, shape.params))
      addTransformed(scene.worldBounds, *box, shape.worldFromObject);
  }
}

void checkExtent(const Scene& scene, const Document& document) {
  if (scene.worldBounds.empty()) return;
  for (int axis = 0; axis < 3; ++axis) {
    const double largest = std::max(std::abs(scene.worldBounds.lower[axis]), std::abs(scene.worldBounds.upper[axis]));
    if (!(largest <= kLargestCoordinate)) {
      document.root().fail(
          fmt::format("the scene reaches out to {:g}, the limit is {:g}", largest, kLargestCoordinate));
    }
  }
}

// A primitive or shape without a material refers to one behind the file's last.
void addDefaultMaterial(Scene& scene) {
  const int needed = static_cast<int>(scene.materials.size());
  bool used = false;
  for (const Mesh& mesh : scene.meshes) {
    for (const Primitive& primitive : mesh.primitives) used |= primitive.material == needed;
  }
  for (const ShapeInstance& shape : scene.shapes) used |= shape.material == needed;
  if (!used) return;
  scene.materials.emplace_back();
  scene.materials.back().name = "default";
}

void addDefaults(Scene& scene, const Document& document) {
  addDefaultMaterial(scene);
  if (scene.cameras.empty()) {
    scene.cameras.push_back(frameBounds(scene.worldBounds));
    scene.defaultCamera = true;
    logVerbose(document.fileName + ": has no camera, one frames the scene's bounds");
  }
  if (scene.lights.empty() && scene.atmosphere.environment.file.empty()) {
    scene.lights.push_back(headlight(scene.cameras[0]));
    scene.defaultLight = true;
    logInfo(document.fileName + ": has no light, a headlight of pi lux shines along the view of camera 0 '" +
            scene.cameras[0].name + "'");
  }
}

void fillStats(const tinygltf::Model& model, const Document& document, Scene& scene) {
  scene.stats.fileBytes = document.fileBytes;
  scene.stats.contentHash = document.hashContents ? document.contentHash : 0;
  scene.stats.animations = static_cast<std::uint32_t>(model.animations.size());
  scene.stats.extensionsUsed = model.extensionsUsed;
  for (const tinygltf::Scene& entry : model.scenes) scene.stats.sceneNames.push_back(entry.name);
}

// Runs a step on behalf of a file: whatever a library throws becomes an InputError with the file's name.
template <class Step>
auto guarded(const std::filesystem::path& file, const Step& step) {
  try {
    return step();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw InputError(file.string(), "needs more memory than there is");
  } catch (const std::length_error&) {
    throw InputError(file.string(), "needs more memory than there can be");
  } catch (const std::exception& error) {
    throw InputError(file.string(), std::string("cannot be read: ") + error.what());
  }
}

}  // namespace

struct SceneFile::Impl {
  Impl(const std::filesystem::path& path, const LoadOptions& loadOptions);
  Scene pose(Scene scene, double timeSeconds);

  std::filesystem::path file;
  LoadOptions options;
  Document document;
  ModelPointer model;
  int sceneIndex = -1, animation = -1;
  Scene still;  // what no pose changes: materials and their images
};

SceneFile::Impl::Impl(const std::filesystem::path& path, const LoadOptions& loadOptions)
    : file(path), options(loadOptions), document(path, loadOptions) {
  validateDocument(document);
  loadResources(document);
  decodeMeshopt(document);
  decodeDraco(document);
  model = parseModel(document);
  still.source = file;
  sceneIndex = chooseScene(*model, document, options.scene);
  if (!options.animation.empty()) animation = chooseNamed(model->animations, "animation", options.animation, document);
  buildMaterials({document, *model}, still);
}

Scene SceneFile::Impl::pose(Scene scene, double timeSeconds) {
  if (!std::isfinite(timeSeconds)) throw UsageError("the time of an animation must be a finite number of seconds");
  const Source source{document, *model};
  std::vector<NodePose> poses = restPose(source);
  if (options.animate) animate(source, animation, timeSeconds, poses);
  buildNodes(source, poses, sceneIndex, scene);
  if (sceneIndex >= 0) {
    const auto index = static_cast<std::size_t>(sceneIndex);
    scene.name = model->scenes[index].name;
    const auto atmosphere = document.entry("scenes", index).extension("CROSSLIGHT_scene_atmosphere");
    if (atmosphere) scene.atmosphere = readAtmosphere(source, *atmosphere, document);
  }
  fillStats(*model, document, scene);
  fillBoundsAndCounts(scene);
  checkExtent(scene, document);
  document.notes.log();
  addDefaults(scene, document);
  if (displaceMeshes(scene, options.displacement)) {
    scene.stats.triangles = scene.stats.vertices = 0;
    scene.worldBounds = {};
    fillBoundsAndCounts(scene);
    checkExtent(scene, document);
  }
  return scene;
}

SceneFile::SceneFile(const std::filesystem::path& file, const LoadOptions& options)
    : impl_(guarded(file, [&] { return std::make_unique<Impl>(file, options); })) {}
SceneFile::SceneFile(SceneFile&&) noexcept = default;
SceneFile::~SceneFile() = default;

Scene SceneFile::pose(double timeSeconds) const {
  // The budget bounds one scene: what an earlier pose took is given back with that scene.
  const Budget before = impl_->document.budget;
  Scene scene = guarded(impl_->file, [&] { return impl_->pose(impl_->still, timeSeconds); });
  impl_->document.budget = before;
  return scene;
}

Scene loadScene(const std::filesystem::path& file, const LoadOptions& options) {
  if (!std::isfinite(options.timeSeconds))
    throw UsageError("the time of an animation must be a finite number of seconds");
  const SceneFile opened(file, options);
  return guarded(file, [&] { return opened.impl_->pose(std::move(opened.impl_->still), options.timeSeconds); });
}

}  // namespace crosslight
