#include "raster/raster.h"

#include <algorithm>
#include <array>

#include "base/check.h"
#include "base/log.h"
#include "raster/depth_prepass.h"
#include "raster/draw_list.h"
#include "raster/draw_uniforms.h"
#include "raster/method_shaders.h"
#include "raster/shadow_pass.h"
#include "raster/strip.h"
#include "raster/targets.h"

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
    scene_.bind(set_);
    uniforms_.bind(set_);
    set_.set(kBindAovs, buffers.aovs);
    set_.set(kBindCounters, buffers.counters);
    if (buffers.wantsCodes()) set_.set(kBindDisplayCodes, buffers.codeTable);
    shadows_.make(device, layout_, constants(kVaryingAll));
    shadows_.bind(set_);
    makePipelines(device);
    makeIndices(device);
  }

  void renderSample(const SampleRequest& request, Tally& tally) override {
    scene_.setSample(request.offset);
    commands_.begin();
    shadows_.record(commands_, set_);
    for (const Strip& strip : stripsOf(request.band, stripRows_)) {
      if (request.color) drawColor(strip, request.band);
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
            {"depthPrepass", prepass_.pays ? 1 : 0}};
  }

 private:
  std::vector<gpu::Binding> bindings() const {
    std::vector<gpu::Binding> all = sceneBindings({kBindAovs, kBindCounters});
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
    if (plan_.has(Effect::transparency)) {
      color.blend = gpu::Blend::overPremultiplied;
      color.depthWrite = false;
      blended_ = gpu::GraphicsPipeline(device, layout_, color);
    }
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
      commands_.push(
          RasterPush{call.firstTriangle, firstPixel, call.drawId, call.materialId, call.flags, buffers_.displayGain});
      commands_.drawIndexed(3 * call.triangleCount, 3 * call.firstTriangle, 0, 0);
      ++draws_;
    }
  }

  void beginStrip(const gpu::RenderTargets& targets, const Strip& strip) {
    commands_.beginRendering(targets);
    commands_.viewportRows(strip.firstRow, settings_.height);
    commands_.scissorRows(strip.rows.firstRow - strip.firstRow, strip.rows.rowCount);
  }

  void drawColor(const Strip& strip, const Band& band) {
    commands_.beginSpan("raster");
    recordColor(strip);
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

  void recordColor(const Strip& strip) {
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
    targets.resolve = targets_.multisampled ? &targets_.picture : nullptr;
    targets.clearValue = glm::vec4(seenBackground(scene_.scene().atmosphere, settings_), 0.0f);
    if (background_) targets.colorBefore = gpu::ColorBefore::undefined;
    beginStrip(targets, strip);
    drawCalls(opaque_, lists_.opaque, 0);
    if (background_) {
      commands_.bind(background_, set_);
      commands_.cull(gpu::Commands::Cull::none, false);
      commands_.push(RasterPush{0, strip.firstRow, 0, 0, 0, buffers_.displayGain});
      commands_.draw(3);
    }
    drawCalls(blended_, lists_.blended, 0);
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
  gpu::GraphicsPipeline opaque_, blended_, background_, depthFill_, aovDepthPass_, aovPass_;
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
