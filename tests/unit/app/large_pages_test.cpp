#include "app/large_pages.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace crosslight {
namespace {

// Flags of the mapping that an address lies in; empty: not found.
std::string mappingFlags(const void* address) {
  std::ifstream in("/proc/self/smaps");
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  bool here = false;
  for (std::string line; std::getline(in, line);) {
    std::uintptr_t from = 0, to = 0;
    char dash = 0;
    if (std::istringstream range(line); range >> std::hex >> from >> dash >> to && dash == '-') {
      here = from <= at && at < to;
    }
    if (here && line.starts_with("VmFlags:")) return line;
  }
  return {};
}

TEST(LargePages, HoldWhatTheHeapGrowsBy) {
  if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage")) GTEST_SKIP() << "a kernel without large pages";
  useLargePages();
  const std::vector<char> picture(std::size_t{24} << 20);
  const std::string flags = mappingFlags(picture.data() + picture.size() / 2);
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
  EXPECT_NE(flags.find(" hg"), std::string::npos) << flags;
#endif
}

}  // namespace
}  // namespace crosslight
