#include "accel/bvh_binned.h"

#include <algorithm>

#include "accel/bvh_joint.h"
#include "accel/bvh_partition.h"
#include "accel/bvh_treelet.h"

namespace crosslight::accel {
namespace {

// One thread's part: a subtree from its references to its nodes.
class Subtree {
 public:
  Subtree(const Plan& plan, const Buffers& buffers, shared::BvhNode* nodes) : plan_(plan), buffers_(buffers) {
    sink_.nodes = nodes;
  }

  Piece run(Work work) {
    Piece piece;
    piece.nodes = sink_.nodes;
    piece.root = build(work, shared::kNoId);
    piece.bounds = work.bounds;
    piece.nodeCount = sink_.count;
    piece.stats = sink_.stats;
    return piece;
  }

 private:
  std::uint32_t build(const Work& work, std::uint32_t parent) {
    const std::span<Reference> range = buffers_.range(work);
    if (work.count <= kTreeletPrimitives) {
      Box ignored;
      return buildTreelet(plan_, range, work.begin, work.depth, parent, sink_, ignored);
    }
    Work children[2];
    std::uint32_t axis = 0;
    if (!part(work, range, children, axis)) return leaf(work, range);
    const std::uint32_t node = sink_.open();
    const Box boxes[2] = {children[0].bounds, children[1].bounds};
    writeNode(sink_.nodes[node], boxes[0], boxes[1], axis, parent);
    sink_.stats.maxDepth = std::max(sink_.stats.maxDepth, work.depth + 1);
    std::uint32_t references[2];
    for (int c = 0; c < 2; ++c) references[c] = build(children[c], node);
    sink_.close(node, boxes, references);
    return node;
  }

  // False: a leaf.
  bool part(const Work& work, std::span<Reference> range, Work (&children)[2], std::uint32_t& axis) {
    const Box centers = boxOfCenters(range);
    const std::uint32_t binCount = usefulBins(work.count, plan_.options.binCount);
    const BinMapping mapping(centers, binCount);
    bins_.fill(binCount, range, mapping);
    const Split split = chooseSplit(bins_, binCount, mapping, work.bounds, plan_.unit);
    if (staysLeaf(plan_.options, work.count, work.depth, split.found ? split.cost : kInfinity)) return false;
    if (!isUsable(work, split)) {
      Work whole = work;
      whole.centers = centers;
      axis = splitInHalves(buffers_, whole, children);
      return true;
    }
    boxesOfSides(bins_, binCount, split, children[0].bounds, children[1].bounds);
    rangesOf(work, split, children);
    scatter(range, split, buffers_.range(children[0]).data(), buffers_.range(children[1]).data());
    axis = split.axis;
    return true;
  }

  std::uint32_t leaf(const Work& work, std::span<const Reference> range) const {
    for (std::uint32_t i = 0; i < work.count; ++i) plan_.order[work.begin + i] = range[i].index();
    return leafReference(work.begin, work.count);
  }

  const Plan& plan_;
  const Buffers& buffers_;
  NodeSink sink_;
  Bins bins_;
};

// So many pieces that threads end together, so large that joining on them would cost more.
std::uint32_t pieceSize(std::uint32_t count) { return std::clamp(count / 256, 1024u, kBlock); }

}  // namespace

Parts buildBinned(const Plan& plan, const Buffers& buffers, const Work& root, shared::BvhNode* nodes, Team& team) {
  Parts parts;
  parts.bounds = root.bounds;
  const std::vector<Work> work = splitJointly(plan, buffers, root, pieceSize(root.count), team, parts);
  parts.pieces.resize(work.size());
  team.forEach(static_cast<std::uint32_t>(work.size()),
               [&](std::uint32_t i) { parts.pieces[i] = Subtree(plan, buffers, nodes + work[i].begin).run(work[i]); });
  return parts;
}

}  // namespace crosslight::accel
