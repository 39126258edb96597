// Which rows belong to a part, and the writing of its file.
#include "app/part.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fstream>

#include "app/part_format.h"
#include "base/check.h"
#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"

namespace crosslight {
namespace {

constexpr std::uint32_t kRunsPerPart = 8;
constexpr std::uint32_t kTileRows = 8;  // of the rays' tiles

std::span<const std::byte> bytesOf(const Layer& layer) {
  return layer.isInteger ? std::as_bytes(std::span(layer.integers)) : std::as_bytes(std::span(layer.samples));
}

std::uint32_t rowCountOf(const std::vector<Band>& bands) {
  std::uint32_t rows = 0;
  for (const Band& band : bands) rows += band.rowCount;
  return rows;
}

Json jsonOf(const PartHeader& header, const Image& rows) {
  Json json = {{"format", "crosslight part"},
               {"schema", kPartSchema},
               {"part", header.part.index},
               {"parts", header.part.count},
               {"width", header.width},
               {"height", header.height},
               {"display",
                {{"toneMap", static_cast<int>(header.display.toneMap)},
                 {"exposureStops", header.display.exposureStops},
                 {"alpha", header.display.withAlpha}}},
               {"layers", Json::array()},
               {"same", header.same}};
  for (const Layer& layer : rows.layers) {
    json["layers"].push_back(
        {{"name", layer.name}, {"channels", layer.channelNames}, {"type", layer.isInteger ? "uint32" : "float32"}});
  }
  return json;
}

}  // namespace

Part partOf(const std::string& text) {
  Part part{0, 0};
  const std::size_t slash = text.find('/');
  const auto parse = [](std::string_view digits, std::uint32_t& value) {
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return error == std::errc{} && stop == digits.data() + digits.size();
  };
  const std::string_view all = text;
  if (slash == std::string::npos || !parse(all.substr(0, slash), part.index) ||
      !parse(all.substr(slash + 1), part.count) || part.index < 1 || part.index > part.count ||
      part.count > kMostParts) {
    throw UsageError(fmt::format("--part: '{}' is not I/N with 1 <= I <= N <= {}, e.g. 2/4", text, kMostParts));
  }
  return part;
}

bool isPartFile(const std::filesystem::path& output) { return output.extension() == ".clpart"; }

std::vector<Band> rowsOfPart(const Part& part, std::uint32_t height) {
  if (part.count > height) {
    throw UsageError(fmt::format("--part: {} parts are more than the picture's {} rows", part.count, height));
  }
  std::uint32_t runRows = std::max(1u, height / (kRunsPerPart * part.count));
  if (runRows > kTileRows) runRows -= runRows % kTileRows;
  std::vector<Band> bands;
  for (std::uint64_t row = std::uint64_t{part.index - 1} * runRows; row < height;
       row += std::uint64_t{part.count} * runRows) {
    const auto first = static_cast<std::uint32_t>(row);
    const std::uint32_t count = std::min(runRows, height - first);
    if (!bands.empty() && bands.back().firstRow + bands.back().rowCount == first) {
      bands.back().rowCount += count;
    } else {
      bands.push_back({first, count});
    }
  }
  return bands;
}

void writePart(const std::filesystem::path& file, const PartHeader& header, const Image& rows) {
  CL_CHECK_EQ(rows.height, rowCountOf(rowsOfPart(header.part, header.height)));
  const std::string text = jsonOf(header, rows).dump(-1, ' ', false, Json::error_handler_t::replace);
  writeFileAtomically(file, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    if (!out) throw InputError(file.string(), std::string("cannot be written: ") + std::strerror(errno));
    std::uint64_t hash = kHashSeed;
    const auto put = [&](std::span<const std::byte> bytes) {
      hash = hashBytes(bytes, hash);
      out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    };
    const std::uint64_t headerBytes = text.size();
    put(std::as_bytes(std::span(kPartMagic)));
    put(std::as_bytes(std::span(&headerBytes, 1)));
    put(std::as_bytes(std::span(text)));
    for (const Layer& layer : rows.layers) put(bytesOf(layer));
    const std::uint64_t checksum = hash;
    put(std::as_bytes(std::span(&checksum, 1)));
    out.flush();
    if (!out) throw InputError(file.string(), std::string("cannot be written: ") + std::strerror(errno));
  });
}

}  // namespace crosslight
