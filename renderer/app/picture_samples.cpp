#include "app/picture_samples.h"

#include <fmt/format.h>

#include <array>

namespace crosslight {
namespace {

struct FilterRow {
  PixelFilter filter;
  FilterShape shape;
  const char* text;
};
constexpr std::array kFilters{
    FilterRow{PixelFilter::box, FilterShape::box, "box of one pixel"},
    FilterRow{PixelFilter::tent, FilterShape::tent, "tent of radius 1 pixel"},
    FilterRow{PixelFilter::gaussian, FilterShape::gaussian, "Gaussian of deviation 1/2 pixel, cut at 3/2"},
    FilterRow{PixelFilter::mitchell, FilterShape::mitchell, "Mitchell-Netravali of radius 2 pixels, B = C = 1/3"}};

struct SamplerRow {
  Sampler sampler;
  SamplePlacement placement;
};
constexpr std::array kSamplers{SamplerRow{Sampler::sobol, SamplePlacement::sobol},
                               SamplerRow{Sampler::regular, SamplePlacement::regular},
                               SamplerRow{Sampler::jittered, SamplePlacement::jittered}};

const FilterRow& rowOf(PixelFilter filter) {
  for (const FilterRow& row : kFilters) {
    if (row.filter == filter) return row;
  }
  return kFilters[0];
}

SamplePlacement placementOf(Sampler sampler) {
  for (const SamplerRow& row : kSamplers) {
    if (row.sampler == sampler) return row.placement;
  }
  return SamplePlacement::sobol;
}

std::string placesOf(const RenderSettings& s) {
  const SampleGrid grid = sampleGrid(s.spp);
  switch (s.sampler) {
    case Sampler::sobol:
      return fmt::format("{} samples of a (0,2)-sequence{}", s.spp, s.seed == 0 ? "" : ", Owen-scrambled");
    case Sampler::regular:
      return fmt::format("a regular grid of {} x {} samples", grid.columns, grid.rows);
    case Sampler::jittered:
      return fmt::format("a jittered grid of {} x {} samples", grid.columns, grid.rows);
  }
  return {};
}

}  // namespace

std::vector<PixelSample> samplesOf(const RenderSettings& s) {
  return samplePattern(s.spp, rowOf(s.filter).shape, s.seed, placementOf(s.sampler));
}

std::string describeSamples(const RenderSettings& s) {
  if (s.spp <= 1) return "one sample at the pixel's center";
  return fmt::format("{}, {}, the same in every pixel", rowOf(s.filter).text, placesOf(s));
}

std::string adviceOnSamples(const RenderSettings& s) {
  const SampleGrid grid = sampleGrid(s.spp);
  if (s.sampler == Sampler::sobol || grid.columns <= 2 * grid.rows) return {};
  std::uint32_t side = 1;
  while ((side + 1) * (side + 1) <= s.spp) ++side;
  return fmt::format("--spp {} makes a grid of {} x {} samples; {} or {} are square", s.spp, grid.columns, grid.rows,
                     side * side, (side + 1) * (side + 1));
}

}  // namespace crosslight
