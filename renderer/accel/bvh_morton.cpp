// Lauterbach et al. 2009, "Fast BVH Construction on GPUs": the code interleaves ten bits of each axis, a node splits at
// the highest bit in which its codes differ. Depth: at most 30 splits by bits, then halves of equal codes, of which
// 27 suffice for 2^27 primitives: 57 < 63.
#include "accel/bvh_morton.h"

#include <algorithm>
#include <utility>

#include "accel/bvh_treelet.h"

namespace crosslight::accel {
namespace {

constexpr std::uint32_t kCells = 1024;  // per axis
constexpr std::uint32_t kDigitBits = 10, kDigits = 1u << kDigitBits, kPasses = 3;
constexpr std::uint32_t kSortBlock = 8 * kBlock;

struct Key {
  std::uint32_t code, reference;
};

// Bit i moves to bit 3 i: Morton's dilation by masks.
std::uint32_t dilated(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ffu;
  x = (x | x << 8) & 0x0300f00fu;
  x = (x | x << 4) & 0x030c30c3u;
  return (x | x << 2) & 0x09249249u;
}

std::uint32_t blocksOf(std::uint32_t count, std::uint32_t block) { return (count + block - 1) / block; }

void makeKeys(std::span<const Reference> references, const Box& centers, Key* keys, Team& team) {
  const BinMapping mapping(centers, kCells);
  const auto count = static_cast<std::uint32_t>(references.size());
  team.forEach(blocksOf(count, kBlock), [&](std::uint32_t b) {
    for (std::uint32_t i = b * kBlock; i < std::min(count, (b + 1) * kBlock); ++i) {
      const Int4 cell = mapping(references[i].center());
      const auto bits = [&](int axis) { return dilated(static_cast<std::uint32_t>(cell[axis])); };
      keys[i] = {bits(0) << 2 | bits(1) << 1 | bits(2), i};
    }
  });
}

// One pass of a stable radix sort by the digit that starts at bit `shift`.
void sortByDigit(const Key* from, Key* to, std::uint32_t count, std::uint32_t shift, Team& team) {
  const std::uint32_t blocks = blocksOf(count, kSortBlock);
  const auto digitOf = [shift](const Key& key) { return key.code >> shift & (kDigits - 1); };
  std::vector<std::uint32_t> places(std::size_t{blocks} * kDigits, 0);
  const auto endOf = [count](std::uint32_t block) { return std::min(count, (block + 1) * kSortBlock); };
  team.forEach(blocks, [&](std::uint32_t b) {
    for (std::uint32_t i = b * kSortBlock; i < endOf(b); ++i) ++places[b * kDigits + digitOf(from[i])];
  });
  std::uint32_t before = 0;
  for (std::uint32_t digit = 0; digit < kDigits; ++digit) {
    for (std::uint32_t b = 0; b < blocks; ++b) before += std::exchange(places[b * kDigits + digit], before);
  }
  team.forEach(blocks, [&](std::uint32_t b) {
    std::uint32_t* const next = &places[b * kDigits];
    for (std::uint32_t i = b * kSortBlock; i < endOf(b); ++i) to[next[digitOf(from[i])]++] = from[i];
  });
}

// A range of sorted references and the place where it is split.
struct Range {
  std::uint32_t begin = 0, count = 0, depth = 0;
};

std::uint32_t splitOf(const Key* keys, const Range& range, std::uint32_t& axis) {
  const Key* const begin = keys + range.begin;
  const Key* const end = begin + range.count;
  const std::uint32_t differing = begin->code ^ (end - 1)->code;
  axis = 0;
  if (differing == 0) return (range.count + 1) / 2;
  const auto bit = static_cast<std::uint32_t>(std::bit_width(differing)) - 1;
  axis = 2 - bit % 3;
  const Key* const middle =
      std::partition_point(begin, end, [&](const Key& key) { return (key.code >> bit & 1u) == 0; });
  return static_cast<std::uint32_t>(middle - begin);
}

void splitRange(const Key* keys, const Range& range, Range (&children)[2], std::uint32_t& axis) {
  const std::uint32_t lower = splitOf(keys, range, axis);
  children[0] = {range.begin, lower, range.depth + 1};
  children[1] = {range.begin + lower, range.count - lower, range.depth + 1};
}

// One thread's part.
class Subtree {
 public:
  Subtree(const Plan& plan, const Reference* references, const Key* keys, shared::BvhNode* nodes)
      : plan_(plan), references_(references), keys_(keys) {
    sink_.nodes = nodes;
  }

