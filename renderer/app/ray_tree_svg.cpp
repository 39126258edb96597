// The drawing of a ray tree: above, a card per ray with what it met and what it brings; below, the rays themselves as
// seen along the direction in which they lie closest together.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "app/ray_tree_drawing.h"
#include "app/ray_tree_files.h"

namespace crosslight {
namespace {

// Pixels of the drawing.
constexpr double kCardWidth = 240, kCardHeight = 96, kGapAcross = 18, kGapDown = 58, kTitle = 44;
constexpr double kLegend = 44, kLeastWidth = 760;
constexpr std::size_t kMostCards = 63;  // a full binary tree of depth 5

// By code points, so that no name is cut within one.
std::string shortened(const std::string& text, std::size_t most) {
  std::size_t points = 0, end = 0;
  for (; end < text.size(); ++end) {
    if ((static_cast<unsigned char>(text[end]) & 0xc0u) == 0x80u) continue;
    if (points++ == most) return text.substr(0, end) + "…";
  }
  return text;
}

float largest(const glm::vec3& v) { return std::max({v.x, v.y, v.z}); }

// The nodes that bring most, with their parents: a child brings a part of what its parent brings.
std::vector<bool> drawnNodes(const RayTree& tree) {
  std::vector<std::size_t> order(tree.nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto brings = [&](std::size_t i) { return largest(tree.nodes[i].pathWeight * tree.nodes[i].value); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return brings(a) > brings(b); });
  std::vector<bool> drawn(tree.nodes.size(), false);
  for (std::size_t i = 0; i < std::min(order.size(), kMostCards); ++i) {
    for (std::optional<std::size_t> at = order[i]; at && !drawn[*at]; at = tree.nodes[*at].parent) drawn[*at] = true;
  }
  return drawn;
}

class Cards {
 public:
  Cards(const RayTree& tree, const Scene& scene, const std::vector<bool>& drawn)
      : tree_(tree), scene_(scene), drawn_(drawn), across_(tree.nodes.size(), 0.0) {
    place(0);
  }

  double width() const { return std::max(1.0, next_) * (kCardWidth + kGapAcross); }
  double height() const { return (deepest_ + 1) * kCardHeight + deepest_ * kGapDown; }

  std::string svg() const {
    std::string out;
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
      if (drawn_[i]) out += edge(i) + card(i);
    }
    return out;
  }

 private:
  bool isDrawn(const std::optional<std::size_t>& node) const { return node && drawn_[*node]; }

  // Leaves side by side, parents above the middle of their children.
  double place(std::size_t at) {
    const RayTreeNode& node = tree_.nodes[at];
    deepest_ = std::max(deepest_, static_cast<double>(node.depth));
    double sum = 0;
    int children = 0;
    for (const auto& child : {node.reflected, node.transmitted}) {
      if (!isDrawn(child)) continue;
      sum += place(*child);
      ++children;
    }
    across_[at] = children > 0 ? sum / children : next_++;
    return across_[at];
  }

  double left(std::size_t at) const { return across_[at] * (kCardWidth + kGapAcross) + kGapAcross / 2; }
  double top(std::size_t at) const { return tree_.nodes[at].depth * (kCardHeight + kGapDown); }

  std::string edge(std::size_t at) const {
    const RayTreeNode& node = tree_.nodes[at];
    if (!node.parent) return {};
    const double x0 = left(*node.parent) + kCardWidth / 2, y0 = top(*node.parent) + kCardHeight;
    const double x1 = left(at) + kCardWidth / 2, y1 = top(at);
    return fmt::format(
        "<path d='M{:.1f} {:.1f}C{:.1f} {:.1f} {:.1f} {:.1f} {:.1f} {:.1f}' fill='none' stroke='{}' "
        "stroke-width='2'/><text x='{:.1f}' y='{:.1f}' class='w'>× {}</text>\n",
        x0, y0, x0, y0 + kGapDown / 2, x1, y1 - kGapDown / 2, x1, y1, colorOf(node.kind), x1 + 6, y1 - 10,
        numbers(node.weight));
  }

  std::string swatch(double x, double y, const glm::vec3& color) const {
    return fmt::format("<rect x='{:.1f}' y='{:.1f}' width='14' height='14' fill='{}' stroke='#888'/>", x, y,
                       shown(color));
  }

  // A dot per light: filled as far as it is seen.
  std::string lightDots(const RayTreeNode& node, double x, double y) const {
    std::string out;
    const std::size_t count = node.hit ? std::min<std::size_t>(node.hit->lights.size(), 12) : 0;
    for (std::size_t i = 0; i < count; ++i) {
      const RayTreeLight& light = node.hit->lights[i];
      out += fmt::format(
          "<circle cx='{:.1f}' cy='{:.1f}' r='4.5' fill='#f2b705' fill-opacity='{:.3f}' stroke='#555'>"
          "<title>{}: {:.3g} visible, brings {}</title></circle>",
          x + 12.0 * static_cast<double>(i), y, std::clamp(light.visible, 0.0f, 1.0f),
          escapedForSvg(lightNameOf(scene_, i)), light.visible, numbers(light.value));
    }
    return out;
  }

