#include "raster/shadow_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace crosslight {

using namespace shared;

namespace {

using glm::dvec2;
using glm::dvec3;

// Blockers nearer to a lamp than this share of the way to the scene's farthest corner are taken for its housing, as the
// tracer takes those in the last 2^-13 of a shadow ray.
constexpr double kHousing = 1.0 / 8192.0;
constexpr double kPi = 3.14159265358979323846;

struct Axes {
  dvec3 right, up, forward;
};

// Any right-handed frame about a direction: along the two render axes that are most across it.
Axes axesOf(const dvec3& forward) {
  const dvec3 a = glm::abs(forward);
  const dvec3 helper = a.x <= a.y && a.x <= a.z ? dvec3(1, 0, 0) : a.y <= a.z ? dvec3(0, 1, 0) : dvec3(0, 0, 1);
  const dvec3 right = glm::normalize(glm::cross(helper, forward));
  return {right, glm::cross(forward, right), forward};
}

std::array<dvec3, 8> cornersOf(const dvec3& lower, const dvec3& upper) {
  std::array<dvec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = {(i & 1 ? upper : lower).x, (i & 2 ? upper : lower).y, (i & 4 ? upper : lower).z};
  return corners;
}

// Where rays to a light with an area end: middleOf() of shaders/light/area.glsl.
dvec3 middleOf(const Light& light) {
  const dvec3 fromCorner = light.type == LightType::areaTriangle ? (light.worldU + light.worldV) / 3.0 : dvec3(0.0);
  return light.worldPosition + fromCorner;
}

// Half the side of the square that a light is taken for, scene units; rectangles and triangles have its area.
double halfSizeOf(const Light& light, double otherwise) {
  const double parallelogram =
      glm::length(glm::cross(light.worldU, light.worldV));  // of half edges; of a triangle's edges
  switch (light.type) {
    case LightType::areaRectangle:
      return std::sqrt(parallelogram);
    case LightType::areaTriangle:
      return std::sqrt(parallelogram / 8.0);
    case LightType::areaDisk:
    case LightType::areaSphere:
      return light.radius;
    default:
      return otherwise;
  }
}

struct Rectangle {
  dvec2 lower{std::numeric_limits<double>::infinity()}, upper{-std::numeric_limits<double>::infinity()};

  void add(const dvec2& p) {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
};

class Planner {
 public:
  Planner(const Scene& scene, const FlatScene& flat, const RenderSettings& settings, std::uint32_t layers)
      : scene_(scene),
        settings_(settings),
        maps_(settings.shadowMaps),
        layers_(layers),
        origin_(flat.origin),
        corners_(cornersOf(dvec3(flat.bounds.lower), dvec3(flat.bounds.upper))) {
    for (const dvec3& corner : corners_)
      reach_ = std::max({reach_, std::abs(corner.x), std::abs(corner.y), std::abs(corner.z)});
  }

  ShadowViews run() {
    for (const Light& light : scene_.lights) add(light);
    return std::move(result_);
  }

 private:
  // Texels that lookups may ask for beyond the place that they are about.
  double guard() const { return maps_.soft ? std::max(4.0, maps_.size / 16.0) : 0.5 * maps_.filterSize + 1.5; }
  // A map's half size where the part inside the guard has half size 1.
  double widened() const { return maps_.size / (maps_.size - 2.0 * guard()); }

  ShadowView viewAlong(const Axes& axes, const dvec3& origin) const {
    ShadowView view{};
    view.right = glm::vec3(axes.right);
    view.up = glm::vec3(axes.up);
    view.forward = glm::vec3(axes.forward);
    view.origin = glm::vec3(origin);
    view.reach = static_cast<float>(reach_ + std::max({std::abs(origin.x), std::abs(origin.y), std::abs(origin.z)}));
    view.guard = static_cast<float>(guard());
    view.size = maps_.size;
    view.layers = layers_;
    return view;
  }

  void push(ShadowView view) {
    view.firstTexel = static_cast<std::uint32_t>(result_.words);
    result_.words += std::uint64_t{maps_.size} * maps_.size * (layers_ > 1 ? 6 : 1);
    result_.views.push_back(view);
  }

  void add(const Light& light) {
    ShadowLight record{kShadowNone, static_cast<std::uint32_t>(result_.views.size()), 0,
                       static_cast<float>(halfSizeOf(light, maps_.lightRadius))};
    if (light.type == LightType::directional) {
      record.kind = kShadowCascades;
      addCascades(light);
    } else {
      addPerspective(light, record);
    }
    record.viewCount = static_cast<std::uint32_t>(result_.views.size()) - record.firstView;
    result_.lights.push_back(record);
  }

  static double halfAngle(const Light& light) {
    if (light.type != LightType::spot) return kPi;
    return light.classic ? light.classic->spotCutoff * kPi / 180.0 : double{light.outerConeAngle};
  }

