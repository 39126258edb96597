#include "app/render_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "app/command_line.h"
#include "app/effects_option.h"
#include "app/frame_plan.h"
#include "app/lighting_preset.h"
#include "app/part.h"
#include "app/picture_samples.h"
#include "app/progress.h"
#include "app/render_job.h"
#include "app/set_keys.h"
#include "app/suggest.h"
#include "base/log.h"
#include "film/adaptive_tiles.h"
#include "trace/kernels.h"

namespace crosslight {
namespace {

constexpr std::uint32_t kMostPixelsPerSide = 65536;  // no device draws more; memory ends long before
constexpr std::uint32_t kMostSamples = 1u << 20;     // the film counts samples exactly in a float up to 2^24
constexpr std::uint32_t kMostDepth = 64;             // a ray tree doubles per level: beyond, only mirrors halls differ
constexpr double kMostDegrees = 360000;              // a thousand turns
constexpr double kMostRadiance = 1e6;                // an error above it stops at once
constexpr double kMostStops = 64;                    // 2^64 takes any float radiance that matters to black or white

const std::vector<std::string> kFilters = {"box", "tent", "gaussian", "mitchell"};
const std::vector<std::string> kSamplers = {"sobol", "regular", "jittered"};
const std::vector<std::string> kLightings = {"standard", "opengl"};
const std::vector<std::string> kToneMaps = {"none", "clamp", "reinhard", "neutral"};
const std::vector<std::string> kInstanceModes = {"auto", "flatten", "share"};
const std::vector<std::string> kMsaaCounts = {"1", "2", "4", "8"};

std::vector<std::string> methodNames() {
  std::vector<std::string> names;
  for (const Method method : allMethods()) names.push_back(nameOf(method));
  return names;
}

std::vector<std::string> aovNames() { return {std::begin(kAovNames), std::end(kAovNames)}; }

std::size_t indexIn(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

void warnUnheeded(const std::string& what, const RenderOptions& options) {
  logWarning(what + " has no effect on the method " + options.method);
}

// Whether an option was given, which its value cannot tell.
void noteGiven(CLI::Option* option, bool& given) {
  option->each([&given](const std::string&) { given = true; });
}

void addSamplingOptions(CommandLine& line, CLI::App& command, RenderOptions& o) {
  line.whole(command, "--spp", o.spp, "N", 1, kMostSamples,
             "Samples per pixel, at the same places for raster and rays; 1 is the pixel's center")
      ->group("Sampling");
  line.choice(command, "--filter", o.filter, kFilters, "How samples are weighted into a pixel")->group("Sampling");
  line.choice(
          command, "--sampler", o.sampler, kSamplers,
          "Where samples lie within a pixel: a low-discrepancy sequence, a grid, or anywhere in each cell of a grid")
      ->group("Sampling");
  line.number(command, "--adaptive", o.adaptive, "ERROR", 0, kMostRadiance,
              "Give tiles of 8x8 pixels no more samples once the standard error of every mean in and beside them is "
              "below this, linear; --spp is then the most; 0: --spp for all")
      ->group("Sampling");
  noteGiven(line.choice(command, "--msaa", o.msaa, kMsaaCounts, "Coverage samples per sample of a raster method")
                ->group("Sampling"),
            o.msaaGiven);
  addDepthOption(line, command, o);
  line.whole(command, "--seed", o.seed, "N", 0, std::numeric_limits<std::uint64_t>::max(),
             "Seed of all random numbers; the same seed gives the same bits")
      ->group("Sampling");
  noteGiven(line.choice(command, "--kernel", o.kernel, kernelFamilyNames(),
                        "Ray kernels (whitted): one ray per invocation, or packets; all make the same image")
                ->group("Sampling"),
            o.kernelGiven);
  noteGiven(
      line.choice(command, "--instances", o.instances, kInstanceModes,
                  "Trees of rays (whitted): one over all triangles, or one per mesh that its instances share; all "
                  "make the same image")
          ->group("Sampling"),
      o.instancesGiven);
  noteGiven(line.text(command, "--bvh-cache", o.bvhCache, "DIR|auto|off",
                      "Keep trees of rays (whitted) of large scenes in this folder, 4 GiB at most; auto: in "
                      "$XDG_CACHE_HOME/crosslight/bvh")
                ->group("Sampling"),
            o.bvhCacheGiven);
}

void addOutputOptions(CommandLine& line, CLI::App& command, RenderOptions& o) {
  line.text(command, "-o,--output", o.output, "OUT",
            "The image file; its extension .png, .exr, .hdr or .pfm decides the format", ValueKind::file)
      ->group("Output");
  line.text(command, "--aov", o.aovs, "LIST",
            "Layers beside the picture, with commas between, or 'all': " + joined(aovNames(), ", ") + ". Needs .exr")
      ->group("Output");
  addDisplayOptions(line, command, o.exposureStops, o.toneMap);
  line.flag(command, "--alpha", o.alpha, "PNG with the coverage as its alpha channel")->group("Output");
  line.flag(command, "--allow-nonfinite", o.allowNonfinite,
            "Write the image even when it holds NaN or infinity, which else ends with exit code 5")
      ->group("Output");
  line.text(command, "--json", o.json, "FILE|-", "Write a JSON record of all that was measured; '-' is standard output",
            ValueKind::file)
      ->group("Output");
  line.text(command, "--ray-tree", o.rayTree, "X,Y",
            "Write the ray tree of this pixel (whitted), counted from the upper left one, 0,0, beside the picture: "
            "OUT.tree.json and a drawing, OUT.tree.svg")
      ->group("Output");
}

void addManyOptions(CommandLine& line, CLI::App& command, RenderOptions& o) {
  line.text(command, "--frames", o.frames, "N|A-B",
            "Draw frames 0 to N-1, or A to B, of the animations; OUT has a run of '#' for the number, or is a video "
            "(.mp4, .mkv, .webm, .gif; needs ffmpeg)")
      ->group("Many pictures");
  line.number(command, "--fps", o.framesPerSecond, "RATE", kSlowest, kFastest, "Frames per second")
      ->group("Many pictures");
  line.whole(command, "--turntable", o.turntable, "N", 0, kMostFrames,
             "Turn the camera once about the scene in N frames, as --turn does; 0 does not")
      ->group("Many pictures");
  line.text(command, "--part", o.part, "I/N",
            "Draw the I-th of N shares of the rows into a .clpart file, for 'crosslight merge'")
      ->group("Many pictures");
  line.text(command, "--batch", o.batch, "FILE|-",
            "Draw every item of a JSON array or of JSON lines: objects with 'scene', 'output' and any option of this "
            "command by its long name ('scene-name' for --scene); options given here hold for all items",
            ValueKind::file)
      ->group("Many pictures");
  line.flag(command, "--stop-on-error", o.stopOnError, "Leave a batch at its first item that fails")
      ->group("Many pictures");
}

}  // namespace

void addPictureOptions(CommandLine& line, CLI::App& command, RenderOptions& o) {
  line.choice(command, "-m,--method", o.method, methodNames(), "How the image is made")->group("Picture");
  line.text(command, "-r,--resolution", o.resolution, "WxH", "Size in pixels, 1 to 65536 each")->group("Picture");
  line.text(command, "--camera", o.camera, "NAME|N", "The camera, by name or number; without it the first")
      ->group("Picture");
  line.text(command, "--scene", o.sceneName, "NAME|N", "The scene of the file; without it the file's default")
      ->group("Picture");
  noteGiven(line.number(command, "--time", o.timeSeconds, "SECONDS", 0, 1e9,
                        "Evaluate animations at this time; without it nodes stay in their rest pose")
                ->default_str("")
                ->group("Picture"),
            o.timeGiven);
  line.text(command, "--animation", o.animation, "NAME|N", "Evaluate this animation only; without it all of the file")
      ->group("Picture");
  line.number(command, "--turn", o.turnDegrees, "DEGREES", -kMostDegrees, kMostDegrees,
              "Turn the camera about the vertical through the scene's middle, counter-clockwise from above")
      ->group("Picture");
  line.choice(
          command, "--lighting", o.lighting, kLightings,
          "opengl: as the fixed function of OpenGL 1.x, whose parameters the scene may carry: vertex colors clamped "
          "before interpolation, flat shading from the last vertex, an infinite viewer, fog by depth; --set changes "
          "single ones of these")
      ->group("Picture");
  line.list(command, "--set", o.set, "KEY=VALUE",
            "Change how things are drawn; of its keys see below, the first value is the default",
            {ValueKind::keyValue, allSetPairs(), setKeysExplained()})
      ->group("Picture");
  line.text(command, "--environment", o.environment, "FILE",
            "Light from all around: an equirectangular .hdr, .exr or .pfm instead of the scene's", ValueKind::file)
      ->group("Picture");
  line.declare(command.add_option("--effects", o.effects, effectsExplained()), "auto|all|LIST",
               {ValueKind::choice, {"auto", "all"}})
      ->group("Picture");
}

void addDepthOption(CommandLine& line, CLI::App& command, RenderOptions& o) {
  noteGiven(line.whole(command, "--max-depth", o.maxDepth, "N", 0, kMostDepth,
                       "Ray segments after the primary one (whitted); 0 is direct light only")
                ->group("Sampling"),
            o.maxDepthGiven);
}

void addDisplayOptions(CommandLine& line, CLI::App& command, double& exposureStops, std::string& toneMap) {
  line.number(command, "--exposure", exposureStops, "STOPS", -kMostStops, kMostStops, "Multiply the picture by 2^STOPS")
      ->group("Output");
  line.choice(command, "--tone-map", toneMap, kToneMaps, "How PNG maps radiance to what a display can show")
      ->group("Output");
}

ToneMap toneMapOf(const std::string& name) { return static_cast<ToneMap>(indexIn(kToneMaps, name)); }

void addRenderOptions(CommandLine& line, CLI::App& command, RenderOptions& o) {
  line.text(command, "SCENE", o.scene, "SCENE", "A glTF 2.0 file, .gltf or .glb", ValueKind::file);
  addOutputOptions(line, command, o);
  addPictureOptions(line, command, o);
  addSamplingOptions(line, command, o);
  addManyOptions(line, command, o);
  addDeviceOptions(line, command, o.device);
  line.flag(command, "--list-devices", o.listDevices, "List the devices instead of drawing")->group("Device");
  line.choice(command, "--progress", o.progress, progressNames(), "Progress on stderr; a bar on a terminal only")
      ->group("Messages");
}

// Samples are decided on from the eighth on.
static void checkAdaptive(const RenderOptions& o) {
  if (o.adaptive == 0) return;
  if (!o.part.empty())
    throw UsageError("--adaptive looks at neighboring tiles, which may be in another part: leave out --part");
  if (o.spp <= AdaptiveTiles::kFewestSamples)
    logWarning(fmt::format("--adaptive decides from {} samples on: --spp {} is too few", AdaptiveTiles::kFewestSamples,
                           o.spp));
}

RenderSettings checkedSettings(const RenderOptions& o) {
  if (o.scene.empty()) throw UsageError("no scene given: crosslight render SCENE -o OUT.png");
  RenderSettings settings;
  settings.method = methodOf(o.method);
  const Resolution resolution = resolutionOf(o.resolution);
  settings.width = resolution.width;
  settings.height = resolution.height;
  settings.spp = o.spp;
  settings.filter = static_cast<PixelFilter>(indexIn(kFilters, o.filter));
  settings.adaptiveError = o.spp > 1 ? static_cast<float>(o.adaptive) : 0.0f;
  checkAdaptive(o);
  settings.sampler = static_cast<Sampler>(indexIn(kSamplers, o.sampler));
  if (const std::string advice = adviceOnSamples(settings); !advice.empty()) logWarning(advice);
  settings.msaa = 1u << indexIn(kMsaaCounts, o.msaa);
  settings.maxDepth = o.maxDepth;
  settings.seed = o.seed;
  settings.kernel = kernelFamilyOf(o.kernel);
  settings.instances = static_cast<InstanceMode>(indexIn(kInstanceModes, o.instances));
  applyEffects(o.effects, settings);
  settings.allowNonfinite = o.allowNonfinite;
  if (o.lighting == "opengl") lightAsOpenGl(settings);
  for (const std::string& pair : o.set) {
    const SetKey& key = applySet(pair, settings);
    const auto& heed = key.methods;
    if (!heed.empty() && std::find(heed.begin(), heed.end(), settings.method) == heed.end()) {
      warnUnheeded("--set " + std::string(key.key), o);
    }
  }
  const bool rays = settings.method == Method::whitted;
  if (rays && o.msaaGiven) warnUnheeded("--msaa", o);
  if (!rays && o.maxDepthGiven) warnUnheeded("--max-depth", o);
  if (!rays && o.kernelGiven) warnUnheeded("--kernel", o);
  if (!rays && o.bvhCacheGiven) warnUnheeded("--bvh-cache", o);
  if (!rays && o.instancesGiven) warnUnheeded("--instances", o);
  settings.aovs = aovsOf(o.aovs);
  const auto isLayered = [&o] {
    return isPartFile(o.output) || (!isVideo(o.output) && imageFormatOf(o.output) == ImageFormat::exr);
  };
  if (!settings.aovs.empty() && !isLayered()) {
    throw UsageError("--aov needs an EXR file, the only format with layers: -o " +
                     std::filesystem::path(o.output).replace_extension(".exr").string());
  }
  return settings;
}

DisplayTransform checkedDisplay(const RenderOptions& o) {
  DisplayTransform display;
  display.toneMap = toneMapOf(o.toneMap);
  display.exposureStops = static_cast<float>(o.exposureStops);
  display.withAlpha = o.alpha;
  const bool png = isPartFile(o.output) || (!isVideo(o.output) && imageFormatOf(o.output) == ImageFormat::png);
  if (o.alpha && !png) warnUnheeded("--alpha on a file that is no PNG", o);
  return display;
}

BvhCache bvhCacheOf(const RenderOptions& o) {
  if (o.bvhCache == "off") return {};
  if (o.bvhCache == "auto") return defaultBvhCache();
  return {.folder = std::filesystem::absolute(o.bvhCache)};
}

DisplacementOptions displacementOf(const RenderOptions& o) {
  RenderSettings settings;
  for (const std::string& pair : o.set) applySet(pair, settings);
  DisplacementOptions displacement{.level = settings.displacementLevel};
  if (settings.displacementEdge > 0.0f) {
    const Resolution resolution = resolutionOf(o.resolution);
    displacement = {settings.displacementLevel, settings.displacementEdge, o.camera, resolution.width,
                    resolution.height};
  }
  return displacement;
}

LoadOptions loadOptionsOf(const RenderOptions& o) {
  LoadOptions load;
  load.scene = o.sceneName;
  load.animate = o.timeGiven || !o.animation.empty();
  load.animation = o.animation;
  load.timeSeconds = o.timeSeconds;
  load.hashContents = !o.part.empty();
  load.displacement = displacementOf(o);
  return load;
}

Resolution resolutionOf(const std::string& text) {
  const auto refuse = [&text]() -> UsageError {
    return UsageError(
        fmt::format("--resolution: '{}' is not WIDTHxHEIGHT with whole numbers from 1 to {}, e.g. 640x480", text,
                    kMostPixelsPerSide));
  };
  const auto side = [&refuse](const std::string& digits) {
    std::uint32_t value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || stop != digits.data() + digits.size()) throw refuse();
    if (value < 1 || value > kMostPixelsPerSide) throw refuse();
    return value;
  };
  const std::size_t cross = text.find_first_of("xX");
  if (cross == std::string::npos) throw refuse();
  return {side(text.substr(0, cross)), side(text.substr(cross + 1))};
}

std::vector<std::string> aovsOf(const std::string& list) {
  const std::vector<std::string> known = aovNames();
  if (list == "all") return known;
  std::vector<bool> wanted(known.size(), false);
  std::size_t begin = 0;
  while (begin < list.size()) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string name = list.substr(begin, end - begin);
    const std::size_t index = indexIn(known, name);
    if (index == known.size())
      throw UsageError("--aov: " + unknownWord("AOV", name, known) + " 'all' means all of them");
    wanted[index] = true;
    begin = end + 1;
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (wanted[i]) names.push_back(known[i]);
  }
  return names;
}

}  // namespace crosslight
