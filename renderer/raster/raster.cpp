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
#include "raster/pipelines.h"
#include "raster/reflections.h"
#include "raster/shadow_pass.h"
#include "raster/strip.h"
#include "raster/targets.h"
#include "upload/smoke_check.h"

namespace crosslight {

using namespace shared;

namespace {

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
        reflections_(device, scene, plan, settings, buffers),
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
    shadows_.make(device, layout_, rasterConstants(inputs(), kVaryingAll));
    shadows_.bind(set_);
    if (!lists_.transparent.empty()) {
      layers_.emplace(device, settings.width, stripRows_, settings.msaa, settings.maxLayerBytes);
      layers_->bind(set_);
    }
    reflections_.bind(set_);
    planDepth();
    pipelines_ = RasterPipelines(device, layout_, inputs());
    makeIndices(device);
  }

  void renderSample(const SampleRequest& request, Tally& tally) override {
    reflections_.draw(request, tally);
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
    return "E | L[DS_glossy]E: direct light " + shadows_.promise() + "; " + reflections_.promise() +
           "; no refraction; transparency without bending";
  }

  std::map<std::string, std::uint64_t> counters() const override {
    std::map<std::string, std::uint64_t> all = reflections_.counters();
    all.insert({{"draws", draws_},
                {"traversalsCapped", capped_},
                {"shadowMaps", shadows_.mapCount()},
                {"depthPrepass", prepass_.pays ? 1 : 0},
                {"transparentFragments", layers_ ? layers_->mostFragments() : 0}});
    return all;
  }

 private:
  std::vector<gpu::Binding> bindings() const {
    std::vector<gpu::Binding> all = sceneBindings({kBindAovs, kBindCounters});
    if (!lists_.transparent.empty()) {
      for (const gpu::Binding& binding : Layers::bindings()) all.push_back(binding);
    }
    for (const gpu::Binding& binding : DrawUniforms::bindings()) all.push_back(binding);
    for (const gpu::Binding& binding : shadows_.bindings()) all.push_back(binding);
    for (const gpu::Binding& binding : reflections_.bindings()) all.push_back(binding);
    if (buffers_.wantsCodes()) all.push_back({kBindDisplayCodes, gpu::BindingType::texelBufferUint1});
    return all;
  }

  PipelineInputs inputs() const {
    return {.plan = plan_,
            .settings = settings_,
            .lightCount = scene_.lightCount(),
            .shadows = shadows_.constants(),
            .reflections = reflections_.constants(),
            .colorFormat = targets_.colorFormat,
            .codes = buffers_.wantsCodes(),
            .layers = layers_.has_value(),
            .prepass = prepass_.pays,
            .layerConstants = layers_ ? layers_->constants() : gpu::Constants{}};
  }

  void planDepth() {
    if (settings_.method == Method::wireframe) return;
    const FrameRecord frame = makeFrameRecord(scene_.scene(), settings_, glm::vec2(0.5f));
    prepass_ = planPrepass(scene_.flat(), lists_, frame, settings_, scene_.lightCount());
  }

  // Walks that met the limit of steps, over all samples.
  void lookAtCounters() {
    std::array<std::uint32_t, kCounterCount> counters{};
    buffers_.counters.read(0, std::as_writable_bytes(std::span(counters)));
    if (counters[kCounterCapped] > 0 && capped_ == 0)
      logWarning("some shadow rays met the limit of traversal steps; what lies beyond it casts no shadow");
    capped_ = counters[kCounterCapped];
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
    // Modulo 2^32, as the shader's subtraction is: negative where the band begins before the strip.
    recordColor(strip, (band.firstRow - strip.firstRow) * settings_.width, before);
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

  void recordColor(const Strip& strip, std::uint32_t firstPixel, gpu::ColorBefore before) {
    gpu::RenderTargets targets;
    targets.depth = &targets_.depth;
    if (pipelines_.depthFill && !settings_.hiddenLines) {
      beginStrip(targets, strip);
      drawCalls(pipelines_.depthFill, lists_.opaque, firstPixel);
      commands_.endRendering();
      commands_.barrier();
      targets.clearDepth = false;
    }
    targets.color = targets_.multisampled ? &targets_.multisampled : &targets_.picture;
    targets.resolve = targets_.multisampled && !layers_ ? &targets_.picture : nullptr;
    targets.clearValue = glm::vec4(seenBackground(scene_.scene().atmosphere, settings_), 0.0f);
    if (pipelines_.background) targets.colorBefore = before;
    beginStrip(targets, strip);
    drawCalls(pipelines_.opaque, lists_.opaque, firstPixel);
    if (pipelines_.background) {
      commands_.bind(pipelines_.background, set_);
      commands_.cull(gpu::Commands::Cull::none, false);
      commands_.push(RasterPush{0, strip.firstRow, 0, 0, 0, buffers_.displayGain, 0, 0});
      commands_.draw(3);
    }
    commands_.endRendering();
    if (layers_) recordLayers(strip, firstPixel, targets);
  }

  // Over what is opaque: every transparent fragment nearer than it into lists, then the lists into the picture.
  void recordLayers(const Strip& strip, std::uint32_t firstPixel, gpu::RenderTargets targets) {
    layers_->clear(commands_, strip.rows.rowCount);
    commands_.barrier();
    layerFirstRow_ = strip.rows.firstRow - strip.firstRow;
    gpu::RenderTargets depthOnly;
    depthOnly.depth = targets.depth;
    depthOnly.clearDepth = targets.clearDepth = false;
    beginStrip(depthOnly, strip);
    drawCalls(pipelines_.keepLayers, lists_.transparent, firstPixel);
    commands_.endRendering();
    commands_.barrier();
    targets.colorBefore = gpu::ColorBefore::keep;
    targets.resolve = targets_.multisampled ? &targets_.picture : nullptr;
    beginStrip(targets, strip);
    commands_.bind(pipelines_.resolveLayers, set_);
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
    drawCalls(pipelines_.aovDepthPass, lists_.records, firstPixel);
    commands_.endRendering();
    commands_.barrier();
    targets.clearDepth = false;
    beginStrip(targets, strip);
    drawCalls(pipelines_.aovPass, lists_.records, firstPixel);
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
  Reflections reflections_;
  gpu::BindingLayout layout_;
  gpu::BindingSet set_;
  gpu::Commands commands_;
  std::uint32_t stripRows_;
  RasterTargets targets_;
  std::optional<Layers> layers_;  // where something is transparent
  std::uint32_t layerFirstRow_ = 0;
  RasterPipelines pipelines_;
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
