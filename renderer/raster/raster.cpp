#include "raster/raster.h"

#include <algorithm>
#include <array>
#include <optional>

#include "base/check.h"
#include "base/log.h"
#include "raster/depth_prepass.h"
#include "raster/draw_list.h"
#include "raster/draw_uniforms.h"
#include "raster/layers.h"
#include "raster/method_shaders.h"
#include "raster/shadow_pass.h"
#include "raster/strip.h"
#include "raster/targets.h"
#include "upload/smoke_check.h"

namespace crosslight {

using namespace shared;

namespace {

// Filled triangles are pushed this far behind their own edges when hidden lines are removed: two units of the depth
// format's resolution and twice the polygon's slope cover a line's rasterisation, which runs up to one pixel outside.
constexpr float kWireBiasConstant = -2.0f;
constexpr float kWireBiasSlope = -2.0f;

// A prepass lies behind what it stands for: the pass that lights then finds the nearest surfaces by the same test, in
// the same order, as without it. Farther by 4 units of the depth format at a triangle's nearest point: rounding takes
// one.
constexpr float kPrepassBias = -4.0f;

class Raster final : public Technique {
 public:
  Raster(const gpu::Device& device, GpuScene& scene, const Plan& plan, const RenderSettings& settings,
         FilmBuffers& buffers)
      : scene_(scene),
        plan_(plan),
        settings_(settings),
        buffers_(buffers),
        lists_(makeDrawLists(scene.flat(), scene.scene(), plan, settings)),
        uniforms_(device, scene),
        shadows_(device, scene, plan, settings),
        layout_(device, bindings(), std::max(sizeof(RasterPush), sizeof(VertexShadowPush))),
        set_(device, layout_),
        commands_(device),
        stripRows_(rowsPerStrip(settings.width, settings.height, settings.msaa)),
        targets_(device, settings, stripRows_, buffers) {
    CL_CHECK(!buffers.wantsCodes() || canDrawCodes(plan, settings));
    checkSmokeLoops(device.info(), scene.scene(), plan, settings);
    scene_.bind(set_);
    uniforms_.bind(set_);
    set_.set(kBindAovs, buffers.aovs);
    set_.set(kBindCounters, buffers.counters);
    if (buffers.wantsCodes()) set_.set(kBindDisplayCodes, buffers.codeTable);
    shadows_.make(device, layout_, constants(kVaryingAll));
    shadows_.bind(set_);
    if (!lists_.transparent.empty()) {
      layers_.emplace(device, settings.width, stripRows_, settings.msaa, settings.maxLayerBytes);
      layers_->bind(set_);
    }
    makePipelines(device);
    makeIndices(device);
  }

  void renderSample(const SampleRequest& request, Tally& tally) override {
    scene_.setSample(request.offset);
    commands_.begin();
    shadows_.record(commands_, set_);
    for (const Strip& strip : stripsOf(request.band, stripRows_)) {
      if (request.color && layers_) drawLayered(strip, request.band, tally);
      if (request.color && !layers_) drawColor(strip, request.band);
      if (request.aovs) drawAovs(strip, request.band);
    }
    commands_.barrier();
    commands_.submitAndWait();
    tally.add(commands_.spans());
    if (shadows_.walksTrees()) lookAtCounters();
  }

  std::string promise() const override {
    if (settings_.method == Method::wireframe) return "none: edges in the surface's own color, no lighting";
    return "E | L[DS_glossy]E: direct light " + shadows_.promise() +
           "; no reflection, no refraction; transparency without bending";
  }

  std::map<std::string, std::uint64_t> counters() const override {
    return {{"draws", draws_},
            {"traversalsCapped", capped_},
            {"shadowMaps", shadows_.mapCount()},
            {"depthPrepass", prepass_.pays ? 1 : 0},
            {"transparentFragments", layers_ ? layers_->mostFragments() : 0}};
  }

 private:
  std::vector<gpu::Binding> bindings() const {
    std::vector<gpu::Binding> all = sceneBindings({kBindAovs, kBindCounters});
    if (!lists_.transparent.empty()) {
      for (const gpu::Binding& binding : Layers::bindings()) all.push_back(binding);
    }
    for (const gpu::Binding& binding : DrawUniforms::bindings()) all.push_back(binding);
    for (const gpu::Binding& binding : shadows_.bindings()) all.push_back(binding);
    if (buffers_.wantsCodes()) all.push_back({kBindDisplayCodes, gpu::BindingType::texelBufferUint1});
    return all;
  }

