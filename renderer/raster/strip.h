// How a large picture is cut for drawing. A strip has a render target and a viewport of its own.
#pragma once

#include <cstdint>
#include <vector>

#include "film/film.h"

namespace crosslight {

// Rows of one strip that are drawn together.
struct Strip {
  std::uint32_t firstRow = 0;  // of the strip, in the picture: row 0 of the target
  Band rows;                   // those that are drawn, in the picture
};

// Rows of every strip but the last. `samples` per pixel.
std::uint32_t rowsPerStrip(std::uint32_t width, std::uint32_t height, std::uint32_t samples);

// The strips that a band touches. Where strips begin depends on the picture alone, not on the band: rasterizers
// interpolate in coordinates of the target, so a row's bits depend on where its target begins.
std::vector<Strip> stripsOf(const Band& band, std::uint32_t rowsPerStrip);

}  // namespace crosslight