  void addPerspective(const Light& light, ShadowLight& record) {
    const dvec3 origin = middleOf(light) - origin_;
    double farthest = 0;
    for (const dvec3& corner : corners_) farthest = std::max(farthest, glm::length(corner - origin));
    const bool cube = halfAngle(light) > kWidestSpot;
    record.kind = cube ? kShadowCube : kShadowSingle;
    const double half = (cube ? 1.0 : std::tan(std::max(halfAngle(light), 1e-3))) * widened();
    for (int face = 0; face < (cube ? 6 : 1); ++face) {
      dvec3 forward = light.worldDirection;
      if (cube) {
        forward = dvec3(0.0);
        forward[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
      }
      ShadowView view = viewAlong(axesOf(forward), origin);
      view.halfSize = glm::vec2(static_cast<float>(half));
      view.zNear = static_cast<float>(farthest * kHousing);
      push(view);
    }
  }

  // Corners of the part of the camera's view between two depths.
  std::array<dvec3, 8> slice(double nearDepth, double farDepth) const {
    const Camera& camera = scene_.cameras[static_cast<std::size_t>(settings_.camera)];
    const glm::dmat3 axes(camera.worldFromCamera);
    const double aspect = static_cast<double>(settings_.width) / settings_.height;
    const double halfY = camera.orthographic ? camera.yMag : std::tan(0.5 * camera.yFov);
    std::array<dvec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) {
      const double depth = i & 4 ? farDepth : nearDepth;
      const double scale = camera.orthographic ? 1.0 : depth;
      const dvec2 at((i & 1 ? halfY : -halfY) * aspect * scale, (i & 2 ? halfY : -halfY) * scale);
      corners[i] = glm::normalize(axes[0]) * at.x + glm::normalize(axes[1]) * at.y - glm::normalize(axes[2]) * depth;
    }
    return corners;
  }

  // Depths of the scene that the camera sees.
  dvec2 depthRange() const {
    const Camera& camera = scene_.cameras[static_cast<std::size_t>(settings_.camera)];
    const dvec3 forward = -glm::normalize(dvec3(camera.worldFromCamera[2]));
    dvec2 range(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
    for (const dvec3& corner : corners_) {
      range.x = std::min(range.x, glm::dot(corner, forward));
      range.y = std::max(range.y, glm::dot(corner, forward));
    }
    range.x = std::max(range.x, camera.zNear);
    if (camera.zFar) range.y = std::min(range.y, *camera.zFar);
    return range;
  }

  // Zhang, Sun, Xu, Lun 2006, "Parallel-Split Shadow Maps for Large-scale Virtual Environments", Eq. 5: the mean of
  // equal and of geometric steps.
  static double split(const dvec2& depths, double share) {
    const double equal = depths.x + (depths.y - depths.x) * share;
    const double geometric = depths.x * std::pow(depths.y / depths.x, share);
    return 0.5 * (equal + geometric);
  }

  Rectangle rectangleOf(const Axes& axes, const std::array<dvec3, 8>& corners) const {
    Rectangle rectangle;
    for (const dvec3& corner : corners) rectangle.add({glm::dot(corner, axes.right), glm::dot(corner, axes.up)});
    return rectangle;
  }

  void addCascades(const Light& light) {
    const Axes axes = axesOf(glm::normalize(light.worldDirection));
    dvec2 along(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
    for (const dvec3& corner : corners_) {
      along.x = std::min(along.x, glm::dot(corner, axes.forward));
      along.y = std::max(along.y, glm::dot(corner, axes.forward));
    }
    const Rectangle all = rectangleOf(axes, corners_);
    const dvec2 depths = depthRange();
    const std::uint32_t fitted = depths.x < depths.y ? maps_.cascades - 1 : 0;
    for (std::uint32_t i = 0; i < fitted; ++i) {
      const double from = split(depths, static_cast<double>(i) / maps_.cascades);
      Rectangle part = rectangleOf(axes, slice(from, split(depths, (i + 1.0) / maps_.cascades)));
      part.lower = glm::max(part.lower, all.lower);
      part.upper = glm::min(part.upper, all.upper);
      if (part.lower.x < part.upper.x && part.lower.y < part.upper.y) addCascade(axes, part, along);
    }
    addCascade(axes, all, along);
  }

  void addCascade(const Axes& axes, const Rectangle& part, const dvec2& along) {
    const dvec2 middle = 0.5 * (part.lower + part.upper);
    const double deep = std::max(along.y - along.x, reach_ * 1e-6);
    // Begins a little before the scene and ends a little behind it, so that rounding moves nothing out.
    const double before = along.x - deep / 64.0;
    ShadowView view = viewAlong(axes, axes.right * middle.x + axes.up * middle.y + axes.forward * before);
    view.orthographic = 1;
    view.zFar = static_cast<float>(deep * (1.0 + 1.0 / 32.0));
    // Square, so that a texel is.
    const dvec2 size = part.upper - part.lower;
    const double half = std::max(0.5 * std::max(size.x, size.y), reach_ * 1e-6) * widened();
    view.halfSize = glm::vec2(static_cast<float>(half));
    push(view);
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  const ShadowMapSettings& maps_;
  std::uint32_t layers_;
  dvec3 origin_;
  std::array<dvec3, 8> corners_;
  double reach_ = 0;
  ShadowViews result_;
};

}  // namespace

ShadowViews makeShadowViews(const Scene& scene, const FlatScene& flat, const RenderSettings& settings,
                            std::uint32_t layers) {
  return Planner(scene, flat, settings, layers).run();
}

}  // namespace crosslight
