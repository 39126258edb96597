// Device memory for one chunk of camera rays and the trees that grow from them.
#pragma once

#include <cstdint>

#include "gpu/memory.h"
#include "gpu/pipeline.h"
#include "trace/kernels.h"

namespace crosslight {

struct RayStoreSize {
  std::uint32_t cameraRays = 0;  // of the picture
  std::uint32_t lights = 0;
  bool tree = false;      // rays may follow
  bool branches = false;  // nodes are kept
  bool environment = false;
  bool nestedMedia = false;
  bool coloredShadows = false;
  bool shadows = false;
};

struct RayStore {
  RayStore(const gpu::Device& device, const RayStoreSize& size, const HitClasses& classes);
  void bind(gpu::BindingSet& set) const;

  std::uint32_t chunk;     // camera rays at once
  std::uint32_t capacity;  // nodes of their trees
  std::uint32_t batch;     // lights whose visibility is kept at once
  gpu::Buffer rays, nodes, hits, rest, queues, hitClasses, media, visibility;
};

}  // namespace crosslight
