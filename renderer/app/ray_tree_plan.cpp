// The lower half of a ray tree's drawing.
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "app/ray_tree_drawing.h"
#include "image/image_io.h"

namespace crosslight {
namespace {

constexpr double kPlanHeight = 420, kLeastPlanHeight = 120;  // pixels of the drawing
constexpr std::size_t kMostLightRays = 128;

}  // namespace

const char* colorOf(RayKind kind) {
  constexpr const char* kColors[] = {"#303030", "#c2570c", "#1565c0", "#6b7280", "#6b7280"};
  return kColors[static_cast<std::size_t>(kind)];
}

std::string escapedForSvg(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out;
}

std::string shown(const glm::vec3& c) {
  return fmt::format("#{:02x}{:02x}{:02x}", srgbCodeFromLinear(c.x), srgbCodeFromLinear(c.y), srgbCodeFromLinear(c.z));
}

std::string numbers(const glm::vec3& c) {
  return c.x == c.y && c.y == c.z ? fmt::format("{:.4g}", c.x) : fmt::format("{:.3g} {:.3g} {:.3g}", c.x, c.y, c.z);
}

RayPlan::RayPlan(const RayTree& tree, const Scene& scene, const std::vector<bool>& drawn, double width)
    : tree_(tree), scene_(scene), drawn_(drawn) {
  choosePlane();
  fit(width);
}

std::string RayPlan::svg() const {
  std::string out;
  std::size_t lightRays = 0;
  for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
    if (!drawn_[i]) continue;
    if (tree_.nodes[i].hit) out += lightLines(*tree_.nodes[i].hit, lightRays);
  }
  for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
    if (drawn_[i]) out += ray(tree_.nodes[i]);
  }
  return out;
}

glm::dvec3 RayPlan::endOf(const RayTreeNode& node) const {
  return node.hit ? node.hit->position : node.origin + node.direction * missLength_;
}

void RayPlan::choosePlane() {
  right_ = tree_.nodes[0].direction;
  const glm::dvec3 first = tree_.nodes[0].hit ? tree_.nodes[0].hit->position : tree_.nodes[0].origin;
  // Power iteration on the covariance of the end points across the camera's ray; three rounds from the largest.
  glm::dvec3 spread(0.0);
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
    const RayTreeNode& node = tree_.nodes[i];
    if (!drawn_[i]) continue;
    const glm::dvec3 p = (node.hit ? node.hit->position : node.origin + node.direction) - first;
    points.push_back(p - right_ * glm::dot(p, right_));
    if (glm::length(points.back()) > glm::length(spread)) spread = points.back();
  }
  for (int round = 0; round < 3 && glm::length(spread) > 0; ++round) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& p : points) sum += p * glm::dot(p, spread);
    spread = glm::length(sum) > 0 ? glm::normalize(sum) : spread;
  }
  const glm::dvec3 any = std::abs(right_.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  up_ = glm::length(spread) > 0 ? glm::normalize(spread) : glm::normalize(any - right_ * glm::dot(any, right_));
  if (glm::dot(up_, any) < 0) up_ = -up_;
}

// The camera's ray comes from far away: only its last part is drawn, as long as the rest is wide.
void RayPlan::fit(double width) {
  glm::dvec2 low(1e300), high(-1e300);
  const auto widen = [&](const glm::dvec3& p) {
    const glm::dvec2 q(glm::dot(p, right_), glm::dot(p, up_));
    low = glm::min(low, q);
    high = glm::max(high, q);
  };
  double reach = 0;
  for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
    if (drawn_[i] && tree_.nodes[i].hit) widen(tree_.nodes[i].hit->position);
    if (drawn_[i] && i > 0 && tree_.nodes[i].hit) reach = std::max(reach, tree_.nodes[i].hit->distance);
  }
  if (low.x > high.x) widen(tree_.nodes[0].origin);
  if (reach == 0) reach = tree_.nodes[0].hit ? tree_.nodes[0].hit->distance : 1.0;
  missLength_ = 0.5 * reach;
  start_ = tree_.nodes[0].hit ? tree_.nodes[0].hit->position - right_ * std::min(reach, tree_.nodes[0].hit->distance)
                              : tree_.nodes[0].origin;
  widen(start_);
  for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
    if (drawn_[i]) widen(endOf(tree_.nodes[i]));
  }
  const glm::dvec2 size = high - low;
  // A picture no flatter than the rays need.
  scale_ = std::min((width - 2 * kDrawingMargin) / std::max(size.x, 1e-300),
                    (kPlanHeight - 2 * kDrawingMargin) / std::max(size.y, 1e-300));
  center_ = 0.5 * (low + high);
  height_ = std::max(kLeastPlanHeight, size.y * scale_ + 2 * kDrawingMargin);
  middle_ = {width / 2, height_ / 2};
}

glm::dvec2 RayPlan::at(const glm::dvec3& p) const {
  const glm::dvec2 q(glm::dot(p, right_), glm::dot(p, up_));
  return {middle_.x + (q.x - center_.x) * scale_, middle_.y - (q.y - center_.y) * scale_};
}

std::string RayPlan::line(const glm::dvec3& from, const glm::dvec3& to, const std::string& style) const {
  const glm::dvec2 a = at(from), b = at(to);
  return fmt::format("<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' {}/>", a.x, a.y, b.x, b.y, style);
}

std::string RayPlan::ray(const RayTreeNode& node) const {
  const glm::dvec3 from = node.parent ? node.origin : start_;
  std::string out = line(
      from, endOf(node),
      fmt::format("stroke='{}' stroke-width='2'{}", colorOf(node.kind), node.hit ? "" : " stroke-dasharray='7 4'"));
  if (!node.hit) return out + "\n";
  const glm::dvec2 p = at(node.hit->position);
  out += line(node.hit->position, node.hit->position + glm::dvec3(node.hit->normal) * (18.0 / scale_),
              "stroke='#0a7d4f' stroke-width='1.2'");
  return out + fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='4' fill='{}' stroke='#000'><title>{}</title></circle>\n",
                           p.x, p.y, shown(node.own), escapedForSvg(objectNameOf(scene_, node.hit->instanceId)));
}

// A short way towards each light: whole where it arrives, broken where something is in between.
std::string RayPlan::lightLines(const RayTreeHit& hit, std::size_t& drawnLines) const {
  std::string out;
  for (std::size_t i = 0; i < hit.lights.size() && drawnLines < kMostLightRays; ++i, ++drawnLines) {
    const Light& light = scene_.lights[i];
    const bool directional = light.type == LightType::directional;
    const glm::dvec3 towards = directional ? -light.worldDirection : light.worldPosition - hit.position;
    if (!(glm::length(towards) > 0)) continue;
    const bool arrives = hit.lights[i].visible > 0;
    out +=
        line(hit.position, hit.position + glm::normalize(towards) * (46.0 / scale_),
             arrives ? "stroke='#f2b705' stroke-width='1.6'" : "stroke='#999' stroke-width='1' stroke-dasharray='2 3'");
  }
  return out + "\n";
}

}  // namespace crosslight
