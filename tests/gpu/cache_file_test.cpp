#include "gpu/cache_file.h"

#include <algorithm>
#include <cstdlib>
#include <thread>

#include "base/file.h"
#include "gpu_fixture.h"

namespace crosslight::gpu {
namespace {

std::vector<std::byte> blobOf(std::size_t size, unsigned seed) {
  std::vector<std::byte> blob(size);
  for (std::size_t i = 0; i < size; ++i) blob[i] = static_cast<std::byte>((i * 31 + seed) & 0xff);
  return blob;
}

// A folder that lives as long as the test.
struct Folder {
  std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) /
      (std::string("crosslight_cache_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  Folder() { std::filesystem::remove_all(path); }
  ~Folder() { std::filesystem::remove_all(path); }
};

TEST(CacheFile, GivesBackWhatWasPacked) {
  for (const std::size_t size : {0, 1, 1000}) EXPECT_EQ(unpackCache(packCache(blobOf(size, 1))), blobOf(size, 1));
}

TEST(CacheFile, EveryTruncationIsIgnored) {
  const auto file = packCache(blobOf(100, 2));
  for (std::size_t size = 0; size < file.size(); ++size) {
    EXPECT_EQ(unpackCache(std::span(file).first(size)), std::nullopt) << size;
  }
}

TEST(CacheFile, EveryFlippedBitIsNoticed) {
  const auto file = packCache(blobOf(100, 3));
  for (std::size_t bit = 0; bit < 8 * file.size(); ++bit) {
    auto damaged = file;
    damaged[bit / 8] ^= static_cast<std::byte>(1u << (bit % 8));
    EXPECT_EQ(unpackCache(damaged), std::nullopt) << bit;
  }
}

TEST(CacheFile, TrailingBytesAreNoticed) {
  auto file = packCache(blobOf(100, 4));
  file.push_back(std::byte{0});
  EXPECT_EQ(unpackCache(file), std::nullopt);
}

TEST(CacheFile, ReadsWhatItWroteAndIgnoresADamagedFile) {
  const Folder folder;
  const auto path = folder.path / "deeper" / "cache.bin";
  EXPECT_EQ(loadCache(path), std::nullopt);
  ASSERT_TRUE(saveCache(path, blobOf(500, 5)));
  EXPECT_EQ(loadCache(path), blobOf(500, 5));
  std::filesystem::resize_file(path, 300);
  EXPECT_EQ(loadCache(path), std::nullopt);
  ASSERT_TRUE(saveCache(path, blobOf(500, 6)));
  EXPECT_EQ(loadCache(path), blobOf(500, 6));
}

TEST(CacheFile, AFolderThatCannotBeMadeIsNoError) {
  const Folder folder;
  ASSERT_TRUE(saveCache(folder.path, blobOf(10, 7)));  // a file where the folder should be
  EXPECT_FALSE(saveCache(folder.path / "cache.bin", blobOf(10, 7)));
  EXPECT_EQ(loadCache(folder.path / "cache.bin"), std::nullopt);
}

TEST(CacheFile, ConcurrentWritersNeverLeaveAMixture) {
  const Folder folder;
  const auto path = folder.path / "cache.bin";
  const auto writeMany = [&](unsigned seed) {
    for (int i = 0; i < 20; ++i) EXPECT_TRUE(saveCache(path, blobOf(40000 + seed, seed)));
  };
  std::thread first(writeMany, 1), second(writeMany, 2);
  int seen = 0;
  for (int i = 0; i < 100; ++i) {
    if (!std::filesystem::exists(path)) continue;
    const auto blob = loadCache(path);
    ASSERT_TRUE(blob.has_value());
    EXPECT_TRUE(*blob == blobOf(40001, 1) || *blob == blobOf(40002, 2));
    ++seen;
  }
  first.join();
  second.join();
  EXPECT_TRUE(loadCache(path).has_value()) << seen;
}

}  // namespace
}  // namespace crosslight::gpu
