// An image of named float layers, as renderers think of it: linear, unclamped, row 0 on top.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace crosslight {

// One layer of an image: `channels` floats per pixel, interleaved, rows from top to bottom.
struct Layer {
  std::string name;                       // "" is the picture itself; AOVs have names ("depth", "normal", ...)
  std::vector<std::string> channelNames;  // EXR's channel letters, e.g. {"R","G","B","A"}, {"Z"}, {"X","Y","Z"}
  std::vector<float> samples;             // width * height * channelNames.size()
  bool isInteger = false;                 // ids: exact integers, stored as UINT in EXR

  std::size_t channels() const { return channelNames.size(); }
};

struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<Layer> layers;                    // layers[0] is the picture
  std::map<std::string, std::string> metadata;  // written to EXR attributes and PNG tEXt where the format has them

  const Layer* find(const std::string& name) const;
  Layer& picture();
  const Layer& picture() const;
};

// width x height RGBA picture, all zero.
Image makeImage(std::uint32_t width, std::uint32_t height);

}  // namespace crosslight
