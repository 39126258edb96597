// The options of `crosslight render`: declared, checked, and turned into the settings of a render.
#pragma once

#include <string>
#include <vector>

#include "accel/bvh_cache.h"
#include "app/device_choice.h"
#include "image/image_io.h"
#include "scene/load.h"
#include "scene/settings.h"

namespace crosslight {

class CommandLine;

// As on the command line.
struct RenderOptions {
  std::string scene;
  std::string output;
  std::string method = "phong";
  std::string resolution = "512x512";
  std::string camera;
  std::string sceneName;
  double timeSeconds = 0;
  bool timeGiven = false;
  std::string animation;
  double turnDegrees = 0;
  std::uint32_t spp = 1;
  std::string filter = "box";
  std::string sampler = "sobol";
  double adaptive = 0;
  std::string msaa = "1";
  bool msaaGiven = false;
  std::uint32_t maxDepth = 5;
  bool maxDepthGiven = false;
  std::uint64_t seed = 0;
  std::string kernel = "auto";
  bool kernelGiven = false;
  std::string instances = "auto";
  bool instancesGiven = false;
  std::string bvhCache = "auto";
  bool bvhCacheGiven = false;
  std::string lighting = "standard";
  std::vector<std::string> set;
  std::string environment;
  std::string effects = "auto";
  std::string aovs;
  double exposureStops = 0;
  std::string toneMap = "clamp";
  bool alpha = false;
  bool allowNonfinite = false;
  std::string json;
  std::string rayTree;
  std::string progress = "auto";
  DeviceChoice device;
  bool listDevices = false;
  // More or less than one picture.
  std::string frames;
  double framesPerSecond = 24;
  std::uint32_t turntable = 0;  // frames of a whole turn; 0: none
  std::string part;
  std::string batch;
  bool stopOnError = false;
};

// --exposure and --tone-map.
void addDisplayOptions(CommandLine& line, CLI::App& command, double& exposureStops, std::string& toneMap);
ToneMap toneMapOf(const std::string& name);

// Method, resolution, camera and all else that says what is drawn; of sampling what the image hangs on.
void addPictureOptions(CommandLine& line, CLI::App& command, RenderOptions& options);
void addDepthOption(CommandLine& line, CLI::App& command, RenderOptions& options);

void addRenderOptions(CommandLine& line, CLI::App& command, RenderOptions& options);

// UsageError on what cannot be meant; a warning on options that the method does not heed. The camera is left at 0: its
// name needs the scene.
RenderSettings checkedSettings(const RenderOptions& options);
DisplayTransform checkedDisplay(const RenderOptions& options);
// Where --bvh-cache keeps trees.
BvhCache bvhCacheOf(const RenderOptions& options);
// How finely displaced meshes are split; with what it hangs on, where that is the view.
DisplacementOptions displacementOf(const RenderOptions& options);
LoadOptions loadOptionsOf(const RenderOptions& options);

// "640x480"; UsageError with the rule otherwise.
struct Resolution {
  std::uint32_t width;
  std::uint32_t height;
};
Resolution resolutionOf(const std::string& text);

// "depth,normal" or "all", in the order of kAovNames, each once.
std::vector<std::string> aovsOf(const std::string& list);

}  // namespace crosslight
