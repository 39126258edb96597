// The scene on the device: every buffer that shaders read, bound in one go.
#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu/pipeline.h"
#include "upload/flat_bvh.h"
#include "upload/records.h"

namespace crosslight {

// Buffers of one scene as one method sees it. The frame's constants change with every sample.
class GpuScene {
 public:
  // `bvh` may be null (raster).
  GpuScene(const gpu::Device& device, const Scene& scene, const RenderSettings& settings, FlatScene flat,
           const FlatBvh* bvh);
  // For rays: each list is let go of when the device has it, so that a large scene is never there twice. flat() then
  // has no vertices and no triangles.
  static std::unique_ptr<GpuScene> forRays(const gpu::Device& device, const Scene& scene,
                                           const RenderSettings& settings, FlatScene flat, FlatBvh bvh);

  const FlatScene& flat() const { return flat_; }
  void setSample(const glm::vec2& sampleOffset, std::uint32_t sampleIndex = 0);
  void bind(gpu::BindingSet& set) const;  // slots kBindFrame .. kBindBvhPrimitives
  std::uint32_t lightCount() const { return static_cast<std::uint32_t>(scene_.lights.size()); }
  const Scene& scene() const { return scene_; }
  std::uint32_t wideDepth() const { return wideDepth_; }  // of the wide tree; 0: there is none
  std::uint64_t deviceTreeBytes() const { return triangleBoxes_ ? triangleBoxes_.sizeBytes() : 0; }
  bool hasQuads() const { return quadWaiting_ <= shared::kBvhStackSize && quadNodes_.sizeBytes() > 0; }

  const gpu::Buffer& materials() const { return materials_; }
  const gpu::Buffer& lights() const { return lights_; }
  const gpu::Buffer& positions() const { return positions_; }
  const gpu::Buffer& attributes() const { return attributes_; }
  const gpu::Buffer& indices() const { return indices_; }

 private:
  GpuScene(const gpu::Device& device, const Scene& scene, const RenderSettings& settings, FlatScene flat, FlatBvh bvh,
           bool keepsLists);
  void placeCamera();

  const Scene& scene_;
  const RenderSettings& settings_;
  FlatScene flat_;
  std::optional<RenderSettings> placedFor_;
  glm::uvec4 cameraMedia_{0};
  glm::vec3 environmentMean_{0.0f};  // radiance; for what scatters
  std::uint32_t cameraMedium_ = shared::kNoId, optics_ = 0;
  std::uint32_t shapeRoot_ = 0, wideDepth_ = 0, quadWaiting_ = 0;
  gpu::Buffer frame_, materials_, lights_, draws_, positions_, attributes_, indices_, shapes_, shapeBoxes_, texels_,
      environment_, smokeGrid_, albedoTables_, nodes_, primitives_, wideNodes_, quadNodes_, instances_,
      instanceTriangles_;
  gpu::BoxSearch triangleBoxes_;  // empty: kernels walk trees
};

// The slots that GpuScene binds, for layouts, and buffers of the technique's own: storage, or texels of 4 words.
std::vector<gpu::Binding> sceneBindings(std::initializer_list<std::uint32_t> moreStorageSlots = {},
                                        std::initializer_list<std::uint32_t> moreTexelSlots = {});
// The plan as specialisation constants, with the variant of one shader.
gpu::Constants constantsOf(const Plan& plan, std::uint32_t variant = 0);

}  // namespace crosslight
