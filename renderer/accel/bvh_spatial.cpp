#include "accel/bvh_spatial.h"

#include <algorithm>
#include <utility>

#include "accel/bvh_partition.h"
#include "accel/bvh_spatial_split.h"
#include "accel/bvh_treelet.h"

namespace crosslight::accel {
namespace {

// A spatial split is looked for where the children of the other overlap by more than this share of the tree's area
// (section 4.5 of the paper), and of the range's own: less is seldom gained back, and most ranges of even meshes have
// less. Walls among small things cost the same with 0.2 as with 0, and 11 % more with 0.4.
constexpr double kOverlapOfTree = 1e-5, kOverlapOfRange = 0.2;

double overlap(const Box& a, const Box& b) {
  Box common;
  common.lower = maximum(a.lower, b.lower);
  common.upper = minimum(a.upper, b.upper);
  for (int axis = 0; axis < 3; ++axis) {
    if (common.lower[axis] > common.upper[axis]) return 0;
  }
  return common.halfArea();
}

// How one range becomes two; what the top and the pieces share.
class Splitter {
 public:
  Splitter(const Plan& plan, const BvhTriangles& triangles, double rootArea)
      : plan_(plan), triangles_(triangles), rootArea_(rootArea) {}

  // False: a leaf. The range's references are used up otherwise.
  bool split(SpatialRange& range, SpatialRange (&children)[2], std::uint32_t& axis) {
    range.centers = boxOfCenters(range.references);
    const std::uint32_t binCount = plan_.options.binCount;
    const BinMapping mapping(range.centers, binCount);
    bins_.fill(binCount, range.references, mapping);
    const Split byObject = chooseSplit(bins_, binCount, mapping, range.bounds, plan_.unit);
    Box sides[2];
    if (byObject.found) boxesOfSides(bins_, binCount, byObject, sides[0], sides[1]);
    SpatialSplit bySpace;
    if (!byObject.found || overlaps(range, sides[0], sides[1])) bySpace = chooseSpatialSplit(triangles_, range);
    double cost = byObject.found ? byObject.cost : double{kInfinity};
    if (bySpace.found) cost = std::min(cost, bySpace.cost);
    if (staysLeaf(plan_.options, range.count(), range.depth, cost)) return false;
    if (bySpace.found && !(byObject.found && byObject.cost <= bySpace.cost) &&
        splitSpatially(triangles_, range, bySpace, children)) {
      axis = static_cast<std::uint32_t>(bySpace.axis);
    } else {
      axis = splitObjects(range, byObject, children);
    }
    shareBudget(range, children);
    range.references = {};
    return true;
  }

 private:
  bool overlaps(const SpatialRange& range, const Box& a, const Box& b) const {
    return overlap(a, b) > std::max(kOverlapOfTree * rootArea_, kOverlapOfRange * range.bounds.halfArea());
  }

  std::uint32_t splitObjects(SpatialRange& range, const Split& split, SpatialRange (&children)[2]) const {
    const std::uint32_t larger = std::max(split.lowerCount, range.count() - split.lowerCount);
    const bool byArea = split.found && fitsDepth(range.depth, larger);
    const std::uint32_t axis = byArea ? split.axis : halve(range.references, range.centers);
    for (SpatialRange& child : children) child = SpatialRange();
    for (std::uint32_t i = 0; i < range.count(); ++i) {
      const Reference& r = range.references[i];
      const bool isLower = byArea ? split.isLower(r) : i < (range.count() + 1) / 2;
      SpatialRange& child = children[isLower ? 0 : 1];
      child.references.push_back(r);
      child.bounds.add(r);
    }
    return axis;
  }

  // By their number of references.
  static void shareBudget(const SpatialRange& range, SpatialRange (&children)[2]) {
    const std::uint64_t total = children[0].count() + children[1].count();
    const std::uint64_t left = range.budget - (total - range.count());
    children[0].budget = static_cast<std::uint32_t>(left * children[0].count() / total);
    children[1].budget = static_cast<std::uint32_t>(left) - children[0].budget;
    for (SpatialRange& child : children) child.depth = range.depth + 1;
  }

  const Plan& plan_;
  const BvhTriangles& triangles_;
  double rootArea_;
  Bins bins_;
};

// One thread's part; leaves count from 0 in its own order.
class Subtree {
 public:
  Subtree(const Plan& plan, const BvhTriangles& triangles, double rootArea, SpatialPiece& piece)
      : plan_(plan), splitter_(plan_, triangles, rootArea), piece_(piece) {
    plan_.order = piece.order.data();
    sink_.nodes = piece.nodes.data();
  }

