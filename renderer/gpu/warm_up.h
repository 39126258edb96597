// Has a driver compile compute pipelines before they are needed, beside other work.
#pragma once

#include "gpu/pipeline.h"

namespace crosslight::gpu {

struct WarmUpImpl;
// Software drivers make machine code only when a pipeline first runs: this runs it on nothing. Elsewhere it does
// nothing at all.
class WarmUp {
 public:
  WarmUp() = default;
  WarmUp(const Device& device, const BindingLayout& layout);
  // Comes back at once; from any thread. The pipeline is of the layout, which has no uniformWindow, and outlives this.
  void add(const ComputePipeline& pipeline);
  // Waits for the first pipeline, but not long: is it being compiled, rather than found in the driver's own cache?
  bool compiles();

 private:
  Owned<WarmUpImpl> impl_;
};

}  // namespace crosslight::gpu