  gpu::Constants constants(std::uint32_t varyings, std::uint32_t variant = 0) const {
    gpu::Constants all = constantsOf(plan_, variant);
    const bool few = scene_.lightCount() <= kFewLights && !settings_.allEffects;
    all.push_back({kSpecVaryings, settings_.allEffects ? kVaryingAll : varyings});
    all.push_back({kSpecLightCount, few ? scene_.lightCount() : kManyLights});
    for (const gpu::Constant& constant : shadows_.constants()) all.push_back(constant);
    return all;
  }

  // Walks that met the limit of steps, over all samples.
  void lookAtCounters() {
    std::array<std::uint32_t, kCounterCount> counters{};
    buffers_.counters.read(0, std::as_writable_bytes(std::span(counters)));
    if (counters[kCounterCapped] > 0 && capped_ == 0)
      logWarning("some shadow rays met the limit of traversal steps; what lies beyond it casts no shadow");
    capped_ = counters[kCounterCapped];
  }

  gpu::GraphicsState baseState(std::string_view vertex, std::string_view fragment, std::uint32_t varyings) const {
    using enum gpu::VertexFormat;
    gpu::GraphicsState s;
    s.vertex = gpu::embeddedShader(vertex);
    if (!fragment.empty()) s.fragment = gpu::embeddedShader(fragment);
    s.constants = constants(varyings);
    s.buffers = {{sizeof(glm::vec3)}, {sizeof(VertexAttributes)}};
    s.attributes = {{0, 0, 0, float3},
                    {1, 1, offsetof(VertexAttributes, renderNormal), float3},
                    {2, 1, offsetof(VertexAttributes, renderTangent), float4},
                    {3, 1, offsetof(VertexAttributes, uv0), float2},
                    {4, 1, offsetof(VertexAttributes, uv1), float2},
                    {5, 1, offsetof(VertexAttributes, color), float4}};
    s.colorFormat = targets_.colorFormat;
    s.samples = settings_.msaa;
    s.shadePerSample = settings_.shadesPerSample && settings_.msaa > 1;
    return s;
  }

  // Depth alone; fragments only where an alpha mask cuts.
  gpu::GraphicsState depthState() const {
    gpu::GraphicsState s =
        baseState("phong.vert", plan_.has(Effect::alphaMask) ? "mask.frag" : "", depthVaryingsOf(plan_));
    s.colorTarget = false;
    return s;
  }

  // Where no surface was drawn the depth is still 0. Drawing there costs less than clearing what surfaces cover anyway:
  // llvmpipe clears formats of 16 bytes pixel by pixel (README).
  gpu::GraphicsState backgroundState() const {
    gpu::GraphicsState s;
    s.vertex = gpu::embeddedShader("background.vert");
    s.fragment = gpu::embeddedShader(backgroundShader(buffers_.wantsCodes()));
    s.constants = constants(0);
    s.colorFormat = targets_.colorFormat;
    s.samples = settings_.msaa;
    s.depthTest = gpu::DepthTest::equal;
    s.depthWrite = false;
    return s;
  }

  // Of the picture only: the AOVs hold the parts before the clamp, which has none.
  bool clampsColors() const {
    return settings_.clampVertexColors && (settings_.method == Method::flat || settings_.method == Method::gouraud);
  }

  void makePipelines(const gpu::Device& device) {
    const MethodShaders shaders = shadersOf(settings_, buffers_.wantsCodes());
    const std::uint32_t varyings = varyingsOf(settings_, plan_);
    gpu::GraphicsState color = baseState(shaders.vertex, shaders.fragment, varyings);
    color.constants = constants(varyings, clampsColors() ? kVariantClampVertexColors : 0u);
    if (settings_.method == Method::wireframe) {
      color.polygonMode = gpu::PolygonMode::line;
      color.depthTest = gpu::DepthTest::greaterOrEqual;
      gpu::GraphicsState fill = depthState();
      fill.depthBiasConstant = kWireBiasConstant;
      fill.depthBiasSlope = kWireBiasSlope;
      depthFill_ = gpu::GraphicsPipeline(device, layout_, fill);
    } else {
      background_ = gpu::GraphicsPipeline(device, layout_, backgroundState());
      makePrepass(device);
    }
    opaque_ = gpu::GraphicsPipeline(device, layout_, color);
    if (layers_) makeLayerPipelines(device, color, shaders);
    if (!settings_.aovs.empty()) makeAovPipelines(device, shaders);
  }

