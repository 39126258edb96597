// An image of named float layers, as renderers think of it: linear, unclamped, row 0 on top.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace crosslight {

// One layer of an image: one value per channel and pixel, interleaved, rows from top to bottom. A layer of ids keeps
// its values in `integers`, because floats are exact only up to 2^24; the other vector is empty.
struct Layer {
  std::string name;                       // "" is the picture itself; AOVs have names ("depth", "normal", ...)
  std::vector<std::string> channelNames;  // EXR's channel letters, e.g. {"R","G","B","A"}, {"Z"}, {"X","Y","Z"}
  std::vector<float> samples;             // width * height * channelNames.size(), unless isInteger
  bool isInteger = false;                 // stored as UINT in EXR
  std::vector<std::uint32_t> integers;    // width * height * channelNames.size(), if isInteger

  std::size_t channels() const { return channelNames.size(); }
  // Index of a channel by its name; channels() when there is none.
  std::size_t channel(const std::string& channelName) const;
};

struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<Layer> layers;  // layers[0] is the picture
  // Of a picture that was only asked for as a display shows it: its 8-bit sRGB codes, three per pixel. The picture's
  // layer has no samples then.
  std::vector<std::uint8_t> shownCodes;
  std::map<std::string, std::string> metadata;  // written to EXR attributes and PNG tEXt where the format has them

  const Layer* find(const std::string& name) const;
  Layer& picture();
  const Layer& picture() const;
  std::size_t pixels() const { return std::size_t{width} * height; }
};

// No side of an image may be longer, written or read: a bound for hostile headers, far above Vulkan's 16384.
inline constexpr std::uint32_t kMaxImageSide = 65536;

// width x height RGBA picture, all zero.
Image makeImage(std::uint32_t width, std::uint32_t height);

// RGB picture of shownCodes, all zero.
Image makeShownImage(std::uint32_t width, std::uint32_t height);

// Adds an empty (all zero) layer and returns it; the reference holds until the next one is added.
Layer& addLayer(Image& image, const std::string& name, const std::vector<std::string>& channelNames);
Layer& addIntegerLayer(Image& image, const std::string& name, const std::vector<std::string>& channelNames);

// One pixel of a layer as a color: R, G, B if it has them, else its first three channels, one channel as gray. Alpha is
// 1 without an A channel. Float layers only.
struct PixelReader {
  PixelReader(const Image& image, const Layer& layer);
  void operator()(std::size_t pixel, float (&rgba)[4]) const {
    const float* const first = samples_ + pixel * channels_;
    for (int i = 0; i < 4; ++i) rgba[i] = index_[i] < channels_ ? first[index_[i]] : (i == 3 ? 1.0f : 0.0f);
  }

 private:
  const float* samples_;
  std::size_t channels_;
  std::size_t index_[4];  // channel of r, g, b, a; channels_: none
};

}  // namespace crosslight
