// Keeps what the tracer's levels hold before the next chunk writes over it, for whoever shows single ray trees.
#pragma once

#include <vector>

#include "gpu/commands.h"
#include "gpu/pipeline.h"
#include "ray_tree_records.h"
#include "trace/kernels.h"
#include "trace/ray_store.h"
#include "trace/ray_tree.h"
#include "upload/gpu_scene.h"

namespace crosslight {

class LevelRecorder {
 public:
  LevelRecorder(const gpu::Device& device, const KernelPipelines& kernels, const GpuScene& scene,
                std::uint32_t nodeCapacity);
  void bind(const RayStore& store);  // before the first level
  // After a batch of lights of a level is shaded.
  void record(gpu::Commands& commands, const shared::TracePush& push);
  std::vector<shared::RayTreeRecord> nodes() const { return records_.readAll<shared::RayTreeRecord>(); }
  // Of one light: one per node.
  std::vector<shared::RayTreeLightRecord> lights(std::uint32_t light) const;

 private:
  std::uint32_t nodeCapacity_;
  gpu::BindingLayout layout_;
  gpu::BindingSet set_;
  gpu::ComputePipeline pipeline_;
  gpu::Buffer records_, lights_;
};

// What a recorder has of a chunk that is one camera ray. `sampleColor` counts where no nodes are kept.
RayTree assembleRayTree(const LevelRecorder& recorder, std::uint32_t lightCount, const glm::dvec3& renderOrigin,
                        const glm::vec4& sampleColor, bool branches, const glm::uvec2& pixel);

}  // namespace crosslight
