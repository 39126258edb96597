#include "accel/bvh_treelet.h"

#include <array>

namespace crosslight::accel {
namespace {

constexpr std::uint32_t kSets = 1u << kTreeletPrimitives;

class Treelet {
 public:
  Treelet(const Plan& plan, std::span<const Reference> references, std::uint32_t first, NodeSink& sink)
      : plan_(plan), references_(references), next_(first), sink_(sink) {
    const auto sets = std::uint32_t{1} << references.size();
    for (std::uint32_t s = 1; s < sets; ++s) {
      const std::uint32_t rest = s & (s - 1);
      const Box& lowest = references[static_cast<std::size_t>(std::countr_zero(s))];
      boxes_[s] = rest == 0 ? lowest : joined(boxes_[rest], lowest);
    }
    const Float4 unit = splat(plan.unit);
    for (std::uint32_t s = 1; s < sets; s += 3) {
      const Float4 three = halfAreas(boxes_[s], boxes_[s + 1], boxes_[s + 2], unit);
      for (std::uint32_t i = 0; i < 3; ++i) areas_[s + i] = three[i];
    }
  }

  const Box& box(std::uint32_t set) const { return boxes_[set]; }

  std::uint32_t build(std::uint32_t set, std::uint32_t depth, std::uint32_t parent) {
    const auto count = static_cast<std::uint32_t>(std::popcount(set));
    std::uint32_t sides[2] = {0, 0};
    const float cost = count > 1 ? chooseSides(set, depth, sides) : 0.0f;
    // Not (area > 0): such a set has no chance of a hit that could be weighed, and splits down to single primitives.
    const double relative = areas_[set] > 0 ? double{cost} / areas_[set] : 0.0;
    if (staysLeaf(plan_.options, count, depth, relative)) return leaf(set, count);
    const std::uint32_t node = sink_.open();
    const std::uint32_t axis = order(sides);
    writeNode(sink_.nodes[node], boxes_[sides[0]], boxes_[sides[1]], axis, parent);
    sink_.stats.maxDepth = std::max(sink_.stats.maxDepth, depth + 1);
    std::uint32_t children[2];
    for (int c = 0; c < 2; ++c) children[c] = build(sides[c], depth + 1, node);
    sink_.close(node, {boxes_[sides[0]], boxes_[sides[1]]}, children);
    return node;
  }

 private:
  // Halves come first, so that they win where areas say nothing.
  float chooseSides(std::uint32_t set, std::uint32_t depth, std::uint32_t (&sides)[2]) const {
    const std::uint32_t lowest = set & (0 - set), others = set ^ lowest;
    const int count = std::popcount(set);
    float best = kInfinity;
    for (const bool halves : {true, false}) {
      for (std::uint32_t some = others;; some = (some - 1) & others) {
        const std::uint32_t a = some | lowest, b = set ^ a;
        const int na = std::popcount(a), nb = count - na;
        if (nb > 0 && halves == (std::abs(na - nb) <= 1) &&
            (halves || fitsDepth(depth, static_cast<std::uint32_t>(std::max(na, nb))))) {
          const float cost = areas_[a] * static_cast<float>(na) + areas_[b] * static_cast<float>(nb);
          if (cost < best || sides[0] == 0) {
            best = cost;
            sides[0] = a;
            sides[1] = b;
          }
        }
        if (some == 0) break;
      }
      if (count < 4) break;
    }
    return best;
  }

  // The lower side first, along the axis that parts the two boxes' centers most; returns that axis.
  std::uint32_t order(std::uint32_t (&sides)[2]) const {
    const Box &a = boxes_[sides[0]], &b = boxes_[sides[1]];
    const Float4 step = (b.lower * 0.5f + b.upper * 0.5f) - (a.lower * 0.5f + a.upper * 0.5f);
    const Float4 size = maximum(step, -step);
    const std::uint32_t axis = size[1] > size[0] ? (size[2] > size[1] ? 2 : 1) : (size[2] > size[0] ? 2 : 0);
    if (step[axis] < 0) std::swap(sides[0], sides[1]);
    return axis;
  }

  std::uint32_t leaf(std::uint32_t set, std::uint32_t count) {
    const std::uint32_t first = next_;
    for (std::uint32_t rest = set; rest != 0; rest &= rest - 1) {
      plan_.order[next_++] = references_[static_cast<std::size_t>(std::countr_zero(rest))].index();
    }
    return leafReference(first, count);
  }

  const Plan& plan_;
  std::span<const Reference> references_;
  std::uint32_t next_;
  NodeSink& sink_;
  Box boxes_[kSets + 2];  // by set of primitives; two more, because areas are computed by threes
  float areas_[kSets + 2];
};

}  // namespace

std::uint32_t buildTreelet(const Plan& plan, std::span<const Reference> references, std::uint32_t first,
                           std::uint32_t depth, std::uint32_t parent, NodeSink& sink, Box& bounds) {
  Treelet treelet(plan, references, first, sink);
  const std::uint32_t all = (1u << references.size()) - 1;
  bounds = treelet.box(all);
  return treelet.build(all, depth, parent);
}

}  // namespace crosslight::accel
