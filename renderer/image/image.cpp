#include "image/image.h"

#include <algorithm>

#include "base/check.h"

namespace crosslight {

std::size_t Layer::channel(const std::string& channelName) const {
  return static_cast<std::size_t>(std::find(channelNames.begin(), channelNames.end(), channelName) -
                                  channelNames.begin());
}

const Layer* Image::find(const std::string& name) const {
  const auto found = std::find_if(layers.begin(), layers.end(), [&](const Layer& layer) { return layer.name == name; });
  return found == layers.end() ? nullptr : &*found;
}

Layer& Image::picture() {
  CL_CHECK(!layers.empty());
  return layers.front();
}

const Layer& Image::picture() const {
  CL_CHECK(!layers.empty());
  return layers.front();
}

Image makeImage(std::uint32_t width, std::uint32_t height) {
  Image image;
  image.width = width;
  image.height = height;
  addLayer(image, "", {"R", "G", "B", "A"});
  return image;
}

Image makeShownImage(std::uint32_t width, std::uint32_t height) {
  Image image;
  image.width = width;
  image.height = height;
  Layer& picture = image.layers.emplace_back();
  picture.channelNames = {"R", "G", "B"};
  image.shownCodes.resize(3 * image.pixels());
  return image;
}

Layer& addLayer(Image& image, const std::string& name, const std::vector<std::string>& channelNames) {
  Layer& layer = image.layers.emplace_back();
  layer.name = name;
  layer.channelNames = channelNames;
  layer.samples.resize(image.pixels() * channelNames.size());
  return layer;
}

Layer& addIntegerLayer(Image& image, const std::string& name, const std::vector<std::string>& channelNames) {
  Layer& layer = image.layers.emplace_back();
  layer.name = name;
  layer.channelNames = channelNames;
  layer.isInteger = true;
  layer.integers.resize(image.pixels() * channelNames.size());
  return layer;
}

PixelReader::PixelReader(const Image& image, const Layer& layer)
    : samples_(layer.samples.data()), channels_(layer.channels()) {
  CL_CHECK(!layer.isInteger);
  CL_CHECK_EQ(layer.samples.size(), image.pixels() * layer.channels());
  const std::size_t none = layer.channels();
  const char* const names[4] = {"R", "G", "B", "A"};
  for (int i = 0; i < 4; ++i) index_[i] = layer.channel(names[i]);
  if (index_[0] == none || index_[1] == none || index_[2] == none) {
    const std::size_t colors = none - (index_[3] != none ? 1 : 0);
    std::size_t next = 0;
    for (int i = 0; i < 3; ++i) {
      if (next == index_[3]) ++next;
      index_[i] = colors == 1 && i > 0 ? index_[0] : std::min(next++, none);
    }
  }
}

}  // namespace crosslight
