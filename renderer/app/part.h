// Shares of a picture: which rows belong to one, and the file that carries it to `crosslight merge`.
//
// A .clpart file: the eight bytes "CLPART1\n"; the length of the header, 64 bits little-endian; the header, JSON; the
// layers one after the other in the header's order, the part's rows from top to bottom, channels interleaved, 32-bit
// floats or unsigned integers, little-endian; FNV-1a (64 bits, little-endian) of everything before it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/record.h"
#include "film/film.h"
#include "image/image_io.h"

namespace crosslight {

struct Part {
  std::uint32_t index = 1;  // from 1
  std::uint32_t count = 1;
};

inline constexpr std::uint32_t kMostParts = 65536;

// "2/4"; UsageError otherwise.
Part partOf(const std::string& text);
bool isPartFile(const std::filesystem::path& output);

// The rows of one part: every count-th run of rows, eight runs per part where the image is high enough, so that a
// costly region is shared out. Runs are whole tiles of rays high, where that leaves every part a run.
std::vector<Band> rowsOfPart(const Part& part, std::uint32_t height);

// What a part says of itself. Parts of one picture agree in everything but `part`.
struct PartHeader {
  std::uint32_t width = 0, height = 0;
  Part part;
  Json same;  // version, commit, scene with its hash, settings, device, driver, metadata
  DisplayTransform display;
};

// Written whole or not at all.
void writePart(const std::filesystem::path& file, const PartHeader& header, const Image& rows);

// The whole picture of all parts, in any order. InputError that names the file when one is no part, cut off, damaged,
// of another picture or there twice; and the missing ones. Files are read one after the other, each into its rows.
struct Merged {
  Image image;
  DisplayTransform display;
};
Merged mergeParts(const std::vector<std::string>& files);

}  // namespace crosslight