  void makePrepass(const gpu::Device& device) {
    const FrameRecord frame = makeFrameRecord(scene_.scene(), settings_, glm::vec2(0.5f));
    prepass_ = planPrepass(scene_.flat(), lists_, frame, settings_, scene_.lightCount());
    if (!prepass_.pays) return;
    gpu::GraphicsState fill = depthState();
    fill.depthBiasConstant = kPrepassBias;
    depthFill_ = gpu::GraphicsPipeline(device, layout_, fill);
  }

  void makeLayerPipelines(const gpu::Device& device, gpu::GraphicsState keep, const MethodShaders& shaders) {
    const gpu::Constants constants = layers_->constants();
    keep.fragment = gpu::embeddedShader(shaders.layersFragment);
    keep.colorTarget = keep.depthWrite = false;
    keep.constants.insert(keep.constants.end(), constants.begin(), constants.end());
    keepLayers_ = gpu::GraphicsPipeline(device, layout_, keep);
    gpu::GraphicsState resolve = backgroundState();
    resolve.fragment = gpu::embeddedShader("layers_resolve.frag");
    resolve.constants = constants;
    resolve.depthTest = gpu::DepthTest::off;
    resolve.blend = gpu::Blend::overPerChannel;
    resolveLayers_ = gpu::GraphicsPipeline(device, layout_, resolve);
  }

