// Which effects a scene calls for, each with its reason, and the plan that follows: specialisation constants. Pure
// functions of scene and settings. Leaving out what is off changes no bit of the image (a test holds that).
#pragma once

#include <string>
#include <vector>

#include "bindings.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace crosslight {

// In Plan::effects.
constexpr std::uint64_t bitOf(Effect effect) { return std::uint64_t{1} << static_cast<std::uint32_t>(effect); }

struct EffectVerdict {
  std::string name;  // "phong" (a model), "point" (a light), "sphere" (a shape), or a row of CL_EFFECTS
  bool on = false;
  std::string reason;    // names the object that calls for it, or says that none does
  bool leftOut = false;  // called for, and off because asked: the image is not the scene's
  double bound = 0.0;    // linear radiance that leaving it out changes a pixel by at most; of --effects within=E
};

// Whether one light needs shadow rays, when the effect `shadows` is on.
struct LightVerdict {
  std::string name;
  bool shadows = true;
  std::string reason;
};

// Bits as in the lists of shaders/shared/.
struct Plan {
  std::uint32_t models = 0;
  std::uint32_t lights = 0;
  std::uint32_t shapes = 0;
  std::uint64_t effects = 0;
  std::vector<EffectVerdict> verdicts;
  std::vector<LightVerdict> lightShadows;  // per light of the scene; empty: no shadows, or of all lights
  std::uint32_t maxDepth = 0;              // of rays: what was asked for, or as much of it as the scene can use
  std::string depthReason;
  double bound = 0.0;  // sum of the bounds of what was left out by --effects within=E

  bool has(Effect effect) const { return (effects & bitOf(effect)) != 0; }
};

// Whether a raster method asks for its shadows by rays: then the scene needs trees.
bool rasterSendsRays(const Plan& plan, const RenderSettings& settings);

// What counts as in view: what the settings' camera sees, or all, for a camera that turns after the plan is made.
enum class InView { ofCamera, all };

Plan makePlan(const Scene& scene, const RenderSettings& settings, InView inView = InView::ofCamera);

// It has a surface of its own that radiates.
bool isArea(const Light& light);

}  // namespace crosslight
