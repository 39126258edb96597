#include "raster/raster.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "effects/material_traits.h"
#include "raster/method_shaders.h"

namespace crosslight {

using namespace shared;

namespace {

// Filled triangles are pushed this far behind their own edges when hidden lines are removed: two units of the depth
// format's resolution and twice the polygon's slope cover a line's rasterisation, which runs up to one pixel outside.
constexpr float kWireBiasConstant = -2.0f;
constexpr float kWireBiasSlope = -2.0f;

class Raster final : public Technique {
 public:
  Raster(const gpu::Device& device, GpuScene& scene, const Plan& plan, const RenderSettings& settings,
         FilmBuffers& buffers)
      : scene_(scene),
        plan_(plan),
        settings_(settings),
        buffers_(buffers),
        layout_(device, sceneBindings({kBindAovs}), sizeof(RasterPush)),
        set_(device, layout_),
        commands_(device) {
    scene_.bind(set_);
    set_.set(kBindAovs, buffers.aovs);
    makeTargets(device);
    makePipelines(device);
    makeIndices(device);
    sortTransparent();
  }

  void renderSample(const SampleRequest& request, Tally& tally) override {
    scene_.setSample(request.offset);
    commands_.begin();
    if (request.color) {
      commands_.beginSpan("raster");
      recordColor(request);
      commands_.endSpan();
      commands_.beginSpan("copy");
      commands_.copyToBuffer(settings_.msaa > 1 ? resolved_ : color_, request.band.firstRow, request.band.rowCount,
                             buffers_.sampleColor);
      commands_.endSpan();
    }
    if (request.aovs) {
      commands_.beginSpan("aovs");
      recordAovs(request);
      commands_.endSpan();
    }
    commands_.barrier();
    commands_.submitAndWait();
    tally.add(commands_.spans());
  }

  std::string promise() const override {
    if (settings_.method == Method::wireframe) return "none: edges in the surface's own color, no lighting";
    return "E | L[DS_glossy]E: direct light without shadows; no reflection, no refraction; transparency without "
           "bending";
  }

  std::map<std::string, std::uint64_t> counters() const override { return {{"draws", draws_}}; }

 private:
  void makeTargets(const gpu::Device& device) {
    const std::uint32_t w = settings_.width, h = settings_.height, samples = settings_.msaa;
    color_ = gpu::Image(device, "color", gpu::ImageFormat::rgba32f, w, h, samples);
    depth_ = gpu::Image(device, "depth", gpu::ImageFormat::depth32f, w, h, samples);
    if (samples > 1) resolved_ = gpu::Image(device, "resolved color", gpu::ImageFormat::rgba32f, w, h, 1);
    if (!settings_.aovs.empty()) aovDepth_ = gpu::Image(device, "AOV depth", gpu::ImageFormat::depth32f, w, h, 1);
  }

  gpu::GraphicsState baseState(std::string_view vertex, std::string_view fragment) const {
    using enum gpu::VertexFormat;
    gpu::GraphicsState s;
    s.vertex = gpu::embeddedShader(vertex);
    if (!fragment.empty()) s.fragment = gpu::embeddedShader(fragment);
    s.constants = constantsOf(plan_);
    s.buffers = {{sizeof(glm::vec3)}, {sizeof(VertexAttributes)}};
    s.attributes = {{0, 0, 0, float3},
                    {1, 1, offsetof(VertexAttributes, renderNormal), float3},
                    {2, 1, offsetof(VertexAttributes, renderTangent), float4},
                    {3, 1, offsetof(VertexAttributes, uv0), float2},
                    {4, 1, offsetof(VertexAttributes, uv1), float2},
                    {5, 1, offsetof(VertexAttributes, color), float4}};
    s.samples = settings_.msaa;
    return s;
  }

  // Depth alone; fragments only where an alpha mask cuts.
  gpu::GraphicsState depthState() const {
    gpu::GraphicsState s = baseState("phong.vert", plan_.has(Effect::alphaMask) ? "mask.frag" : "");
    s.colorTarget = false;
    return s;
  }

  // Of the picture only: the AOVs hold the parts before the clamp, which has none.
  bool clampsColors() const {
    return settings_.clampVertexColors && (settings_.method == Method::flat || settings_.method == Method::gouraud);
  }

