#include "accel/cached_trees.h"

namespace crosslight {

std::shared_ptr<const Bvh> CachedTrees::over(const BvhTriangles& triangles) {
  const BvhOptions options;
  if (cache_.folder.empty() || triangles.count() < kBvhCachePrimitives)
    return std::make_shared<const Bvh>(buildTriangleBvh(triangles, options));
  const BvhKey key = bvhKey(triangles, options);
  if (std::optional<Bvh> found = loadBvh(cache_, key, triangles.count())) {
    ++loaded_;
    return std::make_shared<const Bvh>(*std::move(found));
  }
  const auto built = std::make_shared<const Bvh>(buildTriangleBvh(triangles, options));
  // One thread: the others have the picture to draw.
  writing_.push_back(std::async(std::launch::async, [cache = cache_, key, built] { storeBvh(cache, key, *built, 1); }));
  return built;
}

}  // namespace crosslight
