// How the mirrors of a scene get their image in raster methods: which are flat, which share a plane, and where probes
// stand. Plain data.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/settings.h"
#include "upload/flatten.h"

namespace crosslight {

// Drawn by a camera that is turned over at the plane; render space.
struct MirrorPlane {
  glm::dvec3 normal{0.0};  // unit, towards the camera
  double offset = 0;       // normal . p of its points; negative, since the camera is the origin
  double margin = 0;       // scene units: it is flat, and its coordinates are exact, but for so much
  double area = 0;
};

// A cube map from the middle of a mesh instance.
struct ProbePlace {
  glm::dvec3 center{0.0};  // render space
  std::uint32_t instanceId = 0;
  double area = 0;
};

struct ReflectorPlan {
  std::vector<MirrorPlane> planes;  // at most kMostPlanes
  std::vector<ProbePlace> probes;   // at most kMostProbes
  // Of each draw: an index into planes, or into probes. Neither: it is no mirror, or one that is left out.
  struct Choice {
    std::optional<std::size_t> plane, probe;
  };
  std::vector<Choice> ofDraw;
  std::size_t leftOut = 0;  // mirrors beyond these numbers, the smallest: they show the background
};

inline constexpr std::size_t kMostPlanes = 4, kMostProbes = 4;

// `orthographicView`: the way that an orthographic camera looks, whose position says nothing of the side that it sees.
ReflectorPlan planReflectors(const FlatScene& flat, const Scene& scene, const RenderSettings& settings,
                             const std::optional<glm::dvec3>& orthographicView);

}  // namespace crosslight
