#include "app/render_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/check.h"
#include "base/error.h"
#include "base/log.h"
#include "base/time.h"
#include "effects/effects.h"
#include "effects/material_traits.h"
#include "film/film.h"
#include "raster/raster.h"
#include "trace/whitted.h"
#include "upload/gpu_scene.h"

namespace crosslight {
namespace {

struct MethodName {
  Method method;
  const char* name;
};
constexpr std::array kMethods{MethodName{Method::wireframe, "wireframe"}, MethodName{Method::flat, "flat"},
                              MethodName{Method::gouraud, "gouraud"}, MethodName{Method::phong, "phong"},
                              MethodName{Method::whitted, "whitted"}};

bool isTraced(Method method) { return method == Method::whitted; }

FilterShape shapeOf(PixelFilter filter) {
  switch (filter) {
    case PixelFilter::box:
      return FilterShape::box;
    case PixelFilter::tent:
      return FilterShape::tent;
    case PixelFilter::gaussian:
      return FilterShape::gaussian;
  }
  return FilterShape::box;
}

std::string describeFilter(const RenderSettings& s) {
  if (s.spp <= 1) return "one sample at the pixel's center";
  const char* filter = s.filter == PixelFilter::box    ? "box of one pixel"
                       : s.filter == PixelFilter::tent ? "tent of radius 1 pixel"
                                                       : "Gaussian of deviation 1/2 pixel, cut at 3/2";
  return fmt::format("{}, {} samples of a (0,2)-sequence, the same in every pixel", filter, s.spp);
}

// What the device must be able to do for these settings, said before anything is allocated.
void checkAgainstDevice(const gpu::DeviceInfo& info, const RenderSettings& s) {
  const std::uint32_t size = std::max(s.width, s.height);
  if (!isTraced(s.method) && size > info.maxImageSize) {
    throw DeviceError(fmt::format("{}x{} pixels: '{}' draws images of up to {} pixels a side", s.width, s.height,
                                  info.name, info.maxImageSize));
  }
  if (isTraced(s.method) && s.msaa > 1) {
    throw UsageError("MSAA belongs to the raster methods: use --spp with whitted");
  }
  const auto& counts = info.msaaCounts;
  if (std::find(counts.begin(), counts.end(), s.msaa) != counts.end() || isTraced(s.method)) return;
  throw DeviceError(
      fmt::format("MSAA {}: '{}' supports {}; use one of these, or --spp", s.msaa, info.name, fmt::join(counts, ", ")));
}

using Fill = void (*)(const shared::AovRecord& record, const glm::dvec3& origin, float* samples);

// One AOV as a layer: its channels and how a record fills them.
struct AovLayer {
  const char* name;
  std::vector<std::string> channels;
  Fill fill;                                      // float layers
  std::uint32_t (*id)(const shared::AovRecord&);  // integer layers
};

void put3(const glm::vec3& v, float* samples) {
  for (int i = 0; i < 3; ++i) samples[i] = v[i];
}

const std::vector<AovLayer>& aovLayers() {
  using A = shared::AovRecord;
  using Origin = const glm::dvec3&;
  static const std::vector<std::string> xyz{"X", "Y", "Z"}, rgb{"R", "G", "B"};
  static const std::vector<AovLayer> layers{
      {"depth", {"Z"}, [](const A& a, Origin, float* s) { s[0] = a.depth; }, nullptr},
      {"position", xyz,
       [](const A& a, Origin o, float* s) {
         if (a.instanceId != shared::kNoId) put3(glm::vec3(glm::dvec3(a.position) + o), s);
       },
       nullptr},
      {"normal", xyz, [](const A& a, Origin, float* s) { put3(a.normal, s); }, nullptr},
      {"geometricNormal", xyz, [](const A& a, Origin, float* s) { put3(a.geometricNormal, s); }, nullptr},
      {"albedo", rgb, [](const A& a, Origin, float* s) { put3(a.albedo, s); }, nullptr},
      {"uv", {"U", "V"}, [](const A& a, Origin, float* s) { s[0] = a.uv.x, s[1] = a.uv.y; }, nullptr},
      {"instanceId", {"I"}, nullptr, [](const A& a) { return a.instanceId; }},
      {"primitiveId", {"I"}, nullptr, [](const A& a) { return a.primitiveId; }},
      {"materialId", {"I"}, nullptr, [](const A& a) { return a.materialId; }},
      {"ambient", rgb, [](const A& a, Origin, float* s) { put3(a.ambient, s); }, nullptr},
      {"diffuse", rgb, [](const A& a, Origin, float* s) { put3(a.diffuse, s); }, nullptr},
      {"specular", rgb, [](const A& a, Origin, float* s) { put3(a.specular, s); }, nullptr},
      {"emission", rgb, [](const A& a, Origin, float* s) { put3(a.emission, s); }, nullptr}};
  return layers;
}

Layer makeLayer(const AovLayer& from, const std::vector<shared::AovRecord>& records, const glm::dvec3& origin) {
  Layer layer;
  layer.name = from.name;
  layer.channelNames = from.channels;
  if (from.id) {
    layer.isInteger = true;
    for (const shared::AovRecord& r : records) layer.integers.push_back(from.id(r));
    return layer;
  }
  const std::size_t channels = from.channels.size();
  layer.samples.resize(records.size() * channels);
  for (std::size_t i = 0; i < records.size(); ++i) from.fill(records[i], origin, &layer.samples[i * channels]);
  return layer;
}

Image assemble(const FilmResult& film, const Scene& scene, const RenderSettings& s) {
  Image image = makeImage(s.width, s.height);
  std::vector<float>& samples = image.picture().samples;
  for (std::size_t i = 0; i < film.picture.size(); ++i) {
    for (int c = 0; c < 4; ++c) samples[4 * i + static_cast<std::size_t>(c)] = film.picture[i][c];
  }
  const glm::dvec3 origin = renderOrigin(scene.cameras[static_cast<std::size_t>(s.camera)]);
  for (const AovLayer& layer : aovLayers()) {
    if (std::find(s.aovs.begin(), s.aovs.end(), layer.name) != s.aovs.end()) {
      image.layers.push_back(makeLayer(layer, film.aovs, origin));
    }
  }
  return image;
}

void checkFinite(const FilmResult& film, const RenderSettings& s) {
  if (film.nonfinite == 0) return;
  const std::string text = fmt::format("{} samples are NaN or infinite, the first at pixel ({}, {})", film.nonfinite,
                                       film.firstNonfinitePixel % s.width, film.firstNonfinitePixel / s.width);
  if (!s.allowNonfinite) throw InternalError(text + "; --allow-nonfinite writes the image all the same");
  logWarning(text);
}

std::vector<EffectRecord> recordsOf(const Plan& plan) {
  std::vector<EffectRecord> records;
  for (const EffectVerdict& v : plan.verdicts) records.push_back({v.name, v.on, v.reason});
  return records;
}

// What a raster method cannot show of this scene, said once per material.
void warnOfApproximations(const Scene& scene, const Plan& plan, const RenderSettings& s) {
  if (isTraced(s.method) || !plan.has(Effect::transparency)) return;
  for (const Material& m : scene.materials) {
    if (refracts(m)) {
      logWarning(
          fmt::format("material '{}' refracts: {} shows what is behind it unbent and without reflections; "
                      "whitted traces both",
                      m.name, nameOf(s.method)));
    }
  }
}

void checkSettings(const Scene& scene, const RenderSettings& s) {
  CL_CHECK_LT(static_cast<std::size_t>(s.camera), scene.cameras.size());
  CL_CHECK(s.width > 0 && s.height > 0 && s.spp > 0);
  for (const std::string& name : s.aovs) {
    const bool known =
        std::any_of(std::begin(kAovNames), std::end(kAovNames), [&](const char* n) { return name == n; });
    if (!known) throw UsageError(fmt::format("no AOV '{}'; there are: {}", name, fmt::join(kAovNames, ", ")));
  }
}

}  // namespace

RenderResult render(gpu::Device& device, const Scene& scene, const RenderSettings& settings,
                    const ProgressFunction& progress) {
  checkSettings(scene, settings);
  checkAgainstDevice(device.info(), settings);
  RenderResult result;
  RenderReport& report = result.report;
  Stopwatch watch;
  const auto lap = [&](const char* phase) { report.timesMs.emplace_back(phase, watch.lapMs()); };

  const Plan plan = makePlan(scene, settings);
  warnOfApproximations(scene, plan, settings);
  const bool traced = isTraced(settings.method);
  const glm::dvec3 origin = renderOrigin(scene.cameras[static_cast<std::size_t>(settings.camera)]);
  FlatScene flat = flattenScene(scene, origin, traced);
  lap("flatten");
  FlatBvh bvh;
  if (traced) bvh = buildFlatBvh(flat, scene, settings);
  lap("bvh");
  report.counters["triangles"] = flat.triangleCount();
  report.counters["shapes"] = flat.shapes.size();
  report.counters["bvhNodes"] = bvh.nodes.size();
  report.counters["bvhBytes"] =
      bvh.nodes.size() * sizeof(shared::BvhNode) + bvh.primitives.size() * sizeof(shared::BvhPrimitive);

  GpuScene gpuScene(device, scene, settings, std::move(flat), traced ? &bvh : nullptr);
  Film film(device, {settings.width, settings.height,
                     samplePattern(settings.spp, shapeOf(settings.filter), settings.seed), !settings.aovs.empty()});
  lap("upload");
  const std::unique_ptr<Technique> technique = traced ? makeWhitted(device, gpuScene, plan, settings, film.buffers())
                                                      : makeRaster(device, gpuScene, plan, settings, film.buffers());
  lap("pipelines");
  Tally tally;
  const FilmResult exposed = film.expose(*technique, tally, progress);
  report.timesMs.emplace_back("render", exposed.renderMs);
  checkFinite(exposed, settings);
  watch.lapMs();
  result.image = assemble(exposed, scene, settings);
  report.timesMs.emplace_back("readback", exposed.readbackMs + watch.lapMs());

  report.gpuMs = tally.spansMs();
  report.effects = recordsOf(plan);
  report.rays = technique->rays();
  for (const auto& [name, count] : technique->counters()) report.counters[name] = count;
  report.counters["pixels"] = std::uint64_t{settings.width} * settings.height;
  report.counters["samples"] = report.counters["pixels"] * settings.spp;
  report.nonfinite = exposed.nonfinite;
  report.deviceBytes = device.peakAllocatedBytes();
  report.promise = technique->promise();
  report.pixelFilter = describeFilter(settings);
  return result;
}

const char* nameOf(Method method) {
  for (const MethodName& m : kMethods) {
    if (m.method == method) return m.name;
  }
  return "unknown";
}

Method methodOf(const std::string& name) {
  std::string all;
  for (const MethodName& m : kMethods) {
    if (name == m.name) return m.method;
    all += (all.empty() ? "" : ", ") + std::string(m.name);
  }
  throw UsageError(fmt::format("no method '{}'; there are: {}", name, all));
}

std::vector<Method> allMethods() {
  std::vector<Method> methods;
  for (const MethodName& m : kMethods) methods.push_back(m.method);
  return methods;
}

}  // namespace crosslight
