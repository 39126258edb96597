// Classes of hits by what their surfaces ask for. The tracer queues the hits of a level by class and shades each class
// with a kernel made for it, so that no hit pays for effects that other surfaces use.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "effects/effects.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace crosslight {

struct HitClass {
  Plan plan;        // what is left of the scene's plan
  bool lit = true;  // its surfaces show direct light: shadow rays are worth sending

  bool operator==(const HitClass& other) const;
};

struct HitClasses {
  std::vector<HitClass> classes;  // at most kHitClasses
  // Per material: its class as a mesh's (x) and as an analytic shape's (y); kHitClasses where it has none.
  std::vector<glm::uvec4> ofMaterial;

  bool operator==(const HitClasses&) const = default;
};

// Without classes where they do not pay: a single one without shadows to save, a picture of few rays
// (HitQueues::automatic), all effects asked for.
HitClasses classifyHits(const Scene& scene, const Plan& plan, const RenderSettings& settings);

}  // namespace crosslight
