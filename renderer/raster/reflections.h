// Mirrors of the raster methods: pictures of the scene as flat mirrors see it, drawn for every sample at the place that
// the mirror turns it to, and cubes of pictures around other mirrors, drawn once. One reflection deep: what is seen in
// a mirror reflects nothing.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "effects/effects.h"
#include "film/film.h"
#include "raster/reflector_plan.h"
#include "raster_bindings.h"
#include "upload/gpu_scene.h"

namespace crosslight {

class Reflections {
 public:
  // `scene`, `settings` and `film` must outlive it.
  Reflections(const gpu::Device& device, const GpuScene& scene, const Plan& plan, const RenderSettings& settings,
              const FilmBuffers& film);
  ~Reflections();

  std::vector<gpu::Binding> bindings() const;  // none without pictures
  gpu::Constants constants() const;
  void bind(gpu::BindingSet& set) const;
  // Draws what the sample's mirrors show; before what shows them. Times are added as "reflections".
  void draw(const SampleRequest& request, Tally& tally);
  std::string promise() const;
  std::map<std::string, std::uint64_t> counters() const;

 private:
  struct View;
  std::unique_ptr<View> viewOf(Scene scene, RenderSettings settings, std::uint64_t pixels) const;
  std::unique_ptr<View> pictureOf(const MirrorPlane& plane) const;
  std::unique_ptr<View> cubeOf(const ProbePlace& probe) const;
  void makeRecords();
  void drawCube(std::size_t probe, Tally& tally);
  void copy(const View& view, std::uint64_t texel, std::uint64_t pixels, Tally& tally);
  std::uint64_t cubePixels() const { return 6 * facePixels(); }
  std::uint64_t facePixels() const { return std::uint64_t{settings_.probeSize} * settings_.probeSize; }
  std::uint64_t firstOfProbe(std::size_t probe) const;

  const gpu::Device& device_;
  const GpuScene& scene_;
  const RenderSettings& settings_;
  std::uint32_t mode_ = shared::kReflectionsOff;
  std::uint64_t bandPixels_ = 0;
  ReflectorPlan plan_;
  std::vector<std::unique_ptr<View>> pictures_;  // of plan_.planes
  gpu::Buffer records_, texels_;
  gpu::Commands commands_;
  bool cubesDrawn_ = false;
};

}  // namespace crosslight
