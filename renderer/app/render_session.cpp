#include "app/render_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <list>

#include "app/picture_layers.h"
#include "app/picture_samples.h"
#include "app/render_checks.h"
#include "base/error.h"
#include "base/log.h"
#include "base/time.h"
#include "effects/approximations.h"
#include "effects/effects.h"
#include "effects/forced.h"
#include "effects/material_traits.h"
#include "raster/raster.h"
#include "trace/whitted.h"
#include "upload/gpu_scene.h"
#include "upload/shared_trees.h"

namespace crosslight {
namespace {

void checkFinite(const FilmResult& film, const RenderSettings& s) {
  if (film.nonfinite == 0) return;
  const std::string text = fmt::format("{} samples are NaN or infinite, the first at pixel ({}, {})", film.nonfinite,
                                       film.firstNonfinitePixel % s.width, film.firstNonfinitePixel / s.width);
  if (!s.allowNonfinite) throw InternalError(text + "; --allow-nonfinite writes the image all the same");
  logWarning(text);
}

void reportAdaptive(const FilmResult& film, const RenderSettings& s, RenderReport& report) {
  report.counters["pixelsNotDone"] = film.pixelsNotDone;
  if (film.pixelsNotDone == 0) return;
  logWarning(fmt::format("{} pixels lie in tiles that {} samples did not bring to an error of {:g}; --spp allows more",
                         film.pixelsNotDone, s.spp, s.adaptiveError));
}

std::vector<EffectRecord> recordsOf(const Plan& plan) {
  std::vector<EffectRecord> records;
  for (const EffectVerdict& v : plan.verdicts) records.push_back({v.name, v.on, v.reason, v.leftOut});
  return records;
}

// What the method cannot show of this scene, said once per material.
void warnOfApproximations(const Scene& scene, const Plan& plan, const RenderSettings& s) {
  for (const std::string& text : approximationsOf(scene, s)) logWarning(text);
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

void warnOfWhatIsLeftOut(const Plan& plan) {
  std::string names;
  for (const EffectVerdict& v : plan.verdicts) {
    if (v.leftOut) names += (names.empty() ? "" : ", ") + v.name;
  }
  if (!names.empty()) logWarning("the image is not the scene's: left out because asked, though called for: " + names);
}

// Scenes on the device that are kept: a scene from a few cameras, or a few scenes in turn.
constexpr std::size_t kScenesKept = 4;

// Sets of kernels that are kept: frames of a turn whose plans change with what is in view, and back.
constexpr std::size_t kPlansKept = 4;

// A flattened scene on the device. Its settings are the render's that uses it: GpuScene looks at them for each sample.
struct PlacedScene {
  std::shared_ptr<const Scene> scene;
  RenderSettings settings, madeFor;
  glm::dvec3 origin{0.0};
  std::map<std::string, std::uint64_t> counters;
  TreeRecord tree;
  std::unique_ptr<GpuScene> onDevice;
  bool hasTrees = false, hasMeshes = true;
};

// What a scene on the device depends on: not on what belongs to the film or says how far rays go, nor on which camera
// stands at the origin.
RenderSettings withoutFilm(RenderSettings s) {
  s.width = s.height = 0;
  s.camera = 0;
  s.spp = s.msaa = 1;
  s.maxDepth = 0;
  s.shadows = s.reflection = s.refraction = true;
  if (s.rasterShadows != RasterShadows::rays) s.rasterShadows = RasterShadows::off;  // rays need a tree
  s.shadowMaps = {};
  s.rasterReflections = RasterReflections::off;
  s.probeSize = 0;
  s.lightSamples = 0;
  s.environmentRotation = s.environmentIntensity = 0;
  s.filter = PixelFilter::box;
  s.sampler = Sampler::sobol;
  s.adaptiveError = 0;
  s.seed = 0;
  s.allEffects = false;
  s.forcedEffects.clear();
  s.effectsWithin = 0;
  s.allowNonfinite = false;
  s.aovs.clear();
  return s;
}

bool needsTrees(const Plan& plan, const RenderSettings& settings) {
  return isTraced(settings.method) || rasterSendsRays(plan, settings);
}

struct PlacedFilm {
  FilmSettings settings;
  std::unique_ptr<Film> film;
};

bool same(const std::vector<Band>& a, const std::vector<Band>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Band& p, const Band& q) { return p.firstRow == q.firstRow && p.rowCount == q.rowCount; });
}

bool same(const FilmSettings& a, const FilmSettings& b) {
  return a.width == b.width && a.height == b.height && a.samples == b.samples && a.adaptiveError == b.adaptiveError &&
         a.wantAovs == b.wantAovs && same(a.rows, b.rows) && a.shownBy == b.shownBy;
}

// What is not finite is told apart by floats only: whoever allows it wants the codec's warning too.
std::optional<DisplayTransform> codesOf(const RenderRequest& request, const Plan& plan) {
  const bool can = canDrawCodes(plan, request.settings) && !request.settings.allowNonfinite;
  return can && request.shownBy && hasCodeTable(*request.shownBy) ? request.shownBy : std::nullopt;
}

glm::dvec3 originOf(const RenderRequest& request) {
  return renderOrigin(request.scene->cameras[static_cast<std::size_t>(request.settings.camera)]);
}

class Phases {
 public:
  explicit Phases(RenderReport& report) : report_(report) {}
  void lap(const char* phase) { report_.timesMs.emplace_back(phase, watch_.lapMs()); }
  double sinceLapMs() { return watch_.lapMs(); }