  void makeAovPipelines(const gpu::Device& device, const MethodShaders& shaders) {
    gpu::GraphicsState depth = depthState();
    depth.vertex = gpu::embeddedShader(shaders.vertex);  // the same program as the pass that tests for equality
    depth.constants = constants(kVaryingAll, kVariantSeparateSums);
    depth.samples = 1;
    depth.shadePerSample = false;
    aovDepthPass_ = gpu::GraphicsPipeline(device, layout_, depth);
    gpu::GraphicsState aov = baseState(shaders.vertex, shaders.aovFragment, kVaryingAll);
    aov.constants = constants(kVaryingAll, kVariantSeparateSums);
    aov.colorTarget = false;
    aov.samples = 1;
    aov.shadePerSample = false;
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

  void drawCalls(const gpu::GraphicsPipeline& pipeline, const std::vector<DrawCall>& calls, std::uint32_t firstPixel) {
    if (calls.empty()) return;
    commands_.bind(pipeline, set_);
    commands_.bindVertexBuffer(0, scene_.positions());
    commands_.bindVertexBuffer(1, scene_.attributes());
    commands_.bindIndexBuffer(rotatedIndices_ ? rotatedIndices_ : scene_.indices());
    std::uint32_t offset = 0;  // of the material, as bind() leaves it
    for (const DrawCall& call : calls) {
      if (uniforms_.offsetOf(call.materialId) != offset) {
        offset = uniforms_.offsetOf(call.materialId);
        commands_.moveWindows(set_, std::span(&offset, 1));
      }
      commands_.cull(call.cullsBackFaces ? gpu::Commands::Cull::back : gpu::Commands::Cull::none,
                     (call.flags & kDrawFlipsWinding) != 0);
      commands_.push(RasterPush{call.firstTriangle, firstPixel, call.drawId, call.materialId, call.flags,
                                buffers_.displayGain, layerFirstRow_, layers_ ? layers_->capacity() : 0});
      commands_.drawIndexed(3 * call.triangleCount, 3 * call.firstTriangle, 0, 0);
      ++draws_;
    }
  }

  void beginStrip(gpu::RenderTargets targets, const Strip& strip) {
    targets.firstRow = strip.rows.firstRow - strip.firstRow;
    targets.rowCount = strip.rows.rowCount;
    commands_.beginRendering(targets);
    commands_.viewportRows(strip.firstRow, settings_.height);
  }

  // Rows of the strip, as many at once as the lists have room for.
  void drawLayered(const Strip& strip, const Band& band, Tally& tally) {
    for (std::uint32_t done = 0; done < strip.rows.rowCount;) {
      const std::uint32_t count = std::min(layers_->rowsAtOnce(), strip.rows.rowCount - done);
      const Strip part{strip.firstRow, {strip.rows.firstRow + done, count}};
      drawColor(part, band, done > 0 ? gpu::ColorBefore::keep : gpu::ColorBefore::undefined);
      commands_.submitAndWait();
      if (layers_->keptAll(part.rows, set_)) {
        tally.add(commands_.spans());
        done += count;
      }
      commands_.begin();
    }
  }

  void drawColor(const Strip& strip, const Band& band, gpu::ColorBefore before = gpu::ColorBefore::undefined) {
    commands_.beginSpan("raster");
    recordColor(strip, before);
    commands_.endSpan();
    if (targets_.areFilm) {
      CL_CHECK_EQ(band.firstRow, 0u);  // a film as large as the picture has one band
      return;
    }
    commands_.beginSpan("copy");
    const std::uint64_t offset =
        std::uint64_t{targets_.pixelBytes} * settings_.width * (strip.rows.firstRow - band.firstRow);
    commands_.copyToBuffer(targets_.picture, strip.rows.firstRow - strip.firstRow, strip.rows.rowCount,
                           buffers_.sampleColor, offset);
    commands_.endSpan();
  }

  void recordColor(const Strip& strip, gpu::ColorBefore before) {
    gpu::RenderTargets targets;
    targets.depth = &targets_.depth;
    if (depthFill_ && !settings_.hiddenLines) {
      beginStrip(targets, strip);
      drawCalls(depthFill_, lists_.opaque, 0);
      commands_.endRendering();
      commands_.barrier();
      targets.clearDepth = false;
    }
    targets.color = targets_.multisampled ? &targets_.multisampled : &targets_.picture;
    targets.resolve = targets_.multisampled && !layers_ ? &targets_.picture : nullptr;
    targets.clearValue = glm::vec4(seenBackground(scene_.scene().atmosphere, settings_), 0.0f);
    if (background_) targets.colorBefore = before;
    beginStrip(targets, strip);
    drawCalls(opaque_, lists_.opaque, 0);
    if (background_) {
      commands_.bind(background_, set_);
      commands_.cull(gpu::Commands::Cull::none, false);
      commands_.push(RasterPush{0, strip.firstRow, 0, 0, 0, buffers_.displayGain, 0, 0});
      commands_.draw(3);
    }
    commands_.endRendering();
    if (layers_) recordLayers(strip, targets);
  }

  // Over what is opaque: every transparent fragment nearer than it into lists, then the lists into the picture.
  void recordLayers(const Strip& strip, gpu::RenderTargets targets) {
    layers_->clear(commands_, strip.rows.rowCount);
    commands_.barrier();
    layerFirstRow_ = strip.rows.firstRow - strip.firstRow;
    gpu::RenderTargets depthOnly;
    depthOnly.depth = targets.depth;
    depthOnly.clearDepth = targets.clearDepth = false;
    beginStrip(depthOnly, strip);
    drawCalls(keepLayers_, lists_.transparent, 0);
    commands_.endRendering();
    commands_.barrier();
    targets.colorBefore = gpu::ColorBefore::keep;
    targets.resolve = targets_.multisampled ? &targets_.picture : nullptr;
    beginStrip(targets, strip);
    commands_.bind(resolveLayers_, set_);
    commands_.cull(gpu::Commands::Cull::none, false);
    commands_.push(RasterPush{0, 0, 0, 0, 0, buffers_.displayGain, layerFirstRow_, layers_->capacity()});
    commands_.draw(3);
    commands_.endRendering();
  }

  void drawAovs(const Strip& strip, const Band& band) {
    // Modulo 2^32, as the shader's subtraction is: negative where the band begins before the strip.
    const std::uint32_t firstPixel = (band.firstRow - strip.firstRow) * settings_.width;
    commands_.beginSpan("aovs");
    gpu::RenderTargets targets;
    targets.depth = &targets_.aovDepth;
    beginStrip(targets, strip);
    drawCalls(aovDepthPass_, lists_.records, firstPixel);
    commands_.endRendering();
    commands_.barrier();
    targets.clearDepth = false;
    beginStrip(targets, strip);
    drawCalls(aovPass_, lists_.records, firstPixel);
    commands_.endRendering();
    commands_.endSpan();
  }

  GpuScene& scene_;
  const Plan& plan_;
  const RenderSettings& settings_;
  FilmBuffers& buffers_;
  DrawLists lists_;
  DrawUniforms uniforms_;
  ShadowPass shadows_;
  gpu::BindingLayout layout_;
  gpu::BindingSet set_;
  gpu::Commands commands_;
  std::uint32_t stripRows_;
  RasterTargets targets_;
  std::optional<Layers> layers_;  // where something is transparent
  std::uint32_t layerFirstRow_ = 0;
  gpu::GraphicsPipeline opaque_, keepLayers_, resolveLayers_, background_, depthFill_, aovDepthPass_, aovPass_;
  gpu::Buffer rotatedIndices_;
  PrepassVerdict prepass_;
  std::uint64_t draws_ = 0, capped_ = 0;
};

}  // namespace

std::unique_ptr<Technique> makeRaster(const gpu::Device& device, GpuScene& scene, const Plan& plan,
                                      const RenderSettings& settings, FilmBuffers& buffers) {
  return std::make_unique<Raster>(device, scene, plan, settings, buffers);
}

}  // namespace crosslight