  void makePipelines(const gpu::Device& device) {
    const MethodShaders shaders = shadersOf(settings_);
    gpu::GraphicsState color = baseState(shaders.vertex, shaders.fragment);
    color.constants = constantsOf(plan_, clampsColors() ? kVariantClampVertexColors : 0u);
    if (settings_.method == Method::wireframe) {
      color.polygonMode = gpu::PolygonMode::line;
      color.depthTest = gpu::DepthTest::greaterOrEqual;
      gpu::GraphicsState fill = depthState();
      fill.depthBiasConstant = kWireBiasConstant;
      fill.depthBiasSlope = kWireBiasSlope;
      depthFill_ = gpu::GraphicsPipeline(device, layout_, fill);
    }
    opaque_ = gpu::GraphicsPipeline(device, layout_, color);
    if (plan_.has(Effect::transparency)) {
      color.blend = gpu::Blend::overPremultiplied;
      color.depthWrite = false;
      blended_ = gpu::GraphicsPipeline(device, layout_, color);
    }
    if (settings_.aovs.empty()) return;
    gpu::GraphicsState depth = depthState();
    depth.vertex = gpu::embeddedShader(shaders.vertex);  // the same program as the pass that tests for equality
    depth.samples = 1;
    aovDepthPass_ = gpu::GraphicsPipeline(device, layout_, depth);
    gpu::GraphicsState aov = baseState(shaders.vertex, shaders.aovFragment);
    aov.colorTarget = false;
    aov.samples = 1;
    aov.depthTest = gpu::DepthTest::equal;
    aov.depthWrite = false;
    aovPass_ = gpu::GraphicsPipeline(device, layout_, aov);
  }

  // OpenGL's flat shading takes the last vertex; Vulkan's provoking vertex is the first: the corners are rotated.
  void makeIndices(const gpu::Device& device) {
    if (settings_.method != Method::flat || settings_.flatVertex != FlatVertex::last) return;
    std::vector<std::uint32_t> rotated = scene_.flat().indices;
    for (std::size_t i = 0; i + 2 < rotated.size(); i += 3) {
      std::rotate(rotated.begin() + static_cast<std::ptrdiff_t>(i),
                  rotated.begin() + static_cast<std::ptrdiff_t>(i + 2),
                  rotated.begin() + static_cast<std::ptrdiff_t>(i + 3));
    }
    rotatedIndices_ = gpu::Buffer::of(device, "rotated indices", rotated, gpu::useIndex);
  }

  bool isBlended(const DrawRecord& draw) const {
    return plan_.has(Effect::transparency) && settings_.method != Method::wireframe &&
           isTransparent(scene_.scene().materials[draw.materialId]);
  }

  // Transparent triangles from far to near by their centroid: exact unless triangles intersect or overlap cyclically.
  void sortTransparent() {
    const FlatScene& flat = scene_.flat();
    for (std::uint32_t d = 0; d < flat.meshDrawCount; ++d) {
      const DrawRecord& draw = flat.draws[d];
      if (!isBlended(draw)) continue;
      for (std::uint32_t t = 0; t < draw.triangleCount; ++t) sorted_.push_back({draw.firstTriangle + t, d, 0.0f});
    }
    for (SortedTriangle& s : sorted_) {
      const auto corner = [&](std::uint32_t k) { return flat.positions[flat.indices[3 * s.triangle + k]]; };
      const glm::vec3 centroid = (corner(0) + corner(1) + corner(2)) / 3.0f;
      s.distance = glm::dot(centroid, centroid);
    }
    std::stable_sort(sorted_.begin(), sorted_.end(),
                     [](const SortedTriangle& a, const SortedTriangle& b) { return a.distance > b.distance; });
  }

  void bindMeshes(const gpu::GraphicsPipeline& pipeline) {
    commands_.bind(pipeline, set_);
    commands_.bindVertexBuffer(0, scene_.positions());
    commands_.bindVertexBuffer(1, scene_.attributes());
    commands_.bindIndexBuffer(rotatedIndices_ ? rotatedIndices_ : scene_.indices());
  }