 private:
  RenderReport& report_;
  Stopwatch watch_;
};

}  // namespace

struct RenderSession::Impl {
  explicit Impl(gpu::Device& d) : device(d) {}

  PlacedScene& place(const RenderRequest& request, const Plan& plan, const Sharing& sharing, RenderReport& report,
                     Phases& phases);
  void make(const RenderRequest& request, const Plan& plan, const glm::dvec3& origin, const Sharing& sharing,
            Phases& phases);
  KeptTrees* keptFor(const RenderRequest& request, const Plan& plan);
  CachedTrees* cachedFor(const RenderRequest& request);
  FlatBvh treesFor(const RenderRequest& request, const Plan& plan, const FlatScene& flat, const Sharing& sharing,
                   TreeRecord& record);
  Film& filmFor(const FilmSettings& settings, RenderReport& report);
  std::shared_ptr<KernelPipelines> kernelsFor(const RenderRequest& request, const Plan& plan, const Sharing& sharing,
                                              RenderReport& report);
  std::unique_ptr<Technique> techniqueFor(const Plan& plan, PlacedScene& placed, FilmBuffers& buffers,
                                          const std::shared_ptr<KernelPipelines>& tracing);

  gpu::Device& device;
  std::list<PlacedScene> scenes;  // the latest first
  KeptTrees keptTrees;            // of the last frame
  std::unique_ptr<CachedTrees> cachedTrees;
  PlacedFilm film;
  std::list<std::shared_ptr<KernelPipelines>> pools;  // the latest first
  std::shared_ptr<KernelPipelines> kernels;           // of the last traced picture
};

// Where pictures show whether a tree was built or moved each frame gets its own.
KeptTrees* RenderSession::Impl::keptFor(const RenderRequest& request, const Plan& plan) {
  return request.isFrame && !showsItsTree(plan) ? &keptTrees : nullptr;
}

// Not of frames: each has a tree of its own, which no other picture will ask for.
CachedTrees* RenderSession::Impl::cachedFor(const RenderRequest& request) {
  if (request.isFrame || request.bvhCache.folder.empty()) return nullptr;
  if (cachedTrees == nullptr || cachedTrees->cache().folder != request.bvhCache.folder)
    cachedTrees = std::make_unique<CachedTrees>(request.bvhCache);
  return cachedTrees.get();
}

FlatBvh RenderSession::Impl::treesFor(const RenderRequest& request, const Plan& plan, const FlatScene& flat,
                                      const Sharing& sharing, TreeRecord& record) {
  FlatBvh trees;
  // Raster's shaders walk the binary tree alone.
  const KernelChoice choice = isTraced(request.settings.method) ? kernels->choice() : KernelChoice{};
  const bool byDevice = choice.byDevice;
  TreeSources sources;
  if (!byDevice) sources = {keptFor(request, plan), cachedFor(request)};
  if (sharing.shares) {
    SharedTreesReport report;
    trees = buildSharedTrees(flat, *request.scene, request.settings, sharing, report, sources);
    record = {"two-level", sharing.reason, report.instances, report.trees, 0, report.bytesSaved, report.trees};
  } else {
    trees = buildFlatBvh(flat, *request.scene, request.settings, {choice.wideTree, choice.quadTree, byDevice}, sources);
    record = {byDevice ? "device" : "flat", sharing.reason, flat.instances.size(), 1, 0, 0, byDevice ? 0u : 1u};
  }
  if (sources.cached != nullptr) {
    record.loaded = sources.cached->takeLoaded();
    record.built -= record.loaded;
  }
  if (sources.kept != nullptr) {
    const KeptTrees::Counts counts = keptTrees.takeCounts();
    record.built = counts.built;
    record.moved = counts.moved;
    record.unchanged = counts.unchanged;
  }
  record.bytes = trees.sizeBytes();
  return trees;
}

