#include "upload/gpu_scene.h"

#include <utility>

#include "bindings.h"

namespace crosslight {

using namespace shared;

GpuScene::GpuScene(const gpu::Device& device, const Scene& scene, const RenderSettings& settings, FlatScene flat,
                   const FlatBvh* bvh)
    : scene_(scene), settings_(settings), flat_(std::move(flat)) {
  const glm::dvec3 origin = renderOrigin(scene.cameras[static_cast<std::size_t>(settings.camera)]);
  const MaterialRecords materials = makeMaterialRecords(scene);
  frame_ = gpu::Buffer(device, "frame constants", sizeof(FrameRecord), gpu::useUniform | gpu::useHostWrite);
  materials_ = gpu::Buffer::of(device, "materials", materials.materials, gpu::useStorage | gpu::useUniformTexel);
  lights_ = gpu::Buffer::of(device, "lights", makeLightRecords(scene, origin), gpu::useStorage | gpu::useUniformTexel);
  draws_ = gpu::Buffer::of(device, "draws", flat_.draws, gpu::useStorage | gpu::useUniformTexel);
  positions_ = gpu::Buffer::of(device, "positions", flat_.positions, gpu::useUniformTexel | gpu::useVertex);
  attributes_ = gpu::Buffer::of(device, "vertex attributes", flat_.attributes, gpu::useUniformTexel | gpu::useVertex);
  indices_ = gpu::Buffer::of(device, "indices", flat_.indices, gpu::useUniformTexel | gpu::useIndex);
  shapes_ = gpu::Buffer::of(device, "shapes", flat_.shapes, gpu::useStorage | gpu::useUniformTexel);
  texels_ = gpu::Buffer::of(device, "textures", materials.texels, gpu::useUniformTexel);
  const FlatBvh none;
  const FlatBvh& tree = bvh ? *bvh : none;
  shapeRoot_ = tree.shapeRoot;
  wideDepth_ = tree.wideDepth;
  quadWaiting_ = tree.quadWaiting;
  quadNodes_ = gpu::Buffer::of(device, "quantised BVH nodes", tree.quadNodes, gpu::useUniformTexel);
  nodes_ = gpu::Buffer::of(device, "BVH nodes", tree.nodes, gpu::useUniformTexel);
  wideNodes_ = gpu::Buffer::of(device, "wide BVH nodes", tree.wideNodes, gpu::useUniformTexel);
  primitives_ = gpu::Buffer::of(device, "BVH primitives", tree.primitives, gpu::useUniformTexel);
  instances_ = gpu::Buffer::of(device, "instances", tree.instances, gpu::useUniformTexel);
  instanceTriangles_ =
      gpu::Buffer::of(device, "triangles of shared trees", tree.instanceTriangles, gpu::useUniformTexel);
}

void GpuScene::setSample(const glm::vec2& sampleOffset) {
  FrameRecord frame = makeFrameRecord(scene_, settings_, sampleOffset);
  frame.unboundedShapeCount = flat_.unboundedShapeCount;
  frame.shapeRoot = shapeRoot_;
  frame.meshDrawCount = flat_.meshDrawCount;
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
                                     {kBindBvhNodes, texelBufferUint4},
                                     {kBindBvhPrimitives, texelBufferUint4},
                                     {kBindWideNodes, texelBufferUint4},
                                     {kBindQuadNodes, texelBufferUint4},
                                     {kBindInstances, texelBufferUint4},
                                     {kBindInstanceTriangles, texelBufferUint4},
                                     {kBindMaterialTexels, texelBufferUint4},
                                     {kBindLightTexels, texelBufferUint4},
                                     {kBindDrawTexels, texelBufferUint4},
                                     {kBindShapeTexels, texelBufferUint4}};
  for (const std::uint32_t slot : moreStorageSlots) bindings.push_back({slot, storageBuffer});
  for (const std::uint32_t slot : moreTexelSlots) bindings.push_back({slot, texelBufferUint4});
  return bindings;
}

gpu::Constants constantsOf(const Plan& plan, std::uint32_t variant) {
  return {{kSpecModels, plan.models},
          {kSpecLights, plan.lights},
          {kSpecShapes, plan.shapes},
          {kSpecEffects, plan.effects},
          {kSpecVariant, variant}};
}

}  // namespace crosslight
