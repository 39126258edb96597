// Which pipelines wait for their next use.
#include <algorithm>

#include "gpu/impl.h"

namespace crosslight::gpu {
namespace {

// Several methods' pipelines for several plans; beyond that the longest unused go.
constexpr std::size_t kMostParked = 64;

}  // namespace

vk::raii::Pipeline PipelinePool::take(const std::string& key) {
  const std::scoped_lock lock(mutex_);
  const auto found = std::find_if(parked_.begin(), parked_.end(), [&](const Parked& p) { return p.key == key; });
  if (found == parked_.end()) return vk::raii::Pipeline(nullptr);
  vk::raii::Pipeline pipeline = std::move(found->pipeline);
  parked_.erase(found);
  return pipeline;
}

void PipelinePool::park(std::string key, std::shared_ptr<BindingLayoutImpl> layout, vk::raii::Pipeline pipeline) {
  const std::scoped_lock lock(mutex_);
  parked_.push_front({std::move(key), std::move(layout), std::move(pipeline)});
  if (parked_.size() > kMostParked) parked_.pop_back();
}

}  // namespace crosslight::gpu
