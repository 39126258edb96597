#include "upload/gpu_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "base/error.h"
#include "bindings.h"
#include "effects/material_traits.h"
#include "effects/media.h"
#include "upload/albedo_tables.h"
#include "upload/environment_tables.h"

namespace crosslight {

using namespace shared;

namespace {

// In fours, the last of which are filled up with boxes that nothing enters.
std::vector<glm::vec4> boxTexels(const std::vector<Bounds>& boxes) {
  constexpr float kFar = std::numeric_limits<float>::max();
  std::vector<glm::vec4> texels;
  for (const Bounds& box : boxes) {
    texels.emplace_back(box.lower, 0.0f);
    texels.emplace_back(box.upper, 0.0f);
  }
  while (texels.size() % 8 != 0) texels.emplace_back(texels.size() % 2 == 0 ? kFar : -kFar);
  return texels;
}

// Four to a texel; at least one.
std::vector<glm::vec4> densityTexels(const Smoke& smoke) {
  std::vector<glm::vec4> texels(smoke.densities.size() / 4 + 1, glm::vec4(0.0f));
  for (std::size_t i = 0; i < smoke.densities.size(); ++i)
    texels[i / 4][static_cast<glm::length_t>(i % 4)] = smoke.densities[i];
  return texels;
}

// Once per process: frames share it.
const std::vector<glm::vec4>& albedoTables() {
  static const std::vector<glm::vec4> tables = makeAlbedoTables(kAlbedoTableSize);
  return tables;
}

}  // namespace

GpuScene::GpuScene(const gpu::Device& device, const Scene& scene, const RenderSettings& settings, FlatScene flat,
                   const FlatBvh* bvh)
    : GpuScene(device, scene, settings, std::move(flat), bvh ? *bvh : FlatBvh{}, true) {}

std::unique_ptr<GpuScene> GpuScene::forRays(const gpu::Device& device, const Scene& scene,
                                            const RenderSettings& settings, FlatScene flat, FlatBvh bvh) {
  return std::unique_ptr<GpuScene>(
      new GpuScene(device, scene, settings, std::move(flat), std::move(bvh), /*keepsLists=*/false));
}

GpuScene::GpuScene(const gpu::Device& device, const Scene& scene, const RenderSettings& settings, FlatScene flat,
                   FlatBvh tree, bool keepsLists)
    : scene_(scene),
      settings_(settings),
      flat_(std::move(flat)),
      shapeRoot_(tree.shapeRoot),
      wideDepth_(tree.wideDepth),
      quadWaiting_(tree.quadWaiting) {
  const auto moved = [&]<class T>(const char* name, std::vector<T>& list, std::uint32_t use) {
    gpu::Buffer buffer = gpu::Buffer::of(device, name, list, use);
    if (!keepsLists) std::vector<T>().swap(list);
    return buffer;
  };
  constexpr std::uint32_t kRecords = gpu::useStorage | gpu::useUniformTexel;
  frame_ = gpu::Buffer(device, "frame constants", sizeof(FrameRecord), gpu::useUniform | gpu::useHostWrite);
  lights_ = gpu::Buffer::of(device, "lights", makeLightRecords(scene, flat_.origin), kRecords);
  draws_ = gpu::Buffer::of(device, "draws", flat_.draws, kRecords);
  shapes_ = gpu::Buffer::of(device, "shapes", flat_.shapes, kRecords);
  shapeBoxes_ = gpu::Buffer::of(device, "boxes of shapes", boxTexels(flat_.shapeBounds), gpu::useUniformTexel);
  {
    const MaterialRecords materials = makeMaterialRecords(scene);
    materials_ = gpu::Buffer::of(device, "materials", materials.materials, kRecords);
    texels_ = gpu::Buffer::of(device, "textures", materials.texels, gpu::useUniformTexel);
  }
  {
    const Environment& around = scene.atmosphere.environment;
    const std::vector<glm::vec4> none{glm::vec4(0.0f)};
    environment_ = gpu::Buffer::of(device, "environment", around.present() ? environmentTexels(*around.map) : none,
                                   gpu::useUniformTexel);
  }
  const Environment& shines = scene.atmosphere.environment;
  const bool scattered = hasSmoke(scene.atmosphere.smoke) || anyScatters(scene);
  if (shines.present() && scattered) environmentMean_ = meanRadiance(*shines.map);
  smokeGrid_ =
      gpu::Buffer::of(device, "densities of smoke", densityTexels(scene.atmosphere.smoke), gpu::useUniformTexel);
  albedoTables_ = gpu::Buffer::of(device, "albedo tables",
                                  needsAlbedoTables(scene, settings) ? albedoTables() : std::vector<glm::vec4>(1),
                                  gpu::useUniformTexel);
  positions_ = moved("positions", flat_.positions, gpu::useUniformTexel | gpu::useVertex);
  attributes_ = moved("vertex attributes", flat_.attributes, gpu::useUniformTexel | gpu::useVertex);
  indices_ = moved("indices", flat_.indices, gpu::useUniformTexel | gpu::useIndex);
  wideNodes_ = moved("wide BVH nodes", tree.wideNodes, gpu::useUniformTexel);
  primitives_ = moved("BVH primitives", tree.primitives, gpu::useUniformTexel);
  nodes_ = moved("BVH nodes", tree.nodes, gpu::useUniformTexel);
  quadNodes_ = moved("quantised BVH nodes", tree.quadNodes, gpu::useUniformTexel);
  instances_ = moved("instances", tree.instances, gpu::useUniformTexel);
  instanceTriangles_ = moved("triangles of shared trees", tree.instanceTriangles, gpu::useUniformTexel);
  if (tree.deviceBoxes) {
    const auto count = static_cast<std::uint32_t>(tree.deviceBoxes->size());
    const gpu::Buffer boxes = moved("boxes of triangles", *tree.deviceBoxes, gpu::useBoxes);
    triangleBoxes_ = gpu::BoxSearch(device, "search of triangles", boxes, count);
  }
}

// Once for all samples of a picture: the bodies around the camera are looked for triangle by triangle.
void GpuScene::placeCamera() {
  if (placedFor_ == settings_) return;
  placedFor_ = settings_;
  cameraMedia_ = glm::uvec4(0);
  cameraMedium_ = kNoId;
  optics_ = 0;
  if (settings_.dispersion == Dispersion::rgb) optics_ |= kOpticsDispersion;
  if (settings_.coloredShadows) optics_ |= kOpticsColoredShadows;
  if (reasonForNestedMedia(scene_, settings_).empty()) return;
  optics_ |= kOpticsNestedMedia;
  constexpr std::size_t kMostMaterials = 0xffff;  // sixteen bits, with none
  if (scene_.materials.size() >= kMostMaterials) {
    throw InputError(scene_.source.string() + ": /materials",
                     fmt::format("bodies within bodies need fewer than {} materials, there are {}: leave out "
                                 "CROSSLIGHT_materials_dielectric, or refraction (--set refraction=off)",
                                 kMostMaterials, scene_.materials.size()));
  }
  const std::vector<int> media = cameraMedia(scene_, settings_);
  int highest = std::numeric_limits<int>::min();
  for (std::size_t i = 0; i < std::min<std::size_t>(media.size(), kMostMedia); ++i) {
    const int priority = scene_.materials[static_cast<std::size_t>(media[i])].priority.value_or(0);
    const auto place = static_cast<glm::length_t>(i / 2);
    cameraMedia_[place] |= (static_cast<std::uint32_t>(media[i]) + 1) << (16 * (i % 2));
    if (priority >= highest) cameraMedium_ = static_cast<std::uint32_t>(media[i]);
    highest = std::max(highest, priority);
  }
}

void GpuScene::setSample(const glm::vec2& sampleOffset, std::uint32_t sampleIndex) {
  placeCamera();
  FrameRecord frame = makeFrameRecord(scene_, settings_, sampleOffset);
  frame.sampleIndex = sampleIndex;
  frame.unboundedShapeCount = flat_.unboundedShapeCount;
  frame.boundedShapeCount = static_cast<std::uint32_t>(flat_.shapeBounds.size());
  frame.shapeRoot = shapeRoot_;
  frame.meshDrawCount = flat_.meshDrawCount;
  frame.cameraMedia = cameraMedia_;
  frame.cameraMedium = cameraMedium_;
  frame.optics = optics_;
  frame.smokeAround = frame.ambient + frame.environmentGain * environmentMean_;
  frame_.write(0, std::as_bytes(std::span(&frame, 1)));
}

void GpuScene::bind(gpu::BindingSet& set) const {
  set.set(kBindFrame, frame_);
  set.set(kBindMaterials, materials_);
  set.set(kBindLights, lights_);
  set.set(kBindDraws, draws_);
  set.set(kBindPositions, positions_);
  set.set(kBindAttributes, attributes_);
  set.set(kBindIndices, indices_);
  set.set(kBindShapes, shapes_);
  set.set(kBindTexels, texels_);
  set.set(kBindAlbedoTables, albedoTables_);
  set.set(kBindBvhNodes, nodes_);
  set.set(kBindBvhPrimitives, primitives_);
  set.set(kBindWideNodes, wideNodes_);
  set.set(kBindQuadNodes, quadNodes_);
  set.set(kBindInstances, instances_);
  set.set(kBindInstanceTriangles, instanceTriangles_);
  set.set(kBindMaterialTexels, materials_);
  set.set(kBindLightTexels, lights_);
  set.set(kBindDrawTexels, draws_);
  set.set(kBindShapeTexels, shapes_);
  set.set(kBindShapeBoxes, shapeBoxes_);
  if (triangleBoxes_) set.set(kBindTriangleBoxes, triangleBoxes_);
  set.set(kBindEnvironment, environment_);
  set.set(kBindSmokeGrid, smokeGrid_);
}

std::vector<gpu::Binding> sceneBindings(std::initializer_list<std::uint32_t> moreStorageSlots,
                                        std::initializer_list<std::uint32_t> moreTexelSlots) {
  using enum gpu::BindingType;
  std::vector<gpu::Binding> bindings{{kBindFrame, uniformBuffer},
                                     {kBindMaterials, storageBuffer},
                                     {kBindLights, storageBuffer},
                                     {kBindDraws, storageBuffer},
                                     {kBindPositions, texelBufferUint4},
                                     {kBindAttributes, texelBufferFloat4},
                                     {kBindIndices, texelBufferUint4},
                                     {kBindShapes, storageBuffer},
                                     {kBindTexels, texelBufferFloat4},
                                     {kBindAlbedoTables, texelBufferFloat4},
                                     {kBindBvhNodes, texelBufferUint4},
                                     {kBindBvhPrimitives, texelBufferUint4},
                                     {kBindWideNodes, texelBufferUint4},
                                     {kBindQuadNodes, texelBufferUint4},
                                     {kBindInstances, texelBufferUint4},
                                     {kBindInstanceTriangles, texelBufferUint4},
                                     {kBindMaterialTexels, texelBufferUint4},
                                     {kBindLightTexels, texelBufferUint4},
                                     {kBindDrawTexels, texelBufferUint4},
                                     {kBindShapeTexels, texelBufferUint4},
                                     {kBindShapeBoxes, texelBufferUint4},
                                     {kBindEnvironment, texelBufferFloat4},
                                     {kBindSmokeGrid, texelBufferFloat4}};
  for (const std::uint32_t slot : moreStorageSlots) bindings.push_back({slot, storageBuffer});
  for (const std::uint32_t slot : moreTexelSlots) bindings.push_back({slot, texelBufferUint4});
  return bindings;
}

gpu::Constants constantsOf(const Plan& plan, std::uint32_t variant) {
  return {{kSpecModels, plan.models},
          {kSpecLights, plan.lights},
          {kSpecShapes, plan.shapes},
          {kSpecEffects, static_cast<std::uint32_t>(plan.effects)},
          {kSpecMoreEffects, static_cast<std::uint32_t>(plan.effects >> 32)},
          {kSpecVariant, variant}};
}

}  // namespace crosslight
