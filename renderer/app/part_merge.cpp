// The reading of part files, and the picture that they make together.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <map>

#include "app/part.h"
#include "app/part_format.h"
#include "app/render_checks.h"
#include "app/suggest.h"
#include "base/error.h"
#include "base/hash.h"

namespace crosslight {
namespace {

constexpr std::uint64_t kMostHeaderBytes = 1u << 20;
constexpr std::size_t kMostLayers = 256, kMostChannels = 16;

// Headers come from files: every member is checked before it is believed.
class HeaderReader {
 public:
  HeaderReader(const std::string& where, const Json& json) : where_(where), json_(json) {}

  PartHeader header() const {
    if (!json_.is_object() || text(json_, "format") != "crosslight part") fail("its header is of something else");
    if (number(json_, "schema", 1, kMostParts) != kPartSchema) fail("its schema is of another version of crosslight");
    PartHeader header;
    header.width = number(json_, "width", 1, kMaxImageSide);
    header.height = number(json_, "height", 1, kMaxImageSide);
    header.part.count = number(json_, "parts", 1, std::min(kMostParts, header.height));
    header.part.index = number(json_, "part", 1, header.part.count);
    const Json& display = member(json_, "display");
    header.display.toneMap = static_cast<ToneMap>(number(display, "toneMap", 0, static_cast<int>(ToneMap::neutral)));
    const Json& stops = member(display, "exposureStops");
    const Json& alpha = member(display, "alpha");
    if (!stops.is_number() || !alpha.is_boolean()) fail("its display settings are broken");
    header.display.exposureStops = stops.get<float>();
    header.display.withAlpha = alpha.get<bool>();
    header.same = member(json_, "same");
    if (!header.same.is_object()) fail("its description of the picture is broken");
    return header;
  }

  // Layers of `rows` rows, all zero.
  Image image(const PartHeader& header, std::uint32_t rows) const {
    Image image;
    image.width = header.width;
    image.height = rows;
    const Json& layers = member(json_, "layers");
    if (!layers.is_array() || layers.empty() || layers.size() > kMostLayers) fail("its list of layers is broken");
    for (const Json& layer : layers) {
      const Json& channels = member(layer, "channels");
      if (!channels.is_array() || channels.empty() || channels.size() > kMostChannels) fail("a layer has no channels");
      std::vector<std::string> names;
      for (const Json& channel : channels) {
        if (!channel.is_string()) fail("a channel has no name");
        names.push_back(channel.get<std::string>());
      }
      const std::string type = text(layer, "type");
      if (type != "float32" && type != "uint32") fail("a layer is neither float32 nor uint32");
      type == "uint32" ? addIntegerLayer(image, text(layer, "name"), names)
                       : addLayer(image, text(layer, "name"), names);
    }
    return image;
  }

  std::uint64_t bytesPerPixel() const {
    std::uint64_t values = 0;
    for (const Layer& layer : image({1, 1, {}, {}, {}}, 1).layers) values += layer.channels();
    return values * sizeof(float);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(where_, "is a broken part file: " + what); }
  const Json& member(const Json& object, const char* key) const {
    if (!object.is_object() || !object.contains(key)) fail(std::string("its header lacks '") + key + "'");
    return object[key];
  }
  std::string text(const Json& object, const char* key) const {
    const Json& value = member(object, key);
    if (!value.is_string()) fail(std::string("'") + key + "' is no text");
    return value.get<std::string>();
  }
  std::uint32_t number(const Json& object, const char* key, std::uint64_t least, std::uint64_t most) const {
    const Json& value = member(object, key);
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() < least || value.get<std::uint64_t>() > most) {
      fail(fmt::format("'{}' is not a whole number from {} to {}", key, least, most));
    }
    return value.get<std::uint32_t>();
  }

  const std::string& where_;
  const Json& json_;
};

// A part's file up to its payload.
struct OpenPart {
  std::string name;
  std::ifstream in;
  std::uint64_t hash = kHashSeed;  // of what was read so far
  Json json;
  PartHeader header;
};

void readExactly(OpenPart& part, std::span<std::byte> bytes) {
  part.in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!part.in) throw InputError(part.name, "ends early: the part was cut off");
  part.hash = hashBytes(bytes, part.hash);
}

OpenPart openPart(const std::string& file) {
  OpenPart part;
  part.name = file;
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) throw InputError(file, "is a folder, a part file is needed");
  part.in.open(file, std::ios::binary);
  if (!part.in) throw InputError(file, std::string("cannot be opened: ") + std::strerror(errno));
  char magic[sizeof(kPartMagic)];
  std::uint64_t headerBytes = 0;
  part.in.read(magic, sizeof(magic));
  if (!part.in || std::memcmp(magic, kPartMagic, sizeof(kPartMagic)) != 0) {
    throw InputError(file, "is no part file; 'crosslight render --part I/N -o x.clpart' makes them");
  }
  part.hash = hashBytes(std::as_bytes(std::span(magic)), part.hash);
  readExactly(part, std::as_writable_bytes(std::span(&headerBytes, 1)));
  if (headerBytes > kMostHeaderBytes) throw InputError(file, "is a broken part file: its header is too long");
  std::string text(headerBytes, '\0');
  readExactly(part, std::as_writable_bytes(std::span(text)));
  try {
    part.json = Json::parse(text);
  } catch (const Json::exception&) {
    throw InputError(file, "is a broken part file: its header is no JSON");
  }
  part.header = HeaderReader(part.name, part.json).header();
  return part;
}

