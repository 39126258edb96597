// From a scene and settings to an image and a record of everything that was measured on the way.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "image/image.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "trace/ray_tree.h"

namespace crosslight {

// One effect's verdict with its reason in words that name the object.
struct EffectRecord {
  std::string name;
  bool on = false;
  std::string reason;
  bool leftOut = false;  // called for, and off because asked
};

// The trees that rays walked; kind is empty for raster methods.
struct TreeRecord {
  std::string kind;    // "flat": one over all triangles; "two-level": one per mesh, and one over instances;
                       // "device": none, the device searches boxes of triangles by its own
  std::string reason;  // why instances share trees, or do not
  std::uint64_t instances = 0, trees = 0, bytes = 0, bytesSaved = 0;
  // Of the trees; moved and unchanged: those of the frame before; loaded: from the disk.
  std::uint64_t built = 0, moved = 0, unchanged = 0, loaded = 0;
};

struct RenderReport {
  // Wall milliseconds by phase, in order: "bvh", "upload", "pipelines", "render" (submit to idle, all samples),
  // "readback". Load, device and encode are the caller's.
  std::vector<std::pair<std::string, double>> timesMs;
  std::vector<std::pair<std::string, double>> gpuMs;  // by pass, from timestamps; empty where the device has none
  std::vector<EffectRecord> effects;
  std::vector<EffectRecord> lightShadows;  // by light, where shadows are on
  std::uint32_t rayDepth = 0;              // segments after the primary one that the scene can use
  std::string depthReason;
  std::map<std::string, std::uint64_t> rays;      // primary, shadow, reflection, refraction, passThrough
  std::map<std::string, std::uint64_t> counters;  // triangles, draws, bvhNodes, pixels, samples, ...
  std::uint64_t nonfinite = 0;                    // NaN or Inf samples seen by the film
  std::uint64_t deviceBytes = 0;                  // peak
  std::uint64_t neededBytes = 0;                  // estimated beforehand: picture and scene, on host and device
  std::string promise;                            // light paths that the method computes, Heckbert's notation
  std::string pixelFilter;                        // in words
  TreeRecord tree;
  std::vector<std::string> reused;  // of the session: "scene", "film", "kernels"
};

struct RenderResult {
  Image image;
  RenderReport report;
  std::optional<RayTree> rayTree = {};  // of RenderRequest::rayTreePixel
};

// Called with (done, total) of whatever is counted; may be empty. Ctrl-C is looked for between submissions.
using ProgressFunction = std::function<void(std::uint64_t done, std::uint64_t total)>;

// Throws DeviceError when the device lacks what the settings need (MSAA count, image size, memory: with figures),
// InternalError on non-finite results unless allowed, Interrupted on Ctrl-C.
RenderResult render(gpu::Device& device, const Scene& scene, const RenderSettings& settings,
                    const ProgressFunction& progress = {});

// Names as the command line has them, both ways; UsageError lists what there is.
const char* nameOf(Method method);
Method methodOf(const std::string& name);
std::vector<Method> allMethods();
bool isTraced(Method method);  // by rays, not through graphics pipelines

}  // namespace crosslight
