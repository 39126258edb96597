// Large arrays that are written before they are read, in huge pages where the system has them: a first touch of 4 KiB
// costs about as much as building the tree over what fits in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace crosslight::accel {

void* allocatePages(std::size_t bytes);
void freePages(void* memory, std::size_t bytes);
// Asks for huge pages in a range that is allocated but not touched yet; without effect where there are none.
void adviseHugePages(const void* memory, std::size_t bytes);

template <class T>
class RawArray {
 public:
  RawArray() = default;
  explicit RawArray(std::size_t size)
      : memory_(static_cast<T*>(allocatePages(size * sizeof(T))), Free{size * sizeof(T)}) {}
  T* data() const { return memory_.get(); }
  T& operator[](std::size_t i) const { return memory_.get()[i]; }
  void reset() { memory_.reset(); }

 private:
  struct Free {
    std::size_t bytes = 0;
    void operator()(T* memory) const { freePages(memory, bytes); }
  };
  static_assert(std::is_trivially_destructible_v<T>);
  std::unique_ptr<T, Free> memory_;
};

}  // namespace crosslight::accel
