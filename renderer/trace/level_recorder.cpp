#include "trace/level_recorder.h"

namespace crosslight {

using namespace shared;

namespace {

std::vector<gpu::Binding> recorderBindings() {
  return sceneBindings({kBindVisibility, kBindRayTree, kBindRayTreeLights},
                       {kBindRayTexels, kBindHitTexels, kBindNodeTexels});
}

template <class Record>
gpu::Buffer listOf(const gpu::Device& device, const char* name, std::uint64_t count) {
  return {device, name, count * sizeof(Record), gpu::useStorage | gpu::useReadback};
}

}  // namespace

LevelRecorder::LevelRecorder(const gpu::Device& device, const KernelPipelines& kernels, const GpuScene& scene,
                             std::uint32_t nodeCapacity)
    : nodeCapacity_(nodeCapacity),
      layout_(device, recorderBindings(), sizeof(TracePush)),
      set_(device, layout_),
      pipeline_(device, layout_, gpu::embeddedShader("ray_tree.comp"), kernels.constants()),
      records_(listOf<RayTreeRecord>(device, "ray tree records", nodeCapacity)),
      lights_(listOf<RayTreeLightRecord>(device, "ray tree lights",
                                         std::uint64_t{nodeCapacity} * std::max(scene.lightCount(), 1u))) {
  scene.bind(set_);
  set_.set(kBindRayTree, records_);
  set_.set(kBindRayTreeLights, lights_);
}

void LevelRecorder::bind(const RayStore& store) {
  set_.set(kBindRayTexels, store.rays);
  set_.set(kBindHitTexels, store.hits);
  set_.set(kBindNodeTexels, store.nodes);
  set_.set(kBindVisibility, store.visibility);
}

void LevelRecorder::record(gpu::Commands& commands, const TracePush& push) {
  commands.bind(pipeline_, set_);
  commands.push(push);
  commands.dispatch((push.nodeCount + kRaysPerGroup - 1) / kRaysPerGroup);
  commands.barrier();
}

std::vector<RayTreeLightRecord> LevelRecorder::lights(std::uint32_t light) const {
  std::vector<RayTreeLightRecord> of(nodeCapacity_);
  lights_.read(std::uint64_t{light} * nodeCapacity_ * sizeof(RayTreeLightRecord),
               std::as_writable_bytes(std::span(of)));
  return of;
}

}  // namespace crosslight
