// Builds the tree: subtrees are tasks over disjoint ranges of references and node slots, so that no thread's timing can
// show in the result; a last pass packs the slots and takes the statistics. Splits are chosen in bvh_split.cpp.
#include "accel/bvh.h"

#include <cmath>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "accel/bvh_builder.h"
#include "base/check.h"
#include "base/time.h"

namespace crosslight {

void Bounds::add(const glm::vec3& p) {
  lower = glm::vec3(std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z));
  upper = glm::vec3(std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z));
}

void Bounds::add(const Bounds& other) {
  if (other.empty()) return;
  add(other.lower);
  add(other.upper);
}

namespace accel {
namespace {

// Below this a subtree is built by the thread that met it: handing it over would cost more than it gains.
constexpr std::uint32_t kTaskPrimitives = 4096;
constexpr std::uint32_t kEmptyLeaf = shared::kBvhLeaf;
// Levels of inner nodes that a path may have; the shaders' stack holds one entry less than it has places.
constexpr std::uint32_t kMaxDepth = shared::kBvhStackSize - 1;

std::uint32_t leafReference(const Work& work) {
  return shared::kBvhLeaf | (work.count << shared::kBvhCountShift) | work.begin;
}

// Inner nodes on the longest path of a tree over `count` primitives that is halved down to single primitives:
// ceil(log2(count)).
std::uint32_t medianHeight(std::uint32_t count) {
  return count < 2 ? 0u : static_cast<std::uint32_t>(std::bit_width(count - 1));
}

glm::vec3 lowerOf(const Box& box) { return {box.lower[0], box.lower[1], box.lower[2]}; }
glm::vec3 upperOf(const Box& box) { return {box.upper[0], box.upper[1], box.upper[2]}; }

class Builder {
 public:
  Builder(std::span<const Bounds> primitives, const BvhOptions& options);
  void run();
  Bvh pack() const;

 private:
  bool staysLeaf(const Work& work, const Split& split) const;
  bool fitsDepth(const Work& work, const Split& split) const;
  int partitionAtBin(const Work& work, const Split& split, Work& lower, Work& upper);
  int partitionAtMedian(const Work& work, Work& lower, Work& upper);
  std::uint32_t buildSubtree(const Work& work);
  std::uint32_t buildChild(Work& child, const Work& parent, std::uint32_t slot);
  void push(const Work& work);
  void workUntilDone();

  BvhOptions options_;
  Work root_;
  std::vector<Reference> references_;
  // A subtree of n primitives has at most n - 1 inner nodes. Its root takes the first of its n - 1 slots, the lower
  // child's subtree the next ones, the upper child's the rest: slots in use are in depth-first order.
  std::unique_ptr<shared::BvhNode[]> slots_;
  std::vector<std::uint8_t> used_;

  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<Work> tasks_;
  std::uint32_t unfinished_ = 0;
};

Builder::Builder(std::span<const Bounds> primitives, const BvhOptions& options) : options_(options) {
  CL_CHECK(options.maxLeafSize >= 1 && options.maxLeafSize <= 15);
  CL_CHECK_LE(2u, options.binCount);
  CL_CHECK_LE(primitives.size(), std::size_t{shared::kBvhFirstMask});
  const auto count = static_cast<std::uint32_t>(primitives.size());
  references_.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Bounds& b = primitives[i];
    Reference r;
    bool sound = true;
    for (int axis = 0; axis < 3; ++axis) {
      r.lower[axis] = b.lower[axis];
      r.upper[axis] = b.upper[axis];
      sound = sound && std::isfinite(b.lower[axis]) && std::isfinite(b.upper[axis]) && b.lower[axis] <= b.upper[axis];
    }
    CL_CHECK(sound && "every box of the BVH is finite and not empty");
    r.lower[3] = std::bit_cast<float>(i);
    r.upper[3] = 0;
    root_.add(r);
    references_.push_back(r);
  }
  const std::size_t slots = count > 1 ? count - 1 : 1;
  slots_ = std::make_unique_for_overwrite<shared::BvhNode[]>(slots);
  used_.assign(slots, 0);
}

// The cost of testing the children's boxes is that of one node, of a primitive that of one test.
bool Builder::staysLeaf(const Work& work, const Split& split) const {
  if (work.count == 1) return true;
  if (work.count > options_.maxLeafSize || work.depth == 0) return false;
  return !split.found || !(1.0 + split.cost < work.count);
}

// Proof that no path exceeds kMaxDepth = 63 inner nodes. Claim: every range that becomes a subtree satisfies
//   depth + medianHeight(count) <= 63.
// The root: depth 0, count < 2^27, so at most 27. A split by area is taken only if both children satisfy the claim.
// Otherwise the range is halved: the larger half has ceil(count / 2) primitives, medianHeight of which is
// medianHeight(count) - 1, while the depth grows by one, so the sum does not grow. An inner node at depth d has count
// >= 2, thus medianHeight >= 1 and d <= 62; its path has at most d + 1 <= 63 inner nodes.
bool Builder::fitsDepth(const Work& work, const Split& split) const {
  const std::uint32_t larger = std::max(split.lowerCount, work.count - split.lowerCount);
  return work.depth + 1 + medianHeight(larger) <= kMaxDepth;
}

int Builder::partitionAtBin(const Work& work, const Split& split, Work& lower, Work& upper) {
  Reference* left = references_.data() + work.begin;
  Reference* right = left + work.count;
  const auto isLower = [&](const Reference& r) { return split.mapping(r.center(split.axis)) <= split.bin; };
  while (true) {
    while (left != right && isLower(*left)) lower.add(*left++);
    while (left != right && !isLower(*(right - 1))) upper.add(*--right);
    if (left == right) break;
    std::swap(*left, *(right - 1));
  }
  CL_CHECK_EQ(lower.count, split.lowerCount);
  return split.axis;
}

int Builder::partitionAtMedian(const Work& work, Work& lower, Work& upper) {
  int axis = 0;
  double widest = -1;
  for (int i = 0; i < 3; ++i) {
    const double extent = double{work.centers.upper[i]} - work.centers.lower[i];
    if (extent > widest) {
      widest = extent;
      axis = i;
    }
  }
  Reference* const begin = references_.data() + work.begin;
  Reference* const end = begin + work.count;
  Reference* const middle = begin + (work.count + 1) / 2;
  // The index breaks ties: a total order has one median.
  std::nth_element(begin, middle, end, [axis](const Reference& a, const Reference& b) {
    const float ca = a.center(axis), cb = b.center(axis);
    return ca < cb || (ca == cb && a.index() < b.index());
  });
  for (Reference* r = begin; r != middle; ++r) lower.add(*r);
  for (Reference* r = middle; r != end; ++r) upper.add(*r);
  return axis;
}

// Child reference of the subtree; its node carries slots instead of indices until pack().
std::uint32_t Builder::buildSubtree(const Work& work) {
  const std::span<const Reference> range(references_.data() + work.begin, work.count);
  const Split split = work.count > 1 ? findSplit(range, work, options_.binCount) : Split{};
  if (staysLeaf(work, split)) return leafReference(work);

  Work lower, upper;
  const bool byArea = split.found && fitsDepth(work, split);
  const int axis = byArea ? partitionAtBin(work, split, lower, upper) : partitionAtMedian(work, lower, upper);
  lower.begin = work.begin;
  upper.begin = work.begin + lower.count;
  shared::BvhNode& node = slots_[work.slot];
  used_[work.slot] = 1;
  node.lower0 = lowerOf(lower.bounds);
  node.upper0 = upperOf(lower.bounds);
  node.lower1 = lowerOf(upper.bounds);
  node.upper1 = upperOf(upper.bounds);
  node.splitAxis = static_cast<std::uint32_t>(axis);
  node.parent = work.parentSlot;
  node.child0 = buildChild(lower, work, work.slot + 1);
  node.child1 = buildChild(upper, work, work.slot + lower.count);
  return work.slot;
}

std::uint32_t Builder::buildChild(Work& child, const Work& parent, std::uint32_t slot) {
  child.slot = slot;
  child.parentSlot = parent.slot;
  child.depth = parent.depth + 1;
  if (child.count < kTaskPrimitives) return buildSubtree(child);
  push(child);  // too large for a leaf, so it is known to become the inner node at its slot
  return slot;
}

void Builder::push(const Work& work) {
  {
    const std::scoped_lock lock(mutex_);
    tasks_.push_back(work);
    ++unfinished_;
  }
  wake_.notify_one();
}

void Builder::workUntilDone() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [&] { return !tasks_.empty() || unfinished_ == 0; });
    if (unfinished_ == 0) return;
    const Work work = tasks_.back();
    tasks_.pop_back();
    lock.unlock();
    buildSubtree(work);
    lock.lock();
    if (--unfinished_ == 0) wake_.notify_all();
  }
}

