#include "raster/strip.h"

#include <algorithm>

namespace crosslight {

namespace {

// Color and depth take 20 bytes per sample: 160 MiB. 3840x2160 with one sample is one strip.
constexpr std::uint64_t kStripSamples = std::uint64_t{1} << 23;

}  // namespace

std::uint32_t rowsPerStrip(std::uint32_t width, std::uint32_t height, std::uint32_t samples) {
  const std::uint64_t rows = std::max<std::uint64_t>(1, kStripSamples / (std::uint64_t{width} * samples));
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(rows, height));
}

std::vector<Strip> stripsOf(const Band& band, std::uint32_t rowsPerStrip) {
  const std::uint32_t end = band.firstRow + band.rowCount;
  std::vector<Strip> strips;
  for (std::uint32_t first = band.firstRow; first < end;) {
    const std::uint32_t stripFirst = first / rowsPerStrip * rowsPerStrip;
    const std::uint32_t stripEnd = std::min(stripFirst + rowsPerStrip, end);
    strips.push_back({stripFirst, {first, stripEnd - first}});
    first = stripEnd;
  }
  return strips;
}

}  // namespace crosslight
