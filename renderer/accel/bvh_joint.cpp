#include "accel/bvh_joint.h"

#include <algorithm>
#include <utility>

#include "accel/bvh_partition.h"

namespace crosslight::accel {
namespace {

class Joint {
 public:
  Joint(const Plan& plan, const Buffers& buffers, Team& team, std::uint32_t piecePrimitives)
      : plan_(plan), buffers_(buffers), team_(team), piecePrimitives_(piecePrimitives) {}

  std::vector<Work> run(const Work& root, Parts& parts) {
    addRange(root, shared::kNoId, 0, parts);
    while (!level_.empty()) {
      std::vector<Range> ranges;
      std::swap(ranges, level_);
      splitAll(ranges);
      for (Range& range : ranges) {
        parts.top[range.node].axis = range.axis;
        for (std::uint32_t c = 0; c < 2; ++c) addRange(range.children[c], range.node, c, parts);
      }
    }
    return std::move(pieces_);
  }

 private:
  struct Block {
    std::uint32_t range = 0, begin = 0, count = 0;  // begin counts within the range
    std::uint32_t lowerBefore = 0;                  // in the blocks before this one
    Box centers[2];
  };
  struct Range {
    Work work;
    std::uint32_t node = 0;
    std::uint32_t firstBlock = 0, blockCount = 0;
    BinMapping mapping;
    Split split;
    bool halves = false;
    std::uint32_t axis = 0;
    Work children[2];
  };

  void addRange(const Work& work, std::uint32_t parent, std::uint32_t childIndex, Parts& parts) {
    const bool isPiece = work.count <= piecePrimitives_;
    const auto index = static_cast<std::uint32_t>(isPiece ? pieces_.size() : parts.top.size());
    if (parent != shared::kNoId) parts.top[parent].children[childIndex] = {isPiece, index, work.bounds};
    if (isPiece) {
      pieces_.push_back(work);
      return;
    }
    parts.top.emplace_back();
    Range& range = level_.emplace_back();
    range.work = work;
    range.node = index;
  }

  void splitAll(std::vector<Range>& ranges) {
    cut(ranges);
    const std::uint32_t binCount = plan_.options.binCount;
    team_.forEach(static_cast<std::uint32_t>(blocks_.size()), [&](std::uint32_t b) {
      const Range& range = ranges[blocks_[b].range];
      bins_[b].fill(binCount, referencesOf(range, blocks_[b]), range.mapping);
    });
    team_.forEach(static_cast<std::uint32_t>(ranges.size()), [&](std::uint32_t r) { choose(ranges[r]); });
    team_.forEach(static_cast<std::uint32_t>(blocks_.size()), [&](std::uint32_t b) { move(ranges, blocks_[b]); });
    for (const Block& block : blocks_) {
      for (int c = 0; c < 2; ++c) ranges[block.range].children[c].centers.add(block.centers[c]);
    }
  }

  void cut(std::vector<Range>& ranges) {
    blocks_.clear();
    for (std::uint32_t r = 0; r < ranges.size(); ++r) {
      Range& range = ranges[r];
      range.mapping = BinMapping(range.work.centers, plan_.options.binCount);
      range.firstBlock = static_cast<std::uint32_t>(blocks_.size());
      for (std::uint32_t begin = 0; begin < range.work.count; begin += kBlock) {
        Block& block = blocks_.emplace_back();
        block.range = r;
        block.begin = begin;
        block.count = std::min(kBlock, range.work.count - begin);
      }
      range.blockCount = static_cast<std::uint32_t>(blocks_.size()) - range.firstBlock;
    }
    if (bins_.size() < blocks_.size()) bins_ = std::vector<Bins>(blocks_.size());
  }

  std::span<const Reference> referencesOf(const Range& range, const Block& block) const {
    return buffers_.range(range.work).subspan(block.begin, block.count);
  }

  // Adds up the blocks' bins in the first one's, and puts into each block how many lower references lie before it.
  void choose(Range& range) {
    const std::uint32_t binCount = plan_.options.binCount;
    Bins all = bins_[range.firstBlock];
    for (std::uint32_t b = 1; b < range.blockCount; ++b) all.add(bins_[range.firstBlock + b], binCount);
    range.split = chooseSplit(all, binCount, range.mapping, range.work.bounds, plan_.unit);
    range.halves = !isUsable(range.work, range.split);
    if (range.halves) {
      range.axis = splitInHalves(buffers_, range.work, range.children);
      return;
    }
    range.axis = range.split.axis;
    boxesOfSides(all, binCount, range.split, range.children[0].bounds, range.children[1].bounds);
    rangesOf(range.work, range.split, range.children);
    std::uint32_t before = 0;
    for (std::uint32_t b = range.firstBlock; b < range.firstBlock + range.blockCount; ++b) {
      blocks_[b].lowerBefore = before;
      for (std::uint32_t i = 0; i <= range.split.bin; ++i)
        before += static_cast<std::uint32_t>(bins_[b].list[i].counts[range.axis]);
    }
  }

  void move(const std::vector<Range>& ranges, Block& block) const {
    const Range& range = ranges[block.range];
    if (range.halves) {
      if (block.begin != 0) return;
      for (int c = 0; c < 2; ++c) block.centers[c] = boxOfCenters(buffers_.range(range.children[c]));
      return;
    }
    Reference* const lower = buffers_.range(range.children[0]).data() + block.lowerBefore;
    Reference* const upper = buffers_.range(range.children[1]).data() + (block.begin - block.lowerBefore);
    const std::size_t lowerCount = scatter(referencesOf(range, block), range.split, lower, upper);
    block.centers[0] = boxOfCenters({lower, lowerCount});
    block.centers[1] = boxOfCenters({upper, block.count - lowerCount});
  }

  const Plan& plan_;
  const Buffers& buffers_;
  Team& team_;
  std::uint32_t piecePrimitives_;
  std::vector<Range> level_;
  std::vector<Block> blocks_;
  std::vector<Bins> bins_;
  std::vector<Work> pieces_;
};

}  // namespace

std::vector<Work> splitJointly(const Plan& plan, const Buffers& buffers, const Work& root,
                               std::uint32_t piecePrimitives, Team& team, Parts& parts) {
  return Joint(plan, buffers, team, piecePrimitives).run(root, parts);
}

}  // namespace crosslight::accel