void Builder::run() {
  if (root_.count < 2) {
    const bool one = root_.count == 1;
    const Bounds empty;
    slots_[0] = {one ? lowerOf(root_.bounds) : empty.lower,
                 one ? leafReference(root_) : kEmptyLeaf,
                 one ? upperOf(root_.bounds) : empty.upper,
                 kEmptyLeaf,
                 empty.lower,
                 0,
                 empty.upper,
                 shared::kNoId};
    used_[0] = 1;
    return;
  }
  push(root_);
  const std::uint32_t wanted =
      options_.threads != 0 ? options_.threads : std::max(1u, std::thread::hardware_concurrency());
  const std::uint32_t useful = std::min(wanted, root_.count / kTaskPrimitives + 1);
  std::vector<std::jthread> helpers;
  for (std::uint32_t i = 1; i < useful; ++i) helpers.emplace_back([this] { workUntilDone(); });
  workUntilDone();
}

Bvh Builder::pack() const {
  std::vector<std::uint32_t> nodeOfSlot(used_.size());
  std::uint32_t nodes = 0;
  for (std::size_t i = 0; i < used_.size(); ++i) nodeOfSlot[i] = used_[i] != 0 ? nodes++ : shared::kNoId;
  Bvh bvh;
  bvh.nodes.reserve(nodes);
  for (std::size_t i = 0; i < used_.size(); ++i) {
    if (used_[i] == 0) continue;
    shared::BvhNode node = slots_[i];
    if (!bvhIsLeaf(node.child0)) node.child0 = nodeOfSlot[node.child0];
    if (!bvhIsLeaf(node.child1)) node.child1 = nodeOfSlot[node.child1];
    if (node.parent != shared::kNoId) node.parent = nodeOfSlot[node.parent];
    bvh.nodes.push_back(node);
  }
  bvh.order.reserve(references_.size());
  for (const Reference& r : references_) bvh.order.push_back(r.index());
  if (root_.count > 0) {
    bvh.bounds.lower = lowerOf(root_.bounds);
    bvh.bounds.upper = upperOf(root_.bounds);
  }
  takeStats(bvh);
  return bvh;
}

}  // namespace
}  // namespace accel

Bvh buildBvh(std::span<const Bounds> primitives, const BvhOptions& options) {
  const Stopwatch watch;
  accel::Builder builder(primitives, options);
  builder.run();
  Bvh bvh = builder.pack();
  bvh.stats.buildMs = watch.elapsedMs();
  return bvh;
}

}  // namespace crosslight