  Piece run(SpatialRange& range) {
    Piece piece;
    piece.nodes = sink_.nodes;
    piece.bounds = range.bounds;
    piece.root = build(range, shared::kNoId);
    piece.nodeCount = sink_.count;
    piece.stats = sink_.stats;
    return piece;
  }

 private:
  std::uint32_t build(SpatialRange& range, std::uint32_t parent) {
    const std::uint32_t first = piece_.orderCount;
    if (range.count() <= kTreeletPrimitives) {
      piece_.orderCount += range.count();
      Box ignored;
      return buildTreelet(plan_, range.references, first, range.depth, parent, sink_, ignored);
    }
    SpatialRange children[2];
    std::uint32_t axis = 0;
    if (!splitter_.split(range, children, axis)) {
      for (const Reference& r : range.references) plan_.order[piece_.orderCount++] = r.index();
      return leafReference(first, range.count());
    }
    const std::uint32_t node = sink_.open();
    const Box boxes[2] = {children[0].bounds, children[1].bounds};
    writeNode(sink_.nodes[node], boxes[0], boxes[1], axis, parent);
    sink_.stats.maxDepth = std::max(sink_.stats.maxDepth, range.depth + 1);
    std::uint32_t references[2];
    for (int c = 0; c < 2; ++c) references[c] = build(children[c], node);
    sink_.close(node, boxes, references);
    return node;
  }

  Plan plan_;
  Splitter splitter_;
  SpatialPiece& piece_;
  NodeSink sink_;
};

constexpr std::uint32_t kPiecePrimitives = 2048;

// The top: ranges of one level are split by different threads, each by one.
class Top {
 public:
  Top(const Plan& plan, const BvhTriangles& triangles, double rootArea, Team& team)
      : plan_(plan), triangles_(triangles), rootArea_(rootArea), team_(team) {}

  std::vector<SpatialRange> run(SpatialRange root, Parts& parts) {
    add(std::move(root), shared::kNoId, 0, parts);
    while (!level_.empty()) {
      std::vector<Open> level;
      std::swap(level, level_);
      team_.forEach(static_cast<std::uint32_t>(level.size()), [&](std::uint32_t i) {
        Splitter(plan_, triangles_, rootArea_).split(level[i].range, level[i].children, level[i].axis);
      });
      for (Open& open : level) {
        parts.top[open.node].axis = open.axis;
        for (std::uint32_t c = 0; c < 2; ++c) add(std::move(open.children[c]), open.node, c, parts);
      }
    }
    return std::move(pieces_);
  }

 private:
  struct Open {
    SpatialRange range;
    std::uint32_t node = 0, axis = 0;
    SpatialRange children[2];
  };

  void add(SpatialRange range, std::uint32_t parent, std::uint32_t childIndex, Parts& parts) {
    const bool isPiece = range.count() <= kPiecePrimitives;
    const auto index = static_cast<std::uint32_t>(isPiece ? pieces_.size() : parts.top.size());
    if (parent != shared::kNoId) parts.top[parent].children[childIndex] = {isPiece, index, range.bounds};
    if (isPiece) return pieces_.push_back(std::move(range));
    parts.top.emplace_back();
    level_.emplace_back();
    level_.back().range = std::move(range);
    level_.back().node = index;
  }

  const Plan& plan_;
  const BvhTriangles& triangles_;
  double rootArea_;
  Team& team_;
  std::vector<Open> level_;
  std::vector<SpatialRange> pieces_;
};

}  // namespace

SpatialParts buildSpatial(const Plan& plan, const BvhTriangles& triangles, std::span<const Reference> references,
                          const Work& root, Team& team) {
  SpatialParts result;
  result.parts.bounds = root.bounds;
  SpatialRange all;
  all.references.assign(references.begin(), references.end());
  all.bounds = root.bounds;
  const double most = std::min(double{plan.options.mostDuplicates} * root.count,
                               static_cast<double>(shared::kBvhFirstMask - root.count));
  all.budget = static_cast<std::uint32_t>(most);
  const double rootArea = root.bounds.halfArea();
  std::vector<SpatialRange> ranges = Top(plan, triangles, rootArea, team).run(std::move(all), result.parts);
  result.pieces.resize(ranges.size());
  result.parts.pieces.resize(ranges.size());
  team.forEach(static_cast<std::uint32_t>(ranges.size()), [&](std::uint32_t i) {
    const std::size_t room = std::size_t{ranges[i].count()} + ranges[i].budget;
    result.pieces[i].room = room;
    result.pieces[i].nodes = RawArray<shared::BvhNode>(room);
    result.pieces[i].order = RawArray<std::uint32_t>(room);
    result.parts.pieces[i] = Subtree(plan, triangles, rootArea, result.pieces[i]).run(ranges[i]);
  });
  return result;
}

}  // namespace crosslight::accel
