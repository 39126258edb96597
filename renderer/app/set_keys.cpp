#include "app/set_keys.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>

#include "app/render_job.h"
#include "app/suggest.h"
#include "base/error.h"

namespace crosslight {
const std::vector<SetKey>& setKeys() {
  static const std::vector<std::string> onOff = {"on", "off"};
  static const std::vector<std::string> offOn = {"off", "on"};
  static const std::vector<SetKey> keys = {
      {"shadows",
       onOff,
       "shadow rays to every light",
       {Method::whitted},
       [](RenderSettings& s, std::size_t value) { s.shadows = value == 0; }},
      {"reflection",
       onOff,
       "mirror rays",
       {Method::whitted},
       [](RenderSettings& s, std::size_t value) { s.reflection = value == 0; }},
      {"refraction",
       onOff,
       "refracted rays; off lets transmitted light go straight on",
       {Method::whitted},
       [](RenderSettings& s, std::size_t value) { s.refraction = value == 0; }},
      {"colored-shadows",
       offOn,
       "light that transparent things let pass takes on their color",
       {Method::whitted},
       [](RenderSettings& s, std::size_t value) { s.coloredShadows = value == 1; }},
      {"dispersion",
       {"off", "rgb"},
       "refracted rays of bodies with KHR_materials_dispersion: one, or three for red, green and blue",
       {Method::whitted},
       [](RenderSettings& s, std::size_t value) { s.dispersion = static_cast<Dispersion>(value); }},
      {"smoke-steps",
       {"32", "8", "16", "64", "128", "256"},
       "along the part of a ray that lies in smoke",
       {},
       [](RenderSettings& s, std::size_t value) {
         constexpr std::uint32_t kSteps[] = {32, 8, 16, 64, 128, 256};
         s.smokeSteps = kSteps[value];
       }},
      {"hit-queues",
       {"auto", "on", "off"},
       "shade hits in queues, one per kind of surface, by kernels made for each; the image is the same",
       {Method::whitted},
       [](RenderSettings& s, std::size_t value) { s.hitQueues = static_cast<HitQueues>(value); }},
      {"raster-shadows",
       {"off", "maps", "rays"},
       "shadows of the raster methods: none, from depth maps, or exact ones by rays; where a method evaluates lighting",
       {Method::flat, Method::gouraud, Method::phong},
       [](RenderSettings& s, std::size_t value) { s.rasterShadows = static_cast<RasterShadows>(value); }},
      {"shadow-map-size",
       {"1024", "256", "512", "2048", "4096"},
       "texels a side of each shadow map: a spot's, a cube's face, a cascade",
       {Method::flat, Method::gouraud, Method::phong},
       [](RenderSettings& s, std::size_t value) {
         constexpr std::uint32_t kSizes[] = {1024, 256, 512, 2048, 4096};
         s.shadowMaps.size = kSizes[value];
       }},
      {"shadow-filter",
       {"3", "1", "5", "soft"},
       "texels a side that a shadow map's lookup averages; soft: as wide as light-radius makes the penumbra",
       {Method::flat, Method::gouraud, Method::phong},
       [](RenderSettings& s, std::size_t value) {
         constexpr std::uint32_t kSizes[] = {3, 1, 5, 3};
         s.shadowMaps.filterSize = kSizes[value];
         s.shadowMaps.soft = value == 3;
       }},
      {"shadow-cascades",
       {"3", "1", "2", "4"},
       "shadow maps of a directional light, from the camera on",
       {Method::flat, Method::gouraud, Method::phong},
       [](RenderSettings& s, std::size_t value) {
         constexpr std::uint32_t kCounts[] = {3, 1, 2, 4};
         s.shadowMaps.cascades = kCounts[value];
       }},
      {"light-radius",
       {},
       "of lights that have no size, for shadow-filter=soft: scene units, of directional lights radians",
       {Method::flat, Method::gouraud, Method::phong},
       nullptr,
       {0, 0, 1e30, false, [](RenderSettings& s, double value) { s.shadowMaps.lightRadius = value; }}},
      {"raster-reflections",
       {"off", "environment", "probes", "mirrors"},
       "mirrors of the raster methods, one reflection deep: none, the background alone, cube maps from each mirror's "
       "middle, or flat mirrors exactly and others by cube maps",
       {Method::flat, Method::gouraud, Method::phong},
       [](RenderSettings& s, std::size_t value) { s.rasterReflections = static_cast<RasterReflections>(value); }},
      {"probe-size",
       {},
       "pixels along an edge of such a cube map",
       {Method::flat, Method::gouraud, Method::phong},
       nullptr,
       {256, 16, 4096, true, [](RenderSettings& s, double value) { s.probeSize = static_cast<std::uint32_t>(value); }}},
      {"msaa.shading",
       {"pixel", "sample"},
       "with --msaa: light each pixel's fragment once, or every coverage sample where it lies",
       {Method::wireframe, Method::flat, Method::gouraud, Method::phong},
       [](RenderSettings& s, std::size_t value) { s.shadesPerSample = value == 1; }},
      {"light-samples",
       {},
       "shadow rays to each light with an area and into the environment; 0 sends one to the light's middle",
       {Method::whitted},
       nullptr,
       {16, 0, 4096, true,
        [](RenderSettings& s, double value) { s.lightSamples = static_cast<std::uint32_t>(value); }}},
      {"emissive-lights",
       {"off", "on", "auto"},
       "surfaces that glow light others; auto: where the file has no lights",
       {},
       [](RenderSettings& s, std::size_t value) { s.emissiveLights = static_cast<EmissiveLights>(value); }},
      {"environment-rotation",
       {},
       "degrees about +Y, counter-clockwise from above, added to the scene's",
       {},
       nullptr,
       {0, -360, 360, false, [](RenderSettings& s, double value) { s.environmentRotation = value; }}},
      {"environment-intensity",
       {},
       "multiplies the scene's",
       {},
       nullptr,
       {1, 0, 1e6, false, [](RenderSettings& s, double value) { s.environmentIntensity = value; }}},
      {"depth-prepass",
       {"auto", "on", "off"},
       "draw depth alone first, so that hidden surfaces are not lit; the image is the same",
       {Method::phong},
       [](RenderSettings& s, std::size_t value) { s.depthPrepass = static_cast<DepthPrepass>(value); }},
      {"flat.vertex",
       {"first", "last", "centroid"},
       "where on a triangle flat shading is evaluated",
       {Method::flat},
       [](RenderSettings& s, std::size_t value) { s.flatVertex = static_cast<FlatVertex>(value); }},
      {"wireframe.hidden",
       offOn,
       "draw hidden edges too",
       {Method::wireframe},
       [](RenderSettings& s, std::size_t value) { s.hiddenLines = value == 1; }},
      {"viewer",
       {"local", "infinite"},
       "the direction to the viewer: from each point, or one for all",
       {},
       [](RenderSettings& s, std::size_t value) { s.infiniteViewer = value == 1; }},
      {"fog-distance",
       {"ray", "depth"},
       "fog by the way that the light takes, over the background too, or by eye depth and without it, as OpenGL",
       {},
       [](RenderSettings& s, std::size_t value) { s.fogDistance = static_cast<FogDistance>(value); }},
      {"two-sided",
       {"material", "always"},
       "which surfaces have two sides",
       {},
       [](RenderSettings& s, std::size_t value) { s.twoSided = static_cast<TwoSided>(value); }},
      {"fresnel",
       {"model", "schlick", "exact"},
       "reflectance against angle: as each model has it, by Schlick's fit, or by Fresnel's equations",
       {},
       [](RenderSettings& s, std::size_t value) { s.fresnel = static_cast<Fresnel>(value); }},
      {"energy-compensation",
       offOn,
       "give rough metallic-roughness surfaces the light back that repeated scattering on their facets would bring",
       {},
       [](RenderSettings& s, std::size_t value) { s.energyCompensation = value == 1; }},
      {"displacement-level",
       {},
       "how finely displaced meshes are split: every edge into 2^n",
       {},
       nullptr,
       {4, 0, 8, true,
        [](RenderSettings& s, double value) { s.displacementLevel = static_cast<std::uint32_t>(value); }}},
      {"displacement-edge",
       {},
       "instead of a level: edges of displaced meshes are split until none is longer on the screen, in pixels; 0: off",
       {},
       nullptr,
       {0, 0, 4096, false, [](RenderSettings& s, double value) { s.displacementEdge = static_cast<float>(value); }}},
      {"gouraud.clamp",
       offOn,
       "clamp vertex colors to 0..1 before interpolation, as fixed-function OpenGL does",
       {Method::gouraud, Method::flat},
       [](RenderSettings& s, std::size_t value) { s.clampVertexColors = value == 1; }},
  };
  return keys;
}

namespace {

// "on|off", or "N from 0 to 4096".
std::string valuesOf(const SetKey& row) {
  if (!row.values.empty()) return joined(row.values, "|");
  return fmt::format("N from {:g} to {:g}", row.number.lowest, row.number.highest);
}

void applyNumber(const SetKey& row, const std::string& text, RenderSettings& settings) {
  const SetKey::Number& n = row.number;
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool fits =
      error == std::errc{} && stop == text.data() + text.size() && value >= n.lowest && value <= n.highest;
  if (!fits || (n.whole && value != std::floor(value))) {
    throw UsageError(fmt::format("--set {}: '{}' is no {}number from {:g} to {:g}", row.key, text,
                                 n.whole ? "whole " : "", n.lowest, n.highest));
  }
  n.apply(settings, value);
}

}  // namespace

std::vector<std::string> allSetPairs() {
  std::vector<std::string> pairs;
  for (const SetKey& row : setKeys()) {
    if (row.values.empty()) pairs.push_back(fmt::format("{}={:g}", row.key, row.number.fallback));
    for (const std::string& value : row.values) pairs.push_back(std::string(row.key) + "=" + value);
  }
  return pairs;
}

std::vector<KeyModel> setKeysExplained() {
  std::vector<KeyModel> keys;
  for (const SetKey& row : setKeys()) {
    std::vector<std::string> methods;
    for (const Method method : row.methods) methods.emplace_back(nameOf(method));
    std::string meaning = row.meaning;
    meaning[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(meaning[0])));
    if (row.values.empty()) meaning += fmt::format("; default: {:g}", row.number.fallback);
    keys.push_back({fmt::format("{}={}", row.key, valuesOf(row)), std::move(meaning), joined(methods, ", ")});
  }
  return keys;
}

const SetKey& applySet(const std::string& pair, RenderSettings& settings) {
  const std::size_t equals = pair.find('=');
  const std::string key = pair.substr(0, equals);
  std::vector<std::string> names;
  for (const SetKey& row : setKeys()) {
    names.push_back(row.key);
    if (key != row.key) continue;
    const std::string value = equals == std::string::npos ? "" : pair.substr(equals + 1);
    if (row.values.empty()) {
      applyNumber(row, value, settings);
      return row;
    }
    for (std::size_t i = 0; i < row.values.size(); ++i) {
      if (value != row.values[i]) continue;
      row.apply(settings, i);
      return row;
    }
    if (value.empty()) throw UsageError("--set " + key + ": a value is missing; there are " + joined(row.values, ", "));
    throw UsageError("--set " + key + ": " + unknownWord("value", value, row.values));
  }
  throw UsageError("--set: " + unknownWord("key", key, names));
}

}  // namespace crosslight
