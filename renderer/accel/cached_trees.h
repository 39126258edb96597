// Trees of a process from the cache on disk: found there, or built and written beside whatever comes next.
#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <utility>
#include <vector>

#include "accel/bvh_cache.h"

namespace crosslight {

class CachedTrees {
 public:
  explicit CachedTrees(BvhCache cache) : cache_(std::move(cache)) {}
  ~CachedTrees() = default;  // waits until what was built is written
  CachedTrees(const CachedTrees&) = delete;
  CachedTrees& operator=(const CachedTrees&) = delete;

  const BvhCache& cache() const { return cache_; }
  // The tree of medium quality over these triangles. Shared with the thread that writes it.
  std::shared_ptr<const Bvh> over(const BvhTriangles& triangles);
  std::uint32_t takeLoaded() { return std::exchange(loaded_, 0u); }

 private:
  BvhCache cache_;
  std::vector<std::future<void>> writing_;
  std::uint32_t loaded_ = 0;
};

}  // namespace crosslight