std::byte* rowOf(Layer& layer, std::size_t width, std::uint32_t row) {
  const std::size_t at = row * width * layer.channels();
  return layer.isInteger ? reinterpret_cast<std::byte*>(layer.integers.data() + at)
                         : reinterpret_cast<std::byte*>(layer.samples.data() + at);
}

// Into the rows of `image` that belong to the part.
void readPayload(OpenPart& part, Image& image) {
  const std::vector<Band> bands = rowsOfPart(part.header.part, part.header.height);
  for (Layer& layer : image.layers) {
    const std::size_t rowBytes = image.width * layer.channels() * sizeof(float);
    for (const Band& band : bands) {
      readExactly(part, {rowOf(layer, image.width, band.firstRow), band.rowCount * rowBytes});
    }
  }
  const std::uint64_t expected = part.hash;
  std::uint64_t written = 0;
  readExactly(part, std::as_writable_bytes(std::span(&written, 1)));
  if (written != expected) throw InputError(part.name, "is damaged: its checksum is wrong; draw this part again");
  if (part.in.get() != std::char_traits<char>::eof()) throw InputError(part.name, "has bytes after its end");
}

// The paths at which two descriptions differ.
std::string differences(const Json& a, const Json& b) {
  const Json p = a.flatten(), q = b.flatten();
  std::vector<std::string> paths;
  for (const auto& [path, value] : p.items()) {
    if (!q.contains(path) || q[path] != value) paths.push_back(path);
  }
  for (const auto& [path, value] : q.items()) {
    if (!p.contains(path)) paths.push_back(path);
  }
  return joined(paths, ", ");
}

void checkSamePicture(const OpenPart& first, const OpenPart& other) {
  Json a = first.json, b = other.json;
  a.erase("part");
  b.erase("part");
  const std::string paths = differences(a, b);
  if (paths.empty()) return;
  throw InputError(other.name,
                   fmt::format("is a part of another picture than {}: they differ in {}", first.name, paths));
}

void checkComplete(const std::vector<OpenPart>& parts) {
  std::map<std::uint32_t, std::string> owners;
  for (const OpenPart& part : parts) {
    checkSamePicture(parts.front(), part);
    const auto [owner, isNew] = owners.emplace(part.header.part.index, part.name);
    if (!isNew) {
      throw InputError(part.name, fmt::format("is part {} of {}, as {} is; give each part once", part.header.part.index,
                                              part.header.part.count, owner->second));
    }
  }
  const std::uint32_t count = parts.front().header.part.count;
  if (owners.size() == count) return;
  std::vector<std::string> missing;
  for (std::uint32_t index = 1; index <= count && missing.size() < 20; ++index) {
    if (!owners.contains(index)) missing.push_back(std::to_string(index));
  }
  const std::size_t unnamed = count - owners.size() - missing.size();
  throw InputError(parts.front().name,
                   fmt::format("is one of {} parts, of which {}{} missing", count, joined(missing, ", "),
                               unnamed > 0          ? fmt::format(" and {} more are", unnamed)
                               : missing.size() > 1 ? " are"
                                                    : " is"));
}

}  // namespace

Merged mergeParts(const std::vector<std::string>& files) {
  std::vector<OpenPart> parts;
  for (const std::string& file : files) {
    parts.push_back(openPart(file));
    parts.back().in.close();  // there may be more parts than a process may have files open
  }
  checkComplete(parts);
  const OpenPart& first = parts.front();
  const HeaderReader reader(first.name, first.json);
  const std::uint64_t bytes = std::uint64_t{first.header.width} * first.header.height * reader.bytesPerPixel();
  if (const std::uint64_t available = availableHostBytes(); bytes > available) {
    throw DeviceError(fmt::format("the whole picture of {}x{} pixels needs {}, {} are available", first.header.width,
                                  first.header.height, inGiB(bytes), inGiB(available)));
  }
  Merged merged{reader.image(first.header, first.header.height), first.header.display};
  for (const std::string& file : files) {
    OpenPart part = openPart(file);
    checkSamePicture(first, part);
    readPayload(part, merged.image);
  }
  const auto metadata = first.header.same.find("metadata");
  if (metadata != first.header.same.end() && metadata->is_object()) {
    for (const auto& [key, value] : metadata->items()) {
      if (value.is_string()) merged.image.metadata[key] = value.get<std::string>();
    }
  }
  return merged;
}

}  // namespace crosslight
