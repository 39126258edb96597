#include "cli/animation.h"

#include <cstdint>
#include <cstring>
#include <vector>

namespace crosslight::test {
namespace {

std::string base64(const std::vector<float>& values) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes(values.size() * sizeof(float));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  while (bytes.size() % 3 != 0) bytes.push_back(0);
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::uint32_t word = bytes[i] * 65536u + bytes[i + 1] * 256u + bytes[i + 2];
    for (int shift = 18; shift >= 0; shift -= 6) text += kDigits[word >> shift & 63u];
  }
  return text;
}

}  // namespace

std::string movingTriangle() {
  const std::vector<float> values = {-1, -1, 0, 1, -1, 0, 0, 1, 0,  // positions
                                     0,  4,                         // times of "fly"
                                     -1, 0,  0, 1, 0,  0,           // translations
                                     0,  1,                         // times of "roll"
                                     0,  0,  0, 1, 0,  0, 1, 0};    // rotations
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
    "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 5]}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "animations": [
      {"name": "fly", "samplers": [{"input": 1, "output": 2}],
       "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]},
      {"name": "roll", "samplers": [{"input": 3, "output": 4}],
       "channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}]}],
    "buffers": [{"byteLength": 108, "uri": "data:application/octet-stream;base64,)" +
         base64(values) + R"("}],
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8},
      {"buffer": 0, "byteOffset": 44, "byteLength": 24}, {"buffer": 0, "byteOffset": 68, "byteLength": 8},
      {"buffer": 0, "byteOffset": 76, "byteLength": 32}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
      {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [4]},
      {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"},
      {"bufferView": 3, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
      {"bufferView": 4, "componentType": 5126, "count": 2, "type": "VEC4"}]})";
}

}  // namespace crosslight::test
