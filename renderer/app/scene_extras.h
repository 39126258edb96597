// What a scene has beside its file: the environment's picture, and lights that its glowing surfaces are.
#pragma once

#include "app/render_options.h"
#include "scene/scene.h"

namespace crosslight {

// Equirectangular radiance from .hdr, .exr, .pfm or .png. InputError on what is no radiance.
std::shared_ptr<const EnvironmentMap> readEnvironment(const std::filesystem::path& file);

// Reads the map that the scene names, if any, and adds lights as `emissive` says. The headlight of a file without
// lights goes where one of these lights the scene.
void completeScene(Scene& scene, EmissiveLights emissive = EmissiveLights::off);

// The same for a picture's options: --environment instead of the scene's own.
void completeScene(Scene& scene, const RenderOptions& options);

}  // namespace crosslight