  std::string card(std::size_t at) const {
    const RayTreeNode& node = tree_.nodes[at];
    const double x = left(at), y = top(at);
    const std::string object = node.hit ? shortened(objectNameOf(scene_, node.hit->instanceId), 24) : "background";
    const std::string where =
        node.hit ? fmt::format("{} · {:.4g}", shortened(materialNameOf(scene_, node.hit->materialId), 18),
                               node.hit->distance)
                 : "leaves the scene";
    std::string out = fmt::format(
        "<g><rect x='{:.1f}' y='{:.1f}' width='{}' height='{}' rx='6' fill='#fff' stroke='{}' stroke-width='1.6'/>", x,
        y, kCardWidth, kCardHeight, colorOf(node.kind));
    out += fmt::format("<text x='{:.1f}' y='{:.1f}' class='k' fill='{}'>{}</text>", x + 10, y + 17, colorOf(node.kind),
                       nameOf(node.kind));
    out += fmt::format("<text x='{:.1f}' y='{:.1f}' class='o'>{}</text><text x='{:.1f}' y='{:.1f}'>{}</text>", x + 10,
                       y + 34, escapedForSvg(object), x + 10, y + 49, escapedForSvg(where));
    out += swatch(x + 10, y + 56, node.own) +
           fmt::format("<text x='{:.1f}' y='{:.1f}'>own {}</text>", x + 30, y + 67, numbers(node.own));
    out += swatch(x + 10, y + 75, node.pathWeight * node.own) +
           fmt::format("<text x='{:.1f}' y='{:.1f}'>in pixel {}</text>", x + 30, y + 86,
                       numbers(node.pathWeight * node.own));
    return out + lightDots(node, x + 88, y + 13) + "</g>\n";
  }

  const RayTree& tree_;
  const Scene& scene_;
  const std::vector<bool>& drawn_;
  std::vector<double> across_;  // in cards
  double next_ = 0, deepest_ = 0;
};

}  // namespace

std::string rayTreeSvg(const RayTree& tree, const Scene& scene) {
  const std::vector<bool> drawn = drawnNodes(tree);
  const auto count = static_cast<std::size_t>(std::count(drawn.begin(), drawn.end(), true));
  const Cards cards(tree, scene, drawn);
  const double width = std::max(kLeastWidth, cards.width() + 2 * kDrawingMargin);
  const double planTop = kTitle + cards.height() + kDrawingMargin;
  const RayPlan plan(tree, scene, drawn, width);
  const double height = planTop + plan.height() + kLegend;
  std::string out = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} {1:.0f}'>\n"
      "<style>text{{font:11px sans-serif;fill:#222}}.k{{font-weight:bold}}.o{{font-size:12px}}"
      ".t{{font-size:15px;font-weight:bold}}.w{{fill:#555;font-size:10px}}</style>\n"
      "<rect width='100%' height='100%' fill='#fafafa'/>\n",
      width, height);
  const std::string left = count < tree.nodes.size()
                               ? fmt::format("; {} of {} rays, those that bring most", count, tree.nodes.size())
                               : fmt::format("; {} rays", tree.nodes.size());
  out += fmt::format(
      "<rect x='{0}' y='12' width='20' height='20' fill='{1}' stroke='#888'/>"
      "<text x='{2}' y='27' class='t'>pixel ({3}, {4}) of {5}: {6}{7}</text>\n",
      kDrawingMargin, shown(glm::vec3(tree.color)), kDrawingMargin + 30, tree.pixel.x, tree.pixel.y,
      escapedForSvg(shortened(scene.source.filename().string(), 48)), numbers(glm::vec3(tree.color)), left);
  out += fmt::format("<g transform='translate({:.1f} {:.1f})'>\n{}</g>\n", 0.5 * (width - cards.width()), kTitle,
                     cards.svg());
  out += fmt::format("<g transform='translate(0 {:.1f})'>\n{}</g>\n", planTop, plan.svg());
  out += fmt::format(
      "<text x='{0}' y='{1:.0f}'>rays: black primary, orange reflection, blue refraction, gray straight through, "
      "broken: leaves the scene</text><text x='{0}' y='{2:.0f}'>green: normals; towards lights: yellow arrives, gray "
      "blocked; × share in the parent's color</text>\n</svg>\n",
      kDrawingMargin, height - 26, height - 10);
  return out;
}

}  // namespace crosslight
