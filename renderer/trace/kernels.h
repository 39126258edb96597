// Which kernels trace which rays on a device, and their pipelines, made in threads while other work goes on.
#pragma once

#include <future>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "effects/effects.h"
#include "effects/hit_classes.h"
#include "gpu/pipeline.h"
#include "gpu/warm_up.h"
#include "scene/settings.h"
#include "upload/gpu_scene.h"

namespace crosslight {

// Kernels for this device: what `devices` shows and `--kernel auto` takes. Packets need subgroups of 8 lanes, and pay
// where a driver runs both sides of every branch. Ray queries are taken nowhere until they have been measured faster on
// that kind of device: on llvmpipe they are slower (README), on hardware nobody has measured.
KernelFamily familyFor(const gpu::DeviceInfo& device);
// Why a device cannot run a family; empty: it can.
std::string whyNot(KernelFamily family, const gpu::DeviceInfo& device);
// UsageError for a name that is none.
KernelFamily kernelFamilyOf(const std::string& name);
std::vector<std::string> kernelFamilyNames();
const char* nameOf(KernelFamily family);
const char* describe(KernelFamily family);

// Files of the kernels that a plan runs; empty: no such pass.
struct KernelChoice {
  std::string camera;      // closest triangle of the camera's rays
  std::string cameraRest;  // does again what packets gave up; empty: `camera` gives nothing up
  std::string secondary;   // closest triangle of stored rays
  std::string shapes;      // nearer analytic shapes
  std::string shadow;
  std::string shadowRest;
  std::string environmentShadow;
  std::string areaShadow;  // of lights with an area; empty: one ray to their middle, by `shadow`
  std::string smoke;
  std::string gather;
  bool wideTree = false;   // a tree with eight children per node is walked
  bool quadTree = false;   // one with four
  bool instances = false;  // trees that instances share are walked
  bool byDevice = false;   // no tree over triangles is walked: the device searches
  KernelFamily family = KernelFamily::perLane;

  bool operator==(const KernelChoice&) const = default;
};
// DeviceError when a forced family cannot run on this device.
KernelChoice chooseKernels(const gpu::DeviceInfo& device, const Plan& plan, const RenderSettings& settings,
                           bool sharedTrees = false);

// The choice as it suits a scene: trees with more than two children may be too deep for the
// stacks.
KernelChoice forTree(KernelChoice choice, const GpuScene& scene);

// Do surfaces send rays on?
bool branches(const Plan& plan);

// One pipeline: a kernel with bits of kSpecVariant beside the scene's own, and the class of hits whose plan it has.
struct KernelKey {
  std::string kernel;
  std::uint32_t variant = 0;
  std::optional<std::uint32_t> hitClass = {};  // none: the whole scene's plan

  auto operator<=>(const KernelKey&) const = default;
};

// The pipelines of a choice, each made in a thread of its own: a driver takes 100 ms and more for the larger ones.
class KernelPipelines {
 public:
  // All but `device` may go afterwards.
  KernelPipelines(const gpu::Device& device, const Scene& scene, const Plan& plan, const RenderSettings& settings,
                  bool sharedTrees = false);
  KernelPipelines(const KernelPipelines&) = delete;
  KernelPipelines& operator=(const KernelPipelines&) = delete;
  ~KernelPipelines();
  // Would pipelines made for these be the same?
  bool serve(const gpu::DeviceInfo& device, const Scene& scene, const Plan& plan, const RenderSettings& settings,
             bool sharedTrees = false) const;
  void wait();  // until all are made
  const KernelChoice& choice() const { return choice_; }
  const gpu::BindingLayout& layout() const { return layout_; }
  const HitClasses& classes() const { return classes_; }  // none: hits are not queued
  gpu::Constants constants() const;                       // of the whole scene's plan, for kernels beside the choice
  // Waits for it; makes it when it was not begun: few scenes need kVariantRest.
  const gpu::ComputePipeline& get(const KernelKey& key);

 private:
  void begin(const KernelKey& key);
  gpu::ComputePipeline makeOn(const gpu::Device& device, const gpu::BindingLayout& layout, const KernelKey& key) const;
  void compileElsewhere(const KernelKey& key) const;

  const gpu::Device& device_;
  Plan plan_;
  KernelChoice choice_;
  std::uint32_t variant_;
  HitClasses classes_;
  gpu::BindingLayout layout_;
  std::map<KernelKey, std::future<gpu::ComputePipeline>> pending_;
  std::map<KernelKey, gpu::ComputePipeline> ready_;
  gpu::WarmUp warmUp_;
};

// Lights whose visibility is kept at once.
std::uint32_t lightBatch(std::uint32_t lightCount);

}  // namespace crosslight
