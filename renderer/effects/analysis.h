// What the files of rules share: the scene, who uses what in it, and the plan that they write. Internal to this room.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "effects/material_traits.h"
#include "effects/plan_draft.h"
#include "effects/uses.h"

namespace crosslight {

std::string quoted(const std::string& kind, const std::string& name, std::size_t index);

struct Analysis {
  Analysis(const Scene& s, const RenderSettings& set, InView inView);

  using MaterialTest = std::function<bool(const Material&)>;

  const Material& materialOf(const SurfaceUse& use) const;
  // First use in the picture whose material passes, one in view before others; null when none does.
  const SurfaceUse* firstUse(const MaterialTest& test) const;
  // "material 'glass' refracts (transmission 1, ior 1.5) on mesh 'ball', in view"
  std::string describe(const SurfaceUse& use, const std::string& what) const;
  // What is not called for: nobody would, or only what no ray meets.
  std::string nobody(const MaterialTest& test, const std::string& what) const;
  void addByMaterial(const MaterialRule& rule);
  // A row of a list of kinds: on if one of `objects` passes, named as `kind` and its name.
  template <typename Object, typename Test>
  void addFirst(std::uint32_t Plan::*bits, std::uint32_t value, const char* name, const char* kind,
                const std::vector<Object>& objects, const Test& test);

  const Scene& scene;
  const RenderSettings& settings;
  bool traced;
  std::vector<SurfaceUse> uses;
  PlanDraft draft;
  std::vector<LightVerdict> lightShadows;
};

template <typename Object, typename Test>
void Analysis::addFirst(std::uint32_t Plan::*bits, std::uint32_t value, const char* name, const char* kind,
                        const std::vector<Object>& objects, const Test& test) {
  const auto who = std::find_if(objects.begin(), objects.end(), test);
  const bool on = who != objects.end();
  const auto index = static_cast<std::size_t>(who - objects.begin());
  draft.addListed(bits, value, name, on,
                  on ? "used by " + quoted(kind, who->name, index) : "nothing in the scene uses it");
}

// In this order: later ones ask what earlier ones found.
void judgeSurfaces(Analysis& analysis);  // models, shapes, meshes, what materials call for by themselves
void judgeLights(Analysis& analysis);    // light types and their shadows
void judgeRays(Analysis& analysis);      // mirrored and refracted ones, bodies
void judgeAir(Analysis& analysis);       // environment, fog, smoke

}  // namespace crosslight
