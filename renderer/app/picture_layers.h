// From the film's pixels to the layers of an image: the picture, and the AOVs that were asked for.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "film/film.h"
#include "image/image.h"

namespace crosslight {

class PictureLayers {
 public:
  // `origin`: world position of render space's zero. `shown`: the film gives codes, not floats.
  PictureLayers(std::uint32_t width, std::uint32_t rows, const std::vector<std::string>& aovs, const glm::dvec3& origin,
                bool shown = false);
  void add(const ExposedPixels& pixels);
  Image take() { return std::move(image_); }

 private:
  void addCodes(const ExposedPixels& pixels);

  Image image_;
  glm::dvec3 origin_;
};

// Bytes per pixel of an image with these layers.
std::uint64_t layerBytesPerPixel(const std::vector<std::string>& aovs);

}  // namespace crosslight
