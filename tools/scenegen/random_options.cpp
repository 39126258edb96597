#include "scenegen/dice.h"
#include "scenegen/random_scene.h"

namespace crosslight::scenegen {
namespace {

// Scenes and their options are drawn apart: a scene stays the same when an option is added.
constexpr std::uint64_t kOfStyles = 0x5354594c45u, kOfOptions = 0x4f5054494f4eu;

class Words {
 public:
  void add(const std::string& option, const std::string& value) {
    words_.push_back("--" + option);
    words_.push_back(value);
  }
  void set(const std::string& key, const std::string& value) { add("set", key + "=" + value); }
  void add(const std::vector<std::string>& more) { words_.insert(words_.end(), more.begin(), more.end()); }
  std::vector<std::string> take() { return std::move(words_); }

 private:
  std::vector<std::string> words_;
};

using Text = const char*;

std::vector<std::string> rasterStyle(Dice& dice) {
  Words words;
  words.add("msaa", dice.pick<Text>({"1", "1", "1", "1", "4"}));  // every device has these
  if (dice.oneIn(3)) words.set("msaa.shading", "sample");
  const std::string shadows = dice.pick<Text>({"off", "maps", "rays"});
  words.set("raster-shadows", shadows);
  if (shadows == "maps") {
    words.set("shadow-map-size", "256");
    words.set("shadow-filter", dice.pick<Text>({"1", "3", "5", "soft"}));
    words.set("shadow-cascades", dice.pick<Text>({"1", "2"}));
    words.set("light-radius", dice.pick<Text>({"0", "0.1"}));
  }
  words.set("raster-reflections",
            dice.pick<Text>({"off", "off", "off", "off", "off", "environment", "probes", "mirrors"}));
  words.set("probe-size", "16");
  words.set("flat.vertex", dice.pick<Text>({"first", "last", "centroid"}));
  words.set("gouraud.clamp", dice.pick<Text>({"off", "off", "on"}));
  if (dice.oneIn(8)) words.add("lighting", "opengl");
  return words.take();
}

void addOfRays(Dice& dice, Words& words) {
  words.add("max-depth", dice.pick<Text>({"0", "1", "3", "5"}));
  for (const char* key : {"shadows", "reflection", "refraction"}) {
    if (dice.oneIn(8)) words.set(key, "off");
  }
  if (dice.oneIn(3)) words.set("colored-shadows", "on");
  if (dice.oneIn(3)) words.set("dispersion", "rgb");
  words.set("light-samples", dice.pick<Text>({"0", "1", "4"}));
}

void addOfAll(Dice& dice, Words& words) {
  words.add("spp", dice.pick<Text>({"1", "1", "2"}));
  words.add("filter", dice.pick<Text>({"box", "tent", "gaussian", "mitchell"}));
  words.add("sampler", dice.pick<Text>({"sobol", "regular", "jittered"}));
  words.add("seed", dice.pick<Text>({"0", "7"}));
  words.set("fresnel", dice.pick<Text>({"model", "model", "schlick", "exact"}));
  words.set("energy-compensation", dice.pick<Text>({"off", "on"}));
  words.set("viewer", dice.pick<Text>({"local", "local", "infinite"}));
  words.set("fog-distance", dice.pick<Text>({"ray", "depth"}));
  words.set("two-sided", dice.pick<Text>({"material", "material", "always"}));
  words.set("emissive-lights", dice.pick<Text>({"off", "off", "on"}));
  words.set("environment-rotation", dice.pick<Text>({"0", "40"}));
  words.set("smoke-steps", "8");
  words.set("displacement-level", "1");
}

}  // namespace

RandomStyle randomStyle(std::uint64_t seed) {
  Dice dice(seed ^ kOfStyles);
  RandomStyle style;
  style.orthographic = dice.oneIn(5);
  style.manyLights = dice.oneIn(12);
  style.ofRaster = rasterStyle(dice);
  style.ofRays = {"--instances", dice.pick<Text>({"auto", "auto", "share"})};
  if (dice.oneIn(10)) {
    for (auto* words : {&style.ofRaster, &style.ofRays}) words->insert(words->end(), {"--aov", "all"});
  }
  return style;
}

std::vector<std::string> randomOptions(std::uint64_t seed, const RandomStyle& style, const std::string& method) {
  Dice dice(seed ^ kOfOptions);
  Words words;
  words.add("method", method);
  words.add("resolution", "24x18");
  addOfAll(dice, words);
  if (method == "whitted") {
    words.add(style.ofRays);
    addOfRays(dice, words);
  } else {
    words.add(style.ofRaster);
    if (dice.oneIn(3)) words.set("depth-prepass", dice.pick<Text>({"on", "off"}));
  }
  return words.take();
}

}  // namespace crosslight::scenegen
