#include "app/picture_layers.h"

#include <algorithm>
#include <cstring>
#include <variant>

#include "base/check.h"
#include "scene/settings.h"

namespace crosslight {
namespace {

using Record = shared::AovRecord;
using Vec3Member = glm::vec3 Record::*;
using IdMember = std::uint32_t Record::*;
struct Depth {};
struct Uv {};
struct WorldPosition {};

// One AOV as a layer: its channels and where a record has it.
struct AovLayer {
  const char* name;
  std::vector<std::string> channels;
  std::variant<Vec3Member, IdMember, Depth, Uv, WorldPosition> source;
};

const std::vector<AovLayer>& aovLayers() {
  static const std::vector<std::string> xyz{"X", "Y", "Z"}, rgb{"R", "G", "B"};
  static const std::vector<AovLayer> layers{{"depth", {"Z"}, Depth{}},
                                            {"position", xyz, WorldPosition{}},
                                            {"normal", xyz, &Record::normal},
                                            {"geometricNormal", xyz, &Record::geometricNormal},
                                            {"albedo", rgb, &Record::albedo},
                                            {"uv", {"U", "V"}, Uv{}},
                                            {"instanceId", {"I"}, &Record::instanceId},
                                            {"primitiveId", {"I"}, &Record::primitiveId},
                                            {"materialId", {"I"}, &Record::materialId},
                                            {"ambient", rgb, &Record::ambient},
                                            {"diffuse", rgb, &Record::diffuse},
                                            {"specular", rgb, &Record::specular},
                                            {"emission", rgb, &Record::emission}};
  return layers;
}

const AovLayer& layerNamed(const std::string& name) {
  const auto& layers = aovLayers();
  const auto found = std::find_if(layers.begin(), layers.end(), [&](const AovLayer& l) { return name == l.name; });
  CL_CHECK(found != layers.end());
  return *found;
}

// Writes one layer's values of a run of records, from its pixel `first` on.
struct Filler {
  std::span<const Record> records;
  const glm::dvec3& origin;
  Layer& layer;
  std::size_t first;

  template <class Get>
  void vectors(const Get& get) const {
    float* out = layer.samples.data() + first * 3;
    for (const Record& r : records) {
      const glm::vec3 v = get(r);
      *out++ = v.x, *out++ = v.y, *out++ = v.z;
    }
  }
  void operator()(Vec3Member member) const {
    vectors([member](const Record& r) { return r.*member; });
  }
  void operator()(WorldPosition) const {
    vectors([this](const Record& r) {
      return r.instanceId == shared::kNoId ? glm::vec3(0.0f) : glm::vec3(glm::dvec3(r.position) + origin);
    });
  }
  void operator()(IdMember member) const {
    std::uint32_t* out = layer.integers.data() + first;
    for (const Record& r : records) *out++ = r.*member;
  }
  void operator()(Depth) const {
    float* out = layer.samples.data() + first;
    for (const Record& r : records) *out++ = r.depth;
  }
  void operator()(Uv) const {
    float* out = layer.samples.data() + first * 2;
    for (const Record& r : records) *out++ = r.uv.x, *out++ = r.uv.y;
  }
};

}  // namespace

PictureLayers::PictureLayers(std::uint32_t width, std::uint32_t rows, const std::vector<std::string>& aovs,
                             const glm::dvec3& origin, bool shown)
    : image_(shown ? makeShownImage(width, rows) : makeImage(width, rows)), origin_(origin) {
  for (const char* name : kAovNames) {  // their order in every file
    if (std::find(aovs.begin(), aovs.end(), name) == aovs.end()) continue;
    const AovLayer& aov = layerNamed(name);
    if (std::holds_alternative<IdMember>(aov.source)) {
      addIntegerLayer(image_, name, aov.channels);
    } else {
      addLayer(image_, name, aov.channels);
    }
  }
}

void PictureLayers::add(const ExposedPixels& pixels) {
  if (!pixels.codes.empty()) return addCodes(pixels);
  static_assert(sizeof(glm::vec4) == 4 * sizeof(float));
  CL_CHECK_LE(pixels.first + pixels.picture.size(), image_.pixels());
  std::memcpy(image_.picture().samples.data() + 4 * pixels.first, pixels.picture.data(), pixels.picture.size_bytes());
  for (std::size_t i = 1; i < image_.layers.size(); ++i) {
    Layer& layer = image_.layers[i];
    std::visit(Filler{pixels.aovs, origin_, layer, pixels.first}, layerNamed(layer.name).source);
  }
}

void PictureLayers::addCodes(const ExposedPixels& pixels) {
  CL_CHECK_LE(3 * (pixels.first + pixels.codes.size()), image_.shownCodes.size());
  std::uint8_t* out = image_.shownCodes.data() + 3 * pixels.first;
  for (const std::uint32_t code : pixels.codes) {
    *out++ = static_cast<std::uint8_t>(code);
    *out++ = static_cast<std::uint8_t>(code >> 8);
    *out++ = static_cast<std::uint8_t>(code >> 16);
  }
}

std::uint64_t layerBytesPerPixel(const std::vector<std::string>& aovs) {
  std::uint64_t channels = 4;
  for (const std::string& name : aovs) channels += layerNamed(name).channels.size();
  return channels * sizeof(float);
}

}  // namespace crosslight