void RenderSession::Impl::make(const RenderRequest& request, const Plan& plan, const glm::dvec3& origin,
                               const Sharing& sharing, Phases& phases) {
  const RenderSettings& settings = request.settings;
  const Scene& scene = *request.scene;
  const bool traced = isTraced(settings.method);
  FlatScene flat = flattenScene(scene, origin, traced, plan.has(Effect::triangles));
  phases.lap("flatten");
  FlatBvh bvh;
  TreeRecord tree;
  const bool hasTrees = needsTrees(plan, settings);
  if (hasTrees) bvh = treesFor(request, plan, flat, sharing, tree);
  phases.lap("bvh");
  PlacedScene placed{request.scene, settings, withoutFilm(settings),      origin, {}, tree,
                     nullptr,       hasTrees, plan.has(Effect::triangles)};
  placed.counters = {{"triangles", flat.triangleCount()},
                     {"shapes", flat.shapes.size()},
                     {"bvhNodes", bvh.nodes.size()},
                     {"bvhBytes", bvh.sizeBytes()}};
  scenes.push_front(std::move(placed));
  PlacedScene& kept = scenes.front();
  try {
    if (traced)
      kept.onDevice = GpuScene::forRays(device, scene, kept.settings, std::move(flat), std::move(bvh));
    else
      kept.onDevice = std::make_unique<GpuScene>(device, scene, kept.settings, std::move(flat), &bvh);
    kept.tree.bytes += kept.onDevice->deviceTreeBytes();
  } catch (...) {
    scenes.pop_front();
    throw;
  }
}

PlacedScene& RenderSession::Impl::place(const RenderRequest& request, const Plan& plan, const Sharing& sharing,
                                        RenderReport& report, Phases& phases) {
  const RenderSettings key = withoutFilm(request.settings);
  const glm::dvec3 origin = originOf(request);
  const auto found = std::find_if(scenes.begin(), scenes.end(), [&](const PlacedScene& p) {
    return p.scene.get() == request.scene.get() && p.origin == origin && p.madeFor == key &&
           (p.tree.kind == "two-level") == sharing.shares && p.hasMeshes == plan.has(Effect::triangles) &&
           (p.hasTrees || !needsTrees(plan, request.settings));
  });
  if (found != scenes.end()) {
    scenes.splice(scenes.begin(), scenes, found);
    report.reused.push_back("scene");
    phases.lap("flatten");
    phases.lap("bvh");
  } else {
    while (scenes.size() >= kScenesKept) scenes.pop_back();
    make(request, plan, origin, sharing, phases);
  }
  scenes.front().settings = request.settings;
  return scenes.front();
}

Film& RenderSession::Impl::filmFor(const FilmSettings& settings, RenderReport& report) {
  if (film.film != nullptr && same(film.settings, settings)) {
    report.reused.push_back("film");
    return *film.film;
  }
  film.film = nullptr;  // before the next one needs the memory
  film.film = std::make_unique<Film>(device, settings);
  film.settings = settings;
  return *film.film;
}

// Begun before the scene is placed: a driver takes about as long for the kernels as the tree takes to build.
std::shared_ptr<KernelPipelines> RenderSession::Impl::kernelsFor(const RenderRequest& request, const Plan& plan,
                                                                 const Sharing& sharing, RenderReport& report) {
  if (!isTraced(request.settings.method)) return nullptr;
  const auto found = std::find_if(pools.begin(), pools.end(), [&](const std::shared_ptr<KernelPipelines>& p) {
    return p->serve(device.info(), *request.scene, plan, request.settings, sharing.shares);
  });
  if (found != pools.end()) {
    report.reused.push_back("kernels");
    pools.splice(pools.begin(), pools, found);
  } else {
    while (pools.size() >= kPlansKept) pools.pop_back();
    pools.push_front(std::make_shared<KernelPipelines>(device, *request.scene, plan, request.settings, sharing.shares));
  }
  kernels = pools.front();
  return kernels;
}

