#include "trace/kernels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "base/error.h"
#include "bindings.h"
#include "upload/gpu_scene.h"

namespace crosslight {

using namespace shared;

namespace {

constexpr std::uint32_t kPacketLanes = 8;  // kLanes of shaders/accel/packet.glsl
constexpr std::uint32_t kLightBatch = 16;

// A kernel may be asked for any of these together.
constexpr std::uint32_t kVariants[] = {kVariantOrthographic, kVariantManyLights, kVariantRest,      kVariantAovs,
                                       kVariantTree,         kVariantQueue,      kVariantFewShapes, kVariantSharedLoads,
                                       kVariantInstances,    kVariantTiles};
constexpr bool areApart() {
  std::uint32_t seen = 0;
  for (const std::uint32_t bit : kVariants) {
    if ((seen & bit) != 0) return false;
    seen |= bit;
  }
  return true;
}
static_assert(areApart(), "two variants of the ray kernels share a bit");

struct Family {
  KernelFamily family;
  const char* name;
  const char* text;
};
constexpr std::array kFamilies{
    Family{KernelFamily::automatic, "auto", "what suits the device"},
    Family{KernelFamily::perLane, "per-lane", "one ray per invocation through the binary tree"},
    Family{KernelFamily::packet, "packet",
           "camera rays in interval packets, shadow rays in packets, others one per invocation through quantised "
           "nodes with four children"},
    Family{KernelFamily::rayQuery, "ray-query",
           "one ray per invocation, boxes of triangles found by the device's own search (VK_KHR_ray_query)"}};

const Family& rowOf(KernelFamily family) {
  return *std::find_if(kFamilies.begin(), kFamilies.end(), [&](const Family& f) { return f.family == family; });
}

bool canRunPackets(const gpu::DeviceInfo& device) { return device.subgroupSize == kPacketLanes; }

}  // namespace

KernelFamily familyFor(const gpu::DeviceInfo& device) {
  return device.isSoftware && canRunPackets(device) ? KernelFamily::packet : KernelFamily::perLane;
}

const char* nameOf(KernelFamily family) { return rowOf(family).name; }
const char* describe(KernelFamily family) { return rowOf(family).text; }

std::vector<std::string> kernelFamilyNames() {
  std::vector<std::string> names;
  for (const Family& f : kFamilies) names.emplace_back(f.name);
  return names;
}

KernelFamily kernelFamilyOf(const std::string& name) {
  std::string all;
  for (const Family& f : kFamilies) {
    if (name == f.name) return f.family;
    all += (all.empty() ? "" : ", ") + std::string(f.name);
  }
  throw UsageError(fmt::format("no ray kernel '{}'; there are: {}", name, all));
}

bool branches(const Plan& plan) {
  return plan.has(Effect::reflection) || plan.has(Effect::refraction) || plan.has(Effect::transparency);
}

std::string whyNot(KernelFamily family, const gpu::DeviceInfo& device) {
  if (family == KernelFamily::packet && !canRunPackets(device))
    return fmt::format("needs subgroups of {} lanes, those of '{}' have {}", kPacketLanes, device.name,
                       device.subgroupSize);
  if (family == KernelFamily::rayQuery && !device.rayQueryLacks.empty())
    return fmt::format("needs ray queries, and '{}' lacks {}", device.name, device.rayQueryLacks);
  return {};
}

KernelChoice chooseKernels(const gpu::DeviceInfo& device, const Plan& plan, const RenderSettings& settings,
                           bool sharedTrees) {
  KernelChoice choice;
  choice.instances = sharedTrees;
  choice.family = settings.kernel == KernelFamily::automatic ? familyFor(device) : settings.kernel;
  if (const std::string reason = whyNot(choice.family, device); !reason.empty()) {
    throw DeviceError(fmt::format("--kernel {} {}; --kernel auto takes {}", nameOf(choice.family), reason,
                                  nameOf(familyFor(device))));
  }
  // Only rays that go one by one walk shared trees.
  const bool packets = choice.family == KernelFamily::packet && !sharedTrees;
  const bool triangles =
      plan.has(Effect::triangles) || !plan.has(Effect::shapes);  // something must say "nothing is hit"
  // A packet's code stands once per ray of a lane: where materials must be asked at every hit it is too long.
  const bool cameraPackets = packets && triangles && !plan.has(Effect::alphaMask);
  const bool shadowPackets = packets && triangles && !plan.has(Effect::alphaMask) && !plan.has(Effect::transparency) &&
                             !plan.has(Effect::shapes);
  if (triangles) choice.camera = cameraPackets ? "camera_interval.comp" : "camera.comp";
  if (cameraPackets) choice.cameraRest = "camera.comp";
  choice.wideTree = cameraPackets;
  if (plan.has(Effect::shapes)) choice.shapes = "shapes.comp";
  if (plan.has(Effect::shadows)) choice.shadow = shadowPackets ? "shadow_packet.comp" : "shadow.comp";
  if (!choice.shadow.empty() && shadowPackets) choice.shadowRest = "shadow.comp";
  if (plan.has(Effect::shadows) && plan.has(Effect::softShadows) && settings.lightSamples > 0) {
    choice.areaShadow = "shadow_area.comp";
    if (plan.has(Effect::environment)) choice.environmentShadow = "shadow_environment.comp";
  }
  if (plan.has(Effect::smoke) || plan.has(Effect::volumeScatter)) choice.smoke = "smoke.comp";
  if (branches(plan)) {
    choice.gather = "gather.comp";
    if (triangles && settings.maxDepth > 0) choice.secondary = packets ? "intersect_quad.comp" : "intersect.comp";
  }
  choice.quadTree = choice.secondary == "intersect_quad.comp";
  choice.byDevice = choice.family == KernelFamily::rayQuery && triangles;
  return choice;
}

KernelChoice forTree(KernelChoice choice, const GpuScene& scene) {
  const bool fits = scene.wideDepth() > 0 && scene.wideDepth() <= kWideDepth;
  if (choice.wideTree && !fits) choice.camera = std::exchange(choice.cameraRest, {});
  if (choice.quadTree && !scene.hasQuads()) choice.secondary = "intersect.comp";
  return choice;
}

std::uint32_t lightBatch(std::uint32_t lightCount) { return std::clamp(lightCount, 1u, kLightBatch); }

namespace {

std::uint32_t variantOf(const Scene& scene, const Plan& plan, const RenderSettings& settings,
                        const KernelChoice& choice) {
  const auto bounded = [](const ShapeInstance& s) { return s.kind != ShapeKind::plane; };
  const auto shapes = std::count_if(scene.shapes.begin(), scene.shapes.end(), bounded);
  std::uint32_t variant = 0;
  if (scene.cameras[static_cast<std::size_t>(settings.camera)].orthographic) variant |= kVariantOrthographic;
  if (scene.lights.size() > kLightBatch) variant |= kVariantManyLights;
  if (branches(plan)) variant |= kVariantTree;
  if (settings.adaptiveError > 0) variant |= kVariantTiles;
  if (shapes <= kMostBoxedShapes) variant |= kVariantFewShapes;
  if (choice.family == KernelFamily::packet) variant |= kVariantSharedLoads;
  return variant;
}

// Mesa's shader cache, by its own variables: MESA_GLSL_CACHE_DISABLE is the older name.
bool driverKeepsCode() {
  for (const char* name : {"MESA_SHADER_CACHE_DISABLE", "MESA_GLSL_CACHE_DISABLE"}) {
    const char* value = std::getenv(name);
    const std::string word = value == nullptr ? "" : value;
    if (word == "1" || word == "true" || word == "yes" || word == "y") return false;
  }
  return true;
}

gpu::BindingLayout layoutOn(const gpu::Device& device, const KernelChoice& choice, bool byTiles) {
  std::vector<gpu::Binding> bindings =
      sceneBindings({kBindRays, kBindHits, kBindRayNodes, kBindVisibility, kBindCounters, kBindSampleColor, kBindAovs,
                     kBindRest, kBindQueues, kBindMedia},
                    {kBindRayTexels, kBindHitTexels, kBindNodeTexels, kBindHitClasses});
  if (byTiles) bindings.push_back({kBindTileList, gpu::BindingType::texelBufferUint1});
  if (choice.byDevice) bindings.push_back({kBindTriangleBoxes, gpu::BindingType::boxSearch});
  return {device, std::move(bindings), sizeof(TracePush)};
}

// Kernels that walk a tree over triangles exist twice: shaders/CMakeLists.txt makes the second with CL_RAY_QUERY.
gpu::ShaderCode codeOf(const std::string& kernel, const KernelChoice& choice) {
  const std::string queried = kernel.substr(0, kernel.rfind('.')) + "_query.comp";
  const auto all = gpu::embeddedShaders();
  const bool exists = std::any_of(all.begin(), all.end(), [&](const gpu::ShaderCode& c) { return c.name == queried; });
  return gpu::embeddedShader(choice.byDevice && exists ? queried : kernel);
}

}  // namespace

KernelPipelines::KernelPipelines(const gpu::Device& device, const Scene& scene, const Plan& plan,
                                 const RenderSettings& settings, bool sharedTrees)
    : device_(device),
      plan_(plan),
      choice_(chooseKernels(device.info(), plan, settings, sharedTrees)),
      variant_(variantOf(scene, plan, settings, choice_) | (sharedTrees ? kVariantInstances : 0u)),
      classes_(classifyHits(scene, plan, settings)),
      layout_(layoutOn(device, choice_, (variant_ & kVariantTiles) != 0)),
      warmUp_(device, layout_) {
  const std::uint32_t queued = classes_.classes.empty() ? 0 : kVariantQueue;
  for (const std::string& name : {choice_.camera, choice_.shapes, choice_.secondary, choice_.smoke, choice_.gather})
    begin({name});
  begin({choice_.shadow, queued});
  if (std::any_of(scene.lights.begin(), scene.lights.end(), isArea)) begin({choice_.areaShadow, queued});
  if (scene.atmosphere.environment.present()) begin({choice_.environmentShadow, queued});
  if (queued != 0) begin({"classify.comp"});
  const std::uint32_t first = settings.aovs.empty() ? 0 : kVariantAovs;
  for (const std::uint32_t variant : {first, 0u}) {
    if (variant != first && !branches(plan)) continue;
    for (std::uint32_t c = 0; c < classes_.classes.size(); ++c) begin({"shade.comp", variant | kVariantQueue, c});
    if (queued == 0) begin({"shade.comp", variant});
  }
}

void KernelPipelines::begin(const KernelKey& key) {
  if (key.kernel.empty() || pending_.contains(key)) return;
  pending_[key] = std::async(std::launch::async, [this, key] {
    gpu::ComputePipeline pipeline = makeOn(device_, layout_, key);
    if (key.kernel == choice_.shadow && warmUp_.compiles()) compileElsewhere(key);
    warmUp_.add(pipeline);
    return pipeline;
  });
}

// A software driver compiles kernels one after the other. A second instance of it compiles beside the first, and leaves
// the code in the driver's cache on disk, at the latest when it goes; there the first finds it.
void KernelPipelines::compileElsewhere(const KernelKey& key) const {
  if (device_.validationOn() || !driverKeepsCode()) return;  // validation would watch both
  try {
    gpu::DeviceOptions options;
    options.selector = std::to_string(device_.info().index);
    const gpu::Device other = gpu::Device::open(options);
    const gpu::BindingLayout layout = layoutOn(other, choice_, (variant_ & kVariantTiles) != 0);
    const gpu::ComputePipeline pipeline = makeOn(other, layout, key);
    gpu::WarmUp(other, layout).add(pipeline);
  } catch (const Error&) {
    // The first device does it all, then.
  }
}

// Threads first, since they use the warm-up; then the warm-up, since it uses what they made.
KernelPipelines::~KernelPipelines() {
  for (auto& [key, making] : pending_) making.wait();
  warmUp_ = {};
}

bool KernelPipelines::serve(const gpu::DeviceInfo& device, const Scene& scene, const Plan& plan,
                            const RenderSettings& settings, bool sharedTrees) const {
  const bool samePlan = plan.models == plan_.models && plan.lights == plan_.lights && plan.shapes == plan_.shapes &&
                        plan.effects == plan_.effects;
  const std::uint32_t variant = variantOf(scene, plan, settings, choice_) | (sharedTrees ? kVariantInstances : 0u);
  return samePlan && chooseKernels(device, plan, settings, sharedTrees) == choice_ && variant == variant_ &&
         classifyHits(scene, plan, settings) == classes_;
}

void KernelPipelines::wait() {
  while (!pending_.empty()) get(KernelKey(pending_.begin()->first));
}

gpu::Constants KernelPipelines::constants() const { return constantsOf(plan_, variant_ & ~kVariantTiles); }

gpu::ComputePipeline KernelPipelines::makeOn(const gpu::Device& device, const gpu::BindingLayout& layout,
                                             const KernelKey& key) const {
  const Plan& plan = key.hitClass ? classes_.classes[*key.hitClass].plan : plan_;
  return {device, layout, codeOf(key.kernel, choice_), constantsOf(plan, variant_ | key.variant)};
}

const gpu::ComputePipeline& KernelPipelines::get(const KernelKey& key) {
  const auto found = pending_.find(key);
  if (found != pending_.end()) {
    ready_[key] = found->second.get();
    pending_.erase(found);
  }
  gpu::ComputePipeline& pipeline = ready_[key];
  if (!pipeline) pipeline = makeOn(device_, layout_, key);
  return pipeline;
}

}  // namespace crosslight
