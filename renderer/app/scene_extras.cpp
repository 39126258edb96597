#include "app/scene_extras.h"

#include <fmt/format.h>

#include <cmath>

#include "app/set_keys.h"
#include "base/error.h"
#include "base/log.h"
#include "image/image_io.h"
#include "scene/emissive_lights.h"

namespace crosslight {
namespace {

void dropHeadlight(Scene& scene) {
  if (!scene.defaultLight) return;
  scene.lights.erase(scene.lights.begin());
  scene.defaultLight = false;
}

void addEmissive(Scene& scene, EmissiveLights emissive) {
  const bool wanted = emissive == EmissiveLights::on ||
                      (emissive == EmissiveLights::automatic && (scene.defaultLight || scene.lights.empty()));
  if (!wanted) return;
  const std::size_t added = addEmissiveLights(scene);
  if (added > 0) dropHeadlight(scene);
}

}  // namespace

std::shared_ptr<const EnvironmentMap> readEnvironment(const std::filesystem::path& file) {
  const Image image = readImage(file);
  auto map = std::make_shared<EnvironmentMap>();
  map->width = image.width;
  map->height = image.height;
  map->radiance.resize(image.pixels());
  const PixelReader read(image, image.picture());
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    float rgba[4];
    read(i, rgba);
    for (int c = 0; c < 3; ++c) {
      if (!(rgba[c] >= 0.0f) || !std::isfinite(rgba[c])) {
        throw InputError(file.string(), fmt::format("pixel ({}, {}) is {:g}, which is no radiance: an environment must "
                                                    "be finite and not negative",
                                                    i % image.width, i / image.width, rgba[c]));
      }
    }
    map->radiance[i] = {rgba[0], rgba[1], rgba[2]};
  }
  if (map->width != 2 * map->height) {
    logWarning(fmt::format("{}: is {} x {}; equirectangular pictures are twice as wide as high, it is stretched",
                           file.string(), map->width, map->height));
  }
  return map;
}

void completeScene(Scene& scene, EmissiveLights emissive) {
  Environment& environment = scene.atmosphere.environment;
  if (!environment.file.empty() && !environment.present()) environment.map = readEnvironment(environment.file);
  if (environment.present()) dropHeadlight(scene);
  addEmissive(scene, emissive);
}

void completeScene(Scene& scene, const RenderOptions& options) {
  Environment& environment = scene.atmosphere.environment;
  if (!options.environment.empty()) environment = {options.environment, 1.0, 0.0, environment.map};
  RenderSettings settings;
  for (const std::string& pair : options.set) applySet(pair, settings);
  completeScene(scene, settings.emissiveLights);
}

}  // namespace crosslight
