#include "raster/targets.h"

#include "raster/raster.h"

namespace crosslight {

RasterTargets::RasterTargets(const gpu::Device& device, const RenderSettings& settings, std::uint32_t stripRows,
                             const FilmBuffers& buffers)
    : colorFormat(buffers.wantsCodes() ? gpu::ImageFormat::r32ui : gpu::ImageFormat::rgba32f),
      pixelBytes(buffers.wantsCodes() ? sizeof(std::uint32_t) : sizeof(glm::vec4)) {
  const std::uint32_t w = settings.width, h = stripRows, samples = settings.msaa;
  if (h == settings.height && buffers.sampleColor.sizeBytes() >= std::uint64_t{pixelBytes} * w * settings.height) {
    picture = gpu::Image::over(device, "sample", colorFormat, buffers.sampleColor, w, h);
  }
  areFilm = bool(picture);
  if (!picture) picture = gpu::Image(device, "color", colorFormat, w, h);
  if (samples > 1) multisampled = gpu::Image(device, "samples", colorFormat, w, h, samples);
  depth = gpu::Image(device, "depth", gpu::ImageFormat::depth32f, w, h, samples);
  if (!settings.aovs.empty()) aovDepth = gpu::Image(device, "AOV depth", gpu::ImageFormat::depth32f, w, h, 1);
}

bool canDrawCodes(const Plan& plan, const RenderSettings& settings) {
  const bool shaded =
      settings.method == Method::flat || settings.method == Method::gouraud || settings.method == Method::phong;
  return shaded && settings.spp == 1 && settings.msaa == 1 && settings.aovs.empty() &&
         !plan.has(Effect::transparency) &&
         !(plan.has(Effect::reflection) && settings.rasterReflections != RasterReflections::off);
}

}  // namespace crosslight
