#include "trace/ray_store.h"

#include <algorithm>

#include "bindings.h"

namespace crosslight {

using namespace shared;

namespace {

constexpr std::uint32_t kChunkRays = 1u << 18;   // camera rays at once
constexpr std::uint32_t kChunkTrees = 1u << 17;  // the same where they grow trees
constexpr std::uint32_t kNodesPerPixel = 8;      // room for a tree, on average; a fuller chunk is halved
constexpr std::uint32_t kFewestNodes = 4096;     // a small image may still have deep trees

std::uint32_t capacityFor(const gpu::Device& device, std::uint32_t chunk, bool tree) {
  const std::uint64_t fits = device.info().maxStorageBufferBytes / sizeof(RayNode);
  const std::uint64_t wanted =
      std::max(std::uint64_t{chunk} * (tree ? kNodesPerPixel : 1), std::uint64_t{kFewestNodes});
  return static_cast<std::uint32_t>(std::min(wanted, fits));
}

template <class Record>
gpu::Buffer listOf(const gpu::Device& device, const char* name, std::uint64_t count) {
  return {device, name, count * sizeof(Record), gpu::useStorage | gpu::useUniformTexel};
}

// Words that shaders write and dispatches read.
gpu::Buffer wordsOf(const gpu::Device& device, const char* name, std::uint64_t count) {
  return {device, name, std::max<std::uint64_t>(count, 1) * sizeof(std::uint32_t), gpu::useStorage | gpu::useIndirect};
}

// One per light of the batch and one for the environment; with shadows in color for each channel.
std::uint64_t visibilitiesOf(const RayStoreSize& size, std::uint32_t capacity, std::uint32_t batch) {
  return std::uint64_t{capacity} * (batch + (size.environment ? 1 : 0)) * (size.coloredShadows ? 3 : 1);
}

}  // namespace

RayStore::RayStore(const gpu::Device& device, const RayStoreSize& size, const HitClasses& classes)
    : chunk(std::min(size.tree ? kChunkTrees : kChunkRays, size.cameraRays)),
      capacity(capacityFor(device, chunk, size.tree)),
      batch(lightBatch(size.lights)),
      rays(listOf<RayRecord>(device, "rays", size.tree ? capacity : 1)),
      nodes(listOf<RayNode>(device, "ray nodes", size.branches ? capacity : 1)),
      hits(listOf<HitRecord>(device, "hits", capacity)),
      rest(wordsOf(device, "groups that packets gave up", kRestGroups + capacity / kRaysPerGroup + 1)),
      queues(wordsOf(device, "hit queues", classes.classes.empty() ? 0 : kHitClasses * (kQueueWords + capacity))),
      hitClasses(gpu::Buffer::of(device, "hit classes", classes.ofMaterial, gpu::useUniformTexel)),
      media(listOf<glm::uvec4>(device, "bodies that rays are in", size.nestedMedia ? capacity : 1)),
      visibility(listOf<float>(device, "visibility", size.shadows ? visibilitiesOf(size, capacity, batch) : 1)) {}

void RayStore::bind(gpu::BindingSet& set) const {
  set.set(kBindRays, rays);
  set.set(kBindRayTexels, rays);
  set.set(kBindRayNodes, nodes);
  set.set(kBindNodeTexels, nodes);
  set.set(kBindHits, hits);
  set.set(kBindHitTexels, hits);
  set.set(kBindRest, rest);
  set.set(kBindQueues, queues);
  set.set(kBindHitClasses, hitClasses);
  set.set(kBindMedia, media);
  set.set(kBindVisibility, visibility);
}

}  // namespace crosslight