  void drawTriangles(std::uint32_t drawId, std::uint32_t firstTriangle, std::uint32_t count, std::uint32_t firstPixel) {
    const DrawRecord& draw = scene_.flat().draws[drawId];
    const Material& material = scene_.scene().materials[draw.materialId];
    const bool both =
        material.doubleSided || settings_.twoSided == TwoSided::always || settings_.method == Method::wireframe;
    commands_.cull(both ? gpu::Commands::Cull::none : gpu::Commands::Cull::back, (draw.flags & kDrawFlipsWinding) != 0);
    commands_.push(RasterPush{firstTriangle, firstPixel});
    commands_.drawIndexed(3 * count, 3 * firstTriangle, 0, drawId);
    ++draws_;
  }

  void drawAll(const gpu::GraphicsPipeline& pipeline, bool withBlended, std::uint32_t firstPixel) {
    bindMeshes(pipeline);
    const FlatScene& flat = scene_.flat();
    for (std::uint32_t d = 0; d < flat.meshDrawCount; ++d) {
      if (!withBlended && isBlended(flat.draws[d])) continue;
      drawTriangles(d, flat.draws[d].firstTriangle, flat.draws[d].triangleCount, firstPixel);
    }
  }

  // Runs of neighbours in the sorted order that are neighbours in the mesh too become one draw.
  void drawSorted() {
    bindMeshes(blended_);
    for (std::size_t i = 0; i < sorted_.size();) {
      std::size_t end = i + 1;
      while (end < sorted_.size() && sorted_[end].drawId == sorted_[i].drawId &&
             sorted_[end].triangle == sorted_[end - 1].triangle + 1) {
        ++end;
      }
      drawTriangles(sorted_[i].drawId, sorted_[i].triangle, static_cast<std::uint32_t>(end - i), 0);
      i = end;
    }
  }

  void recordColor(const SampleRequest& request) {
    gpu::RenderTargets targets;
    if (depthFill_ && !settings_.hiddenLines) {
      targets.depth = &depth_;
      commands_.beginRendering(targets);
      commands_.scissorRows(request.band.firstRow, request.band.rowCount);
      drawAll(depthFill_, true, 0);
      commands_.endRendering();
      commands_.barrier();
      targets.clearDepth = false;
    }
    targets.color = &color_;
    targets.resolve = settings_.msaa > 1 ? &resolved_ : nullptr;
    targets.depth = &depth_;
    targets.clearValue = glm::vec4(scene_.scene().atmosphere.background, 0.0f);
    commands_.beginRendering(targets);
    commands_.scissorRows(request.band.firstRow, request.band.rowCount);
    drawAll(opaque_, false, 0);
    if (!sorted_.empty()) drawSorted();
    commands_.endRendering();
  }

  void recordAovs(const SampleRequest& request) {
    const std::uint32_t firstPixel = request.band.firstRow * request.width;
    gpu::RenderTargets targets;
    targets.depth = &aovDepth_;
    commands_.beginRendering(targets);
    commands_.scissorRows(request.band.firstRow, request.band.rowCount);
    drawAll(aovDepthPass_, true, firstPixel);
    commands_.endRendering();
    commands_.barrier();
    targets.clearDepth = false;
    commands_.beginRendering(targets);
    commands_.scissorRows(request.band.firstRow, request.band.rowCount);
    drawAll(aovPass_, true, firstPixel);
    commands_.endRendering();
  }

  struct SortedTriangle {
    std::uint32_t triangle, drawId;
    float distance;  // squared
  };

  GpuScene& scene_;
  const Plan& plan_;
  const RenderSettings& settings_;
  FilmBuffers& buffers_;
  gpu::BindingLayout layout_;
  gpu::BindingSet set_;
  gpu::Commands commands_;
  gpu::Image color_, resolved_, depth_, aovDepth_;
  gpu::GraphicsPipeline opaque_, blended_, depthFill_, aovDepthPass_, aovPass_;
  gpu::Buffer rotatedIndices_;
  std::vector<SortedTriangle> sorted_;
  std::uint64_t draws_ = 0;
};

}  // namespace

std::unique_ptr<Technique> makeRaster(const gpu::Device& device, GpuScene& scene, const Plan& plan,
                                      const RenderSettings& settings, FilmBuffers& buffers) {
  return std::make_unique<Raster>(device, scene, plan, settings, buffers);
}

}  // namespace crosslight
