// Transparent fragments in lists, one per sample, until they are resolved in order. How much memory they take is known
// when they are drawn: then more of it is made, up to a bound, or fewer rows are drawn at once. Nothing is left out.
#pragma once

#include <cstdint>
#include <vector>

#include "film/film.h"
#include "gpu/commands.h"
#include "raster_bindings.h"

namespace crosslight {

class Layers {
 public:
  // `samples` per pixel; `maxBytes` for the lists.
  Layers(const gpu::Device& device, std::uint32_t width, std::uint32_t rows, std::uint32_t samples,
         std::uint64_t maxBytes);

  static std::vector<gpu::Binding> bindings();
  void bind(gpu::BindingSet& set) const;
  // Of the pipelines that use lists.
  gpu::Constants constants() const;

  std::uint32_t rowsAtOnce() const { return rowsAtOnce_; }
  std::uint32_t capacity() const { return capacity_; }
  // Empties the lists of the next rows; at most rowsAtOnce().
  void clear(gpu::Commands& commands, std::uint32_t rows) const;
  // After the rows are drawn: whether all fragments found room. If not, `set` has more, or rowsAtOnce() is less, and
  // the rows are to be drawn again. DeviceError when a single row is too much, or one pixel.
  bool keptAll(const Band& rows, gpu::BindingSet& set);
  std::uint64_t mostFragments() const { return mostFragments_; }

 private:
  std::uint64_t samplesPerRow() const { return std::uint64_t{width_} * samples_; }
  void grow(std::uint64_t fragments, gpu::BindingSet& set);

  const gpu::Device& device_;
  std::uint32_t width_, samples_, rowsAtOnce_, capacity_, mostCapacity_;
  std::uint64_t mostFragments_ = 0;
  gpu::Buffer heads_, layers_, counts_;
};

}  // namespace crosslight
