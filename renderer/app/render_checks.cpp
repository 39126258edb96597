#include "app/render_checks.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>

#include "accel/wide_bvh.h"
#include "app/picture_layers.h"
#include "base/check.h"
#include "base/error.h"
#include "effects/forced.h"
#include "effects/material_traits.h"
#include "gpu/box_search.h"
#include "raster/strip.h"

namespace crosslight {

void checkAgainstDevice(const gpu::DeviceInfo& info, const RenderSettings& s) {
  const std::uint32_t size = std::max(s.width, s.height);
  if (!isTraced(s.method) && size > info.maxImageSize) {
    throw DeviceError(fmt::format("{}x{} pixels: '{}' draws images of up to {} pixels a side", s.width, s.height,
                                  info.name, info.maxImageSize));
  }
  if (isTraced(s.method) && s.msaa > 1) {
    throw UsageError("MSAA belongs to the raster methods: use --spp with whitted");
  }
  if (s.shadesPerSample && s.msaa > 1 && !info.hasSampleShading)
    throw DeviceError(
        fmt::format("'{}' cannot light single coverage samples: leave out --set msaa.shading=sample, "
                    "and use --spp",
                    info.name));
  const auto& counts = info.msaaCounts;
  if (std::find(counts.begin(), counts.end(), s.msaa) != counts.end() || isTraced(s.method)) return;
  throw DeviceError(
      fmt::format("MSAA {}: '{}' supports {}; use one of these, or --spp", s.msaa, info.name, fmt::join(counts, ", ")));
}

void checkSettings(const Scene& scene, const RenderSettings& s) {
  CL_CHECK_LT(static_cast<std::size_t>(s.camera), scene.cameras.size());
  CL_CHECK(s.width > 0 && s.height > 0 && s.spp > 0);
  for (const std::string& name : s.aovs) {
    const bool known =
        std::any_of(std::begin(kAovNames), std::end(kAovNames), [&](const char* n) { return name == n; });
    if (!known) throw UsageError(fmt::format("no AOV '{}'; there are: {}", name, fmt::join(kAovNames, ", ")));
  }
  const std::vector<std::string> effects = effectNames();
  for (const ForcedEffect& forced : s.forcedEffects) {
    if (std::find(effects.begin(), effects.end(), forced.name) == effects.end())
      throw UsageError(fmt::format("no effect '{}'; there are: {}", forced.name, fmt::join(effects, ", ")));
  }
}

namespace {

constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();

std::uint64_t rowsOf(const RenderRequest& request) {
  if (request.rows.empty()) return request.settings.height;
  std::uint64_t rows = 0;
  for (const Band& band : request.rows) rows += band.rowCount;
  return rows;
}

// Color, depth, resolved color and the depth of the AOVs, of one strip of a raster method.
std::uint64_t targetBytes(const RenderSettings& s) {
  constexpr std::uint64_t kColor = 16, kDepth = 4;
  const std::uint64_t perPixel = s.msaa * (kColor + kDepth) + (s.msaa > 1 ? kColor : 0) + (s.aovs.empty() ? 0 : kDepth);
  return std::uint64_t{s.width} * rowsPerStrip(s.width, s.height, s.msaa) * perPixel;
}

// At most: with what is transparent, and every light a cube.
std::uint64_t shadowMapBytes(const Scene& scene, const RenderSettings& s) {
  if (s.rasterShadows != RasterShadows::maps) return 0;
  constexpr std::uint64_t kWords = 6, kWordBytes = 4, kFaces = 6, kTargets = 16 + 4 + 4;
  const std::uint64_t texels = std::uint64_t{s.shadowMaps.size} * s.shadowMaps.size;
  const bool pale = std::any_of(scene.materials.begin(), scene.materials.end(), isTransparent);
  return texels * (scene.lights.size() * kFaces * (pale ? kWords : 1) * kWordBytes + kTargets);
}

// The number after `key` in a file like /proc/meminfo, or the file's first number without a key.
std::optional<std::uint64_t> numberIn(const char* file, const std::string& key) {
  std::ifstream in(file);
  std::string word;
  while (in >> word) {
    if (!key.empty() && word != key) continue;
    if (!key.empty() && !(in >> word)) return std::nullopt;
    if (word.find_first_not_of("0123456789") != std::string::npos || word.size() > 19) return std::nullopt;
    return std::stoull(word);
  }
  return std::nullopt;
}

// What the process's control group leaves it; containers see the machine's figures in /proc/meminfo.
std::uint64_t leftInGroup() {
  const std::pair<const char*, const char*> files[] = {
      {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"},
      {"/sys/fs/cgroup/memory/memory.limit_in_bytes", "/sys/fs/cgroup/memory/memory.usage_in_bytes"}};
  for (const auto& [limitFile, usedFile] : files) {
    const auto limit = numberIn(limitFile, ""), used = numberIn(usedFile, "");
    if (limit && used) return *limit > *used ? *limit - *used : 0;
  }
  return kUnknown;
}

}  // namespace

std::uint64_t availableHostBytes() {
  const auto availableKiB = numberIn("/proc/meminfo", "MemAvailable:");
  return std::min(availableKiB ? *availableKiB * 1024 : kUnknown, leftInGroup());
}

MemoryLimits memoryLimitsOf(const gpu::DeviceInfo& info) {
  return {availableHostBytes(), info.deviceLocalBytes, info.isSoftware};
}

namespace {

// Bytes of a scene that is flattened, given a tree and moved to the device, at the three moments that need most.
struct SceneBytes {
  std::uint64_t building = 0, built = 0, onDevice = 0;
  std::uint64_t largestList = 0;  // on both sides while it is moved
  std::uint64_t kept = 0;         // trees for the next frame, or while they are written to disk
};

// Per triangle, of trees over 10 thousand to 20 million of them: 0.50 to 0.56 nodes, here three quarters; a wide node
// for 2.7 of those, a node of four for 1.6.
constexpr std::uint64_t kNodeBytes = 3 * sizeof(shared::BvhNode) / 4;
constexpr std::uint64_t kMoreNodesBytes =
    kNodeBytes * sizeof(WideNode) / (sizeof(shared::BvhNode) * 27 / 10) + kNodeBytes * 10 / 16;
constexpr std::uint64_t kTreeBytes = kNodeBytes + kMoreNodesBytes + sizeof(shared::BvhPrimitive);
// References on either side of a partition, and order; then order and each triangle's draw.
constexpr std::uint64_t kBuildBytes = 2 * 32 + 4 + kNodeBytes, kJoinBytes = 2 * 4;

// Where the device searches boxes itself: its structure over them, as llvmpipe has it (Mesa 25.0.7: 88 bytes); while it
// is built, the boxes and what the driver works in. A driver may need more: then its allocation fails with figures.
constexpr std::uint64_t kDeviceTreeBytes = 96, kDeviceBuildBytes = sizeof(gpu::SearchBox) + 40;

SceneBytes sceneBytes(const RenderRequest& request, std::uint64_t trianglesSaved) {
  const SceneStats& stats = request.scene->stats;
  const std::uint64_t attributes = stats.vertices * sizeof(shared::VertexAttributes);
  const std::uint64_t flat =
      attributes + stats.vertices * sizeof(glm::vec3) + stats.triangles * 3 * sizeof(std::uint32_t);
  std::uint64_t texels = 0;
  for (const TextureImage& image : request.scene->images) texels += image.rgba.size() * sizeof(float);
  const bool raster = !isTraced(request.settings.method);
  if (raster && request.settings.rasterShadows != RasterShadows::rays) {
    return {flat, flat, flat + texels, flat + texels};
  }
  if (!raster && request.settings.kernel == KernelFamily::rayQuery) {
    const std::uint64_t onHost = sizeof(shared::BvhPrimitive) + sizeof(gpu::SearchBox) + kJoinBytes;
    const std::uint64_t onDevice = sizeof(shared::BvhPrimitive) + kDeviceTreeBytes + kDeviceBuildBytes;
    return {flat, flat + stats.triangles * onHost, flat + texels + stats.triangles * onDevice,
            std::max({attributes, texels, stats.triangles * sizeof(shared::BvhPrimitive)})};
  }
  const std::uint64_t inTrees = stats.triangles - std::min(stats.triangles, trianglesSaved);
  const std::uint64_t kept =
      request.isFrame || !request.bvhCache.folder.empty() ? inTrees * (kNodeBytes + 4) : 0;  // or while it is written
  return {flat + inTrees * kBuildBytes + kept, flat + inTrees * (kTreeBytes + kJoinBytes) + kept,
          flat + texels + inTrees * kTreeBytes, std::max({attributes, texels, inTrees * kMoreNodesBytes}), kept};
}

}  // namespace

void checkLists(const gpu::DeviceInfo& info, const RenderRequest& request, std::uint64_t trianglesSaved) {
  constexpr std::uint64_t kTexelBytes = 16;
  const SceneStats& stats = request.scene->stats;
  const bool traced = isTraced(request.settings.method);
  const std::uint64_t inTrees = traced ? stats.triangles - std::min(stats.triangles, trianglesSaved) : 0;
  const auto check = [&](const char* what, std::uint64_t count, std::uint64_t bytesEach) {
    const std::uint64_t texels = count * bytesEach / kTexelBytes;
    if (texels <= info.maxTexelBufferElements) return;
    throw DeviceError(
        fmt::format("{}: {} {} take {} texels of 16 bytes, shaders of '{}' read lists of {} (maxTexelBufferElements): "
                    "at most {} {}; "
                    "draw the scene in several files",
                    request.scene->source.string(), count, what, texels, info.name, info.maxTexelBufferElements,
                    std::uint64_t{info.maxTexelBufferElements} * kTexelBytes / bytesEach, what));
  };
  check("vertices", stats.vertices, sizeof(shared::VertexAttributes));
  check("triangles", inTrees, sizeof(shared::BvhPrimitive));
}

MemoryNeed memoryNeedOf(const gpu::DeviceInfo& info, const RenderRequest& request, std::uint64_t trianglesSaved) {
  const RenderSettings& s = request.settings;
  const std::uint64_t pixels = rowsOf(request) * s.width;
  MemoryNeed need;
  need.hostPictureBytes = pixels * (layerBytesPerPixel(s.aovs) + request.fileBytesPerPixel);
  need.devicePictureBytes =
      filmBytes(info, {s.width, s.height, {}, !s.aovs.empty(), request.rows, {}, s.adaptiveError}) +
      (isTraced(s.method) ? 0 : targetBytes(s) + shadowMapBytes(*request.scene, s));
  const SceneBytes scene = sceneBytes(request, trianglesSaved);
  need.deviceSceneBytes = scene.onDevice;
  need.hostSceneBytes = std::max(scene.building, scene.built);
  // What the device takes over is let go of list by list: on shared memory the two do not add up.
  if (info.isSoftware) {
    need.hostSceneBytes =
        std::max(need.hostSceneBytes, scene.onDevice + scene.largestList + scene.kept) - scene.onDevice;
  }
  return need;
}

std::string inGiB(std::uint64_t bytes) { return fmt::format("{:.1f} GiB", static_cast<double>(bytes) / (1u << 30)); }

namespace {

// The least number of parts that fit; 0 when none does.
std::uint64_t partsThatFit(std::uint64_t fixedBytes, std::uint64_t sharedOutBytes, std::uint64_t limitBytes,
                           std::uint32_t height) {
  if (fixedBytes >= limitBytes) return 0;
  const std::uint64_t left = limitBytes - fixedBytes;
  const std::uint64_t parts = (sharedOutBytes + left - 1) / left;
  return parts <= height ? parts : 0;
}

[[noreturn]] void refuse(const std::string& what, const std::string& figures, std::uint64_t parts,
                         const RenderSettings& s) {
  std::string remedies =
      parts > 1 ? fmt::format("draw it in parts (--part 1/{}, ..., then 'crosslight merge'), ", parts) : "";
  remedies += "lower --resolution";
  if (!s.aovs.empty()) remedies += ", ask for fewer --aov";
  if (s.msaa > 1) remedies += ", lower --msaa";
  throw DeviceError(
      fmt::format("{}x{} pixels need more {} than there is: {}; {}", s.width, s.height, what, figures, remedies));
}

}  // namespace

void checkMemory(const MemoryNeed& need, const MemoryLimits& limits, const RenderSettings& s) {
  const std::uint64_t device = need.devicePictureBytes + need.deviceSceneBytes;
  const std::uint64_t host = need.hostPictureBytes + need.hostSceneBytes;
  const std::uint64_t onHost = host + (limits.shared ? device : 0);
  if (onHost > limits.hostBytes) {
    const std::string figures = fmt::format(
        "image {}, flattened scene {}{}, together {} of the {} that are available", inGiB(need.hostPictureBytes),
        inGiB(need.hostSceneBytes), limits.shared ? fmt::format(", and on the software device {}", inGiB(device)) : "",
        inGiB(onHost), inGiB(limits.hostBytes));
    refuse("memory", figures,
           partsThatFit(onHost - need.hostPictureBytes, need.hostPictureBytes, limits.hostBytes, s.height), s);
  }
  if (!limits.shared && device > limits.deviceBytes) {
    const std::string figures =
        fmt::format("film and targets {}, scene {}, together {} of the {} that it has", inGiB(need.devicePictureBytes),
                    inGiB(need.deviceSceneBytes), inGiB(device), inGiB(limits.deviceBytes));
    refuse("device memory", figures, 0, s);
  }
}

}  // namespace crosslight
