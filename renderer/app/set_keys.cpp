#include "app/set_keys.h"

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
      {"hit-queues",
       {"auto", "on", "off"},
       "shade hits in queues, one per kind of surface, by kernels made for each; the image is the same",
       {Method::whitted},
       [](RenderSettings& s, std::size_t value) { s.hitQueues = static_cast<HitQueues>(value); }},
      {"raster-shadows",
       {"off", "rays"},
       "shadows of the raster methods: none, or exact ones by rays; where a method evaluates lighting",
       {Method::flat, Method::gouraud, Method::phong},
       [](RenderSettings& s, std::size_t value) {
         s.rasterShadows = value == 1 ? RasterShadows::rays : RasterShadows::off;
       }},
      {"msaa.shading",
       {"pixel", "sample"},
       "with --msaa: light each pixel's fragment once, or every coverage sample where it lies",
       {Method::wireframe, Method::flat, Method::gouraud, Method::phong},
       [](RenderSettings& s, std::size_t value) { s.shadesPerSample = value == 1; }},
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
      {"gouraud.clamp",
       offOn,
       "clamp vertex colors to 0..1 before interpolation, as fixed-function OpenGL does",
       {Method::gouraud, Method::flat},
       [](RenderSettings& s, std::size_t value) { s.clampVertexColors = value == 1; }},
  };
  return keys;
}

std::vector<std::string> allSetPairs() {
  std::vector<std::string> pairs;
  for (const SetKey& row : setKeys()) {
    for (const std::string& value : row.values) pairs.push_back(std::string(row.key) + "=" + value);
  }
  return pairs;
}

std::string setKeysExplained() {
  std::string text;
  for (const SetKey& row : setKeys()) {
    if (!text.empty()) text += "; ";
    text += std::string(row.key) + "=" + joined(row.values, "|") + " (" + row.meaning + ")";
  }
  return text;
}

const SetKey& applySet(const std::string& pair, RenderSettings& settings) {
  const std::size_t equals = pair.find('=');
  const std::string key = pair.substr(0, equals);
  std::vector<std::string> names;
  for (const SetKey& row : setKeys()) {
    names.push_back(row.key);
    if (key != row.key) continue;
    const std::string value = equals == std::string::npos ? "" : pair.substr(equals + 1);
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