  Piece run(const Range& range) {
    Piece piece;
    piece.nodes = sink_.nodes;
    piece.root = build(range, shared::kNoId, piece.bounds);
    piece.nodeCount = sink_.count;
    piece.stats = sink_.stats;
    return piece;
  }

 private:
  std::uint32_t build(const Range& range, std::uint32_t parent, Box& bounds) {
    if (range.count <= kTreeletPrimitives) {
      return buildTreelet(plan_, {references_ + range.begin, range.count}, range.begin, range.depth, parent, sink_,
                          bounds);
    }
    Range children[2];
    std::uint32_t axis = 0;
    splitRange(keys_, range, children, axis);
    const std::uint32_t node = sink_.open();
    Box boxes[2];
    std::uint32_t references[2];
    for (int c = 0; c < 2; ++c) references[c] = build(children[c], node, boxes[c]);
    writeNode(sink_.nodes[node], boxes[0], boxes[1], axis, parent);
    sink_.stats.maxDepth = std::max(sink_.stats.maxDepth, range.depth + 1);
    sink_.close(node, boxes, references);
    bounds = joined(boxes[0], boxes[1]);
    return node;
  }

  const Plan& plan_;
  const Reference* references_;
  const Key* keys_;
  NodeSink sink_;
};

constexpr std::uint32_t kPiecePrimitives = 4096;

void splitTop(const Key* keys, const Range& range, std::uint32_t parent, std::uint32_t childIndex, Parts& parts,
              std::vector<Range>& pieces) {
  const bool isPiece = range.count <= kPiecePrimitives;
  const auto index = static_cast<std::uint32_t>(isPiece ? pieces.size() : parts.top.size());
  if (parent != shared::kNoId) parts.top[parent].children[childIndex] = {isPiece, index, Box()};
  if (isPiece) return pieces.push_back(range);
  parts.top.emplace_back();
  Range children[2];
  splitRange(keys, range, children, parts.top.back().axis);
  for (std::uint32_t c = 0; c < 2; ++c) splitTop(keys, children[c], index, c, parts, pieces);
}

// Children come after their parents.
void setTopBounds(Parts& parts) {
  for (std::size_t t = parts.top.size(); t-- > 0;) {
    for (TopNode::Child& child : parts.top[t].children) {
      const auto& below = parts.top[child.isPiece ? t : child.index].children;
      child.bounds = child.isPiece ? parts.pieces[child.index].bounds : joined(below[0].bounds, below[1].bounds);
    }
  }
}

}  // namespace

Parts buildMorton(const Plan& plan, const Buffers& buffers, const Work& root, shared::BvhNode* nodes, Team& team) {
  const std::span<const Reference> references = buffers.range(root);
  const RawArray<Key> keys(root.count), others(root.count);
  makeKeys(references, root.centers, keys.data(), team);
  static_assert(kPasses * kDigitBits == 30 && kPasses % 2 == 1);
  for (std::uint32_t pass = 0; pass < kPasses; ++pass) {
    const bool even = pass % 2 == 0;
    sortByDigit((even ? keys : others).data(), (even ? others : keys).data(), root.count, pass * kDigitBits, team);
  }
  Reference* const sorted = buffers.sides[1].data();
  team.forEach(blocksOf(root.count, kBlock), [&](std::uint32_t b) {
    for (std::uint32_t i = b * kBlock; i < std::min(root.count, (b + 1) * kBlock); ++i)
      sorted[i] = references[others[i].reference];
  });
  Parts parts;
  parts.bounds = root.bounds;
  std::vector<Range> ranges;
  splitTop(others.data(), {0, root.count, 0}, shared::kNoId, 0, parts, ranges);
  parts.pieces.resize(ranges.size());
  team.forEach(static_cast<std::uint32_t>(ranges.size()), [&](std::uint32_t i) {
    parts.pieces[i] = Subtree(plan, sorted, others.data(), nodes + ranges[i].begin).run(ranges[i]);
  });
  setTopBounds(parts);
  return parts;
}

}  // namespace crosslight::accel
