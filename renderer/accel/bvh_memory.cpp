#include "accel/bvh_memory.h"

#include <new>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace crosslight::accel {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;
constexpr std::align_val_t kLineAlignment{64};

bool isLarge(std::size_t bytes) { return bytes >= 2 * kHugePage; }

}  // namespace

void* allocatePages(std::size_t bytes) {
  if (!isLarge(bytes)) return ::operator new(bytes, kLineAlignment);
  void* memory = ::operator new (bytes, std::align_val_t{kHugePage});
  adviseHugePages(memory, bytes);
  return memory;
}

void freePages(void* memory, std::size_t bytes) {
  if (isLarge(bytes)) {
    ::operator delete (memory, std::align_val_t{kHugePage});
  } else {
    ::operator delete(memory, kLineAlignment);
  }
}

void adviseHugePages([[maybe_unused]] const void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = (begin + kHugePage - 1) / kHugePage * kHugePage;
  const std::uintptr_t last = (begin + bytes) / kHugePage * kHugePage;
  if (isLarge(bytes) && first < last) ::madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#endif
}

}  // namespace crosslight::accel
