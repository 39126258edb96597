// What it is worth to compile and run only what a scene calls for: each scene by its own plan against everything
// (--effects all), in render time, in time to compile from nothing, and in memory on the device.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>

#include "app/render_session.h"
#include "app/scene_extras.h"
#include "bench/bench.h"
#include "gpu/peak_memory.h"
#include "measure/statistics.h"

namespace crosslight::bench {
namespace {

// A driver's code from earlier runs would hide what compiling costs. Asked when a device is opened.
class WithoutShaderCache {
 public:
  WithoutShaderCache() {
    const char* before = std::getenv(kName);
    if (before != nullptr) before_ = before;
    setenv(kName, "true", 1);
  }
  WithoutShaderCache(const WithoutShaderCache&) = delete;
  WithoutShaderCache& operator=(const WithoutShaderCache&) = delete;
  ~WithoutShaderCache() { before_ ? setenv(kName, before_->c_str(), 1) : unsetenv(kName); }

 private:
  static constexpr const char* kName = "MESA_SHADER_CACHE_DISABLE";
  std::optional<std::string> before_;
};

struct Shot {
  double renderMs = 0;
  double pipelinesAndRenderMs = 0;  // llvmpipe compiles graphics pipelines when they are first drawn with
  std::uint64_t deviceBytes = 0;    // beyond those of earlier pictures that are kept
  Image image;
};

// One plan of a scene; its session keeps what is on the device.
class Drawer {
 public:
  Drawer(gpu::Device& device, std::shared_ptr<const Scene> scene, const RenderSettings& settings)
      : device_(device), session_(device), request_{std::move(scene), settings} {}

  Shot draw() {
    const std::uint64_t others = device_.allocatedBytes();
    gpu::forgetPeakMemory(device_);
    RenderResult result = session_.render(request_);
    Shot shot{.deviceBytes = result.report.deviceBytes - others, .image = std::move(result.image)};
    for (const auto& [phase, ms] : result.report.timesMs) {
      if (phase == "render") shot.renderMs = ms;
      if (phase == "render" || phase == "pipelines") shot.pipelinesAndRenderMs += ms;
    }
    return shot;
  }

 private:
  gpu::Device& device_;
  RenderSession session_;
  RenderRequest request_;
};

struct Cost {
  double compileMs = 0;
  std::uint64_t deviceBytes = 0;
  Image image;
};

// The first picture compiles what no scene before it has compiled.
Cost costOf(Drawer& drawer) {
  Shot first = drawer.draw();
  const double again = drawer.draw().pipelinesAndRenderMs;
  return {std::max(0.0, first.pipelinesAndRenderMs - again), first.deviceBytes, std::move(first.image)};
}

bool sameBits(const Image& a, const Image& b) {
  const std::vector<float>&p = a.picture().samples, &q = b.picture().samples;
  return p.size() == q.size() && std::memcmp(p.data(), q.data(), p.size() * sizeof(float)) == 0;
}

// Ratios full / specialized over the scenes of a method.
class Gains {
 public:
  void add(double gain, const std::string& scene) {
    logarithms_ += std::log(gain);
    ++count_;
    if (gain < least_) {
      least_ = gain;
      leastScene_ = scene;
    }
  }
  Json figures() const {
    return {{"scenes", count_},
            {"geometricMean", count_ == 0 ? 0.0 : std::exp(logarithms_ / static_cast<double>(count_))},
            {"least", least_},
            {"leastScene", leastScene_}};
  }

 private:
  double logarithms_ = 0, least_ = std::numeric_limits<double>::infinity();
  std::size_t count_ = 0;
  std::string leastScene_;
};

class MethodCosts {
 public:
  MethodCosts(Bench& bench, gpu::Device& device, Method method) : bench_(bench), device_(device), method_(method) {}

  void measure(const std::string& sceneName, const std::shared_ptr<const Scene>& scene) {
    RenderSettings settings;
    settings.method = method_;
    settings.width = bench_.quick ? 48 : 320;
    settings.height = bench_.quick ? 36 : 240;
    Drawer specialized(device_, scene, settings);
    settings.allEffects = true;
    Drawer full(device_, scene, settings);
    const Cost own = costOf(specialized), all = costOf(full);
    fullCompileMs_ = std::max(fullCompileMs_, all.compileMs);

    const std::string prefix = fmt::format("effects.{}.{}", nameOf(method_), sceneName);
    const Rounds rounds = interleave({[&] {
                                        return Measured{{prefix + ".specialized", specialized.draw().renderMs}};
                                      },
                                      [&] {
                                        return Measured{{prefix + ".full", full.draw().renderMs}};
                                      }},
                                     bench_.rounds);
    bench_.report.compare(prefix + ".specialized", prefix + ".full", rounds, Quantity::time);
    time_.add(median(rounds.of(prefix + ".full")) / median(rounds.of(prefix + ".specialized")), sceneName);
    memory_.add(static_cast<double>(all.deviceBytes) / static_cast<double>(own.deviceBytes), sceneName);
    compileMs_.emplace_back(sceneName, own.compileMs);
    bench_.report.addCheck(
        prefix + ".sameBits", sameBits(own.image, all.image),
        {{"compileMs", own.compileMs}, {"deviceBytes", own.deviceBytes}, {"fullDeviceBytes", all.deviceBytes}});
  }

  // The full pipelines serve all scenes: what the dearest first picture of them took.
  void summarize() const {
    Gains compile;
    for (const auto& [scene, ms] : compileMs_) {
      if (ms > 0.0) compile.add(fullCompileMs_ / ms, scene);
    }
    const std::string prefix = fmt::format("effects.{}.", nameOf(method_));
    bench_.report.addCheck(prefix + "renderTimeGain", true, time_.figures());
    Json figures = compile.figures();
    figures["fullCompileMs"] = fullCompileMs_;
    bench_.report.addCheck(prefix + "compileTimeGain", true, figures);
    bench_.report.addCheck(prefix + "deviceMemoryGain", true, memory_.figures());
  }

 private:
  Bench& bench_;
  gpu::Device& device_;
  Method method_;
  Gains time_, memory_;
  double fullCompileMs_ = 0;
  std::vector<std::pair<std::string, double>> compileMs_;
};

std::vector<std::string> sceneNames(const Bench& bench) {
  if (bench.quick) return {"feature/lambert"};
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(bench.scenes)) {
    if (entry.path().extension() != ".gltf") continue;
    std::string name = std::filesystem::relative(entry.path(), bench.scenes).replace_extension().string();
    if (name.find(bench.only) != std::string::npos) names.push_back(std::move(name));
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

void benchEffects(Bench& bench) {
  const WithoutShaderCache cold;
  gpu::DeviceOptions options;
  options.selector = std::to_string(bench.device().info().index);
  options.usePipelineCache = false;
  gpu::Device device = gpu::Device::open(options);
  for (const Method method : {Method::phong, Method::whitted}) {
    MethodCosts measured(bench, device, method);
    for (const std::string& name : sceneNames(bench)) {
      auto scene = std::make_shared<Scene>(loadScene(bench.scenes / (name + ".gltf")));
      completeScene(*scene);
      measured.measure(name, scene);
    }
    measured.summarize();
  }
}

}  // namespace crosslight::bench
