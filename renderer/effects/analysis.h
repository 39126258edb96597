// What the files of rules share: the scene, who uses what in it, and the plan that they write. Internal to this room.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "effects/material_traits.h"
#include "effects/plan_draft.h"
#include "effects/uses.h"

namespace crosslight {

struct Analysis {
  Analysis(const Scene& s, const RenderSettings& set);

  using MaterialTest = std::function<bool(const Material&)>;

  const Material& materialOf(const SurfaceUse& use) const;
  // First use in the picture whose material passes, one in view before others; null when none does.
  const SurfaceUse* firstUse(const MaterialTest& test) const;
  // "material 'glass' refracts (transmission 1, ior 1.5) on mesh 'ball', in view"
  std::string describe(const SurfaceUse& use, const std::string& what) const;
  // What is not called for: nobody would, or only what no ray meets.
  std::string nobody(const MaterialTest& test, const std::string& what) const;
  void addByMaterial(const MaterialRule& rule);

  const Scene& scene;
  const RenderSettings& settings;
  bool traced;
  std::vector<SurfaceUse> uses;
  PlanDraft draft;
  std::vector<LightVerdict> lightShadows;
};

std::string quoted(const std::string& kind, const std::string& name, std::size_t index);

// In this order: later ones ask what earlier ones found.
void judgeSurfaces(Analysis& analysis);  // models, shapes, meshes, what materials call for by themselves
void judgeLights(Analysis& analysis);    // light types and their shadows
void judgeRays(Analysis& analysis);      // mirrored and refracted ones, bodies
void judgeAir(Analysis& analysis);       // environment, fog, smoke

}  // namespace crosslight