std::unique_ptr<Technique> RenderSession::Impl::techniqueFor(const Plan& plan, PlacedScene& placed,
                                                             FilmBuffers& buffers,
                                                             const std::shared_ptr<KernelPipelines>& tracing) {
  if (tracing == nullptr) return makeRaster(device, *placed.onDevice, plan, placed.settings, buffers);
  return makeWhittedWith(tracing, device, *placed.onDevice, plan, placed.settings, buffers);
}

RenderSession::RenderSession(gpu::Device& device) : impl_(std::make_unique<Impl>(device)) {}
RenderSession::~RenderSession() = default;

void RenderSession::forget(const Scene& scene) {
  impl_->scenes.remove_if([&](const PlacedScene& p) { return p.scene.get() == &scene; });
}

RenderResult RenderSession::render(const RenderRequest& asked, const ProgressFunction& progress) {
  const Scene& scene = *asked.scene;
  checkSettings(scene, asked.settings);
  RenderRequest request = asked;
  request.settings = withForcedSwitches(asked.settings);
  const RenderSettings& settings = request.settings;
  checkAgainstDevice(impl_->device.info(), settings);
  RenderResult result;
  RenderReport& report = result.report;
  Phases phases(report);

  const Plan plan = makePlan(scene, asked.settings);
  request.settings.maxDepth = plan.maxDepth;
  Sharing sharing;
  if (isTraced(settings.method)) sharing = planSharing(scene, originOf(request), plan, settings);
  const MemoryNeed need = memoryNeedOf(impl_->device.info(), request, sharing.shares ? sharing.trianglesSaved : 0);
  checkLists(impl_->device.info(), request, sharing.shares ? sharing.trianglesSaved : 0);
  checkMemory(need, memoryLimitsOf(impl_->device.info()), settings);
  warnOfApproximations(scene, plan, settings);
  if (plan.bound > 0) logInfo(fmt::format("ray depth {}: {}", plan.maxDepth, plan.depthReason));
  if (asked.warnsOfForced) warnOfWhatIsLeftOut(plan);
  const std::shared_ptr<KernelPipelines> kernels = impl_->kernelsFor(request, plan, sharing, report);
  PlacedScene& placed = impl_->place(request, plan, sharing, report, phases);
  report.counters = placed.counters;
  report.tree = placed.tree;
  Film& film = impl_->filmFor({settings.width, settings.height, samplesOf(settings), !settings.aovs.empty(),
                               request.rows, codesOf(request, plan), settings.adaptiveError},
                              report);
  phases.lap("upload");
  const std::unique_ptr<Technique> technique = impl_->techniqueFor(plan, placed, film.buffers(), kernels);
  phases.lap("pipelines");
  Tally tally;
  const auto rows = static_cast<std::uint32_t>(film.exposedPixels() / settings.width);
  PictureLayers layers(settings.width, rows, settings.aovs, placed.origin, film.buffers().wantsCodes());
  const double layersMs = phases.sinceLapMs();
  const FilmResult exposed = film.expose(
      *technique, tally, [&layers](const ExposedPixels& pixels) { layers.add(pixels); }, progress);
  report.timesMs.emplace_back("render", exposed.renderMs);
  report.timesMs.emplace_back("readback", layersMs + exposed.readbackMs);
  checkFinite(exposed, settings);
  result.image = layers.take();
  if (request.rayTreePixel && kernels != nullptr) {
    result.rayTree =
        traceRayTree(kernels, impl_->device, *placed.onDevice, plan, placed.settings, *request.rayTreePixel);
  }

  report.gpuMs = tally.spansMs();
  report.effects = recordsOf(plan);
  for (const LightVerdict& light : plan.lightShadows)
    report.lightShadows.push_back({light.name, light.shadows, light.reason});
  report.rayDepth = plan.maxDepth;
  report.depthReason = plan.depthReason;
  report.rays = technique->rays();
  for (const auto& [name, count] : technique->counters()) report.counters[name] = count;
  report.counters["pixels"] = film.exposedPixels();
  report.counters["samples"] = exposed.samples;
  if (settings.adaptiveError > 0) reportAdaptive(exposed, settings, report);
  report.nonfinite = exposed.nonfinite;
  report.deviceBytes = impl_->device.peakAllocatedBytes();
  report.neededBytes = need.hostPictureBytes + need.hostSceneBytes + need.devicePictureBytes + need.deviceSceneBytes;
  report.promise = technique->promise();
  report.pixelFilter = describeSamples(settings);
  return result;
}

}  // namespace crosslight
