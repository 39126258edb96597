#include "app/large_pages.h"

#include <cstdlib>  // defines __GLIBC__
#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#endif

namespace crosslight {

#ifdef __GLIBC__
namespace {

constexpr std::size_t kStepBytes = 128 << 20;  // address space; only what is touched becomes memory
constexpr std::size_t kMapAtBytes = 32 << 20;  // larger blocks are mapped by themselves, and given back at once
constexpr std::size_t kBlockBytes = 16 << 20;  // more than the heap has left when a program begins
constexpr std::uintptr_t kLargePage = 2 << 20;

}  // namespace

void useLargePages() {
  mallopt(M_TOP_PAD, kStepBytes);
  mallopt(M_MMAP_THRESHOLD, kMapAtBytes);
  const auto before = reinterpret_cast<std::uintptr_t>(sbrk(0));
  void* volatile block = std::malloc(kBlockBytes);  // volatile: compilers leave out what is freed at once
  std::free(block);
  const auto after = reinterpret_cast<std::uintptr_t>(sbrk(0));
  const std::uintptr_t from = (before + kLargePage - 1) / kLargePage * kLargePage;
  // Refused where the kernel knows no such pages: nothing is lost then.
  if (from < after) madvise(reinterpret_cast<void*>(from), after - from, MADV_HUGEPAGE);
}
#else
void useLargePages() {}
#endif

}  // namespace crosslight
