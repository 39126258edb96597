// Trees on disk: the same bits come back, and no damage to a file is more than a miss.
#include "accel/bvh_cache.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <thread>

#include "accel/bvh_cache_file.h"
#include "accel/cached_trees.h"
#include "base/file.h"
#include "meshes.h"

namespace crosslight {
namespace {

namespace fs = std::filesystem;
using testing::boundsOf;
using testing::Random;

class BvhCacheTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "crosslight_bvh_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    cache_.folder = fs::path(pattern) / "made" / "when needed";
    root_ = pattern;
  }
  void TearDown() override { fs::remove_all(root_); }

  std::vector<fs::path> files() const {
    std::vector<fs::path> list;
    if (!fs::exists(cache_.folder)) return list;
    for (const auto& entry : fs::directory_iterator(cache_.folder)) list.push_back(entry.path());
    return list;
  }

  void writeBytes(const fs::path& path, const std::vector<std::byte>& bytes) const {
    std::ofstream(path, std::ios::binary | std::ios::trunc)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }

  BvhCache cache_;
  fs::path root_;
};

struct Example {
  std::vector<Bounds> boxes;
  Bvh bvh;
  BvhKey key;

  explicit Example(std::size_t count, std::uint64_t seed = 1, const BvhOptions& options = {})
      : boxes(boundsOf(testing::randomSoup(count, 0.05, seed))),
        bvh(buildBvh(boxes, options)),
        key(bvhKey(boxes, options)) {}
};

void expectSame(const Bvh& a, const Bvh& b) {
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  EXPECT_EQ(0, std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(shared::BvhNode)));
  EXPECT_EQ(a.order, b.order);
  EXPECT_EQ(a.bounds.lower, b.bounds.lower);
  EXPECT_EQ(a.bounds.upper, b.bounds.upper);
  EXPECT_EQ(a.stats.sahCost, b.stats.sahCost);
  EXPECT_EQ(a.stats.builtSahCost, b.stats.builtSahCost);
  EXPECT_EQ(a.stats.nodeCount, b.stats.nodeCount);
  EXPECT_EQ(a.stats.leafCount, b.stats.leafCount);
  EXPECT_EQ(a.stats.maxDepth, b.stats.maxDepth);
  EXPECT_EQ(a.stats.primitives, b.stats.primitives);
  EXPECT_EQ(a.stats.sizeBytes, b.stats.sizeBytes);
}

TEST_F(BvhCacheTest, ReturnsTheSameBits) {
  for (const std::size_t count : {0u, 1u, 2u, 3u, 1000u, 40000u}) {
    const Example example(count);
    EXPECT_FALSE(loadBvh(cache_, example.key, count));
    ASSERT_TRUE(storeBvh(cache_, example.key, example.bvh));
    const auto loaded = loadBvh(cache_, example.key, count);
    ASSERT_TRUE(loaded) << count << " primitives";
    expectSame(example.bvh, *loaded);
  }
}

TEST_F(BvhCacheTest, KeysTellApartAllThatDecidesTheTree) {
  const auto boxes = boundsOf(testing::randomSoup(100, 0.1, 5));
  const BvhKey key = bvhKey(boxes, {});
  EXPECT_EQ(key, bvhKey(boxes, {.threads = 7})) << "threads decide nothing";
  std::vector<BvhKey> others{bvhKey(boxes, {.maxLeafSize = 5}),
                             bvhKey(boxes, {.binCount = 17}),
                             bvhKey(boxes, {.quality = BvhQuality::fast}),
                             bvhKey(boxes, {.nodeCost = 1.5f}),
                             bvhKey(boxes, {.mostDuplicates = 0.5f}),
                             bvhKey(std::span(boxes).first(99), {})};
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    auto moved = boxes;
    moved[i].upper.z = std::nextafter(moved[i].upper.z, 1e30f);
    others.push_back(bvhKey(moved, {}));
  }
  others.push_back(key);
  std::sort(others.begin(), others.end());
  EXPECT_EQ(std::adjacent_find(others.begin(), others.end()), others.end());
}

TEST_F(BvhCacheTest, KeysOfTrianglesDependOnCornersAndIndices) {
  std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<std::uint32_t> indices{0, 1, 2, 0, 1, 3};
  const BvhKey key = bvhKey(BvhTriangles{corners, indices}, {});
  auto otherIndices = indices;
  std::swap(otherIndices[4], otherIndices[5]);
  EXPECT_NE(key, bvhKey(BvhTriangles{corners, otherIndices}, {}));
  corners[3].z = 2;
  EXPECT_NE(key, bvhKey(BvhTriangles{corners, indices}, {}));
}

TEST_F(BvhCacheTest, MissesAnotherKeyAndAnotherNumberOfPrimitives) {
  const Example example(50), other(50, 2);
  ASSERT_TRUE(storeBvh(cache_, example.key, example.bvh));
  EXPECT_FALSE(loadBvh(cache_, other.key, 50));
  EXPECT_FALSE(loadBvh(cache_, example.key, 51));
  // A file under another tree's name.
  ASSERT_TRUE(storeBvh(cache_, other.key, other.bvh));
  const auto list = files();
  ASSERT_EQ(list.size(), 2u);
  const auto bytes = readFile(list[0]);
  fs::copy_file(list[1], list[0], fs::copy_options::overwrite_existing);
  EXPECT_NE(loadBvh(cache_, example.key, 50).has_value(), loadBvh(cache_, other.key, 50).has_value());
}

TEST_F(BvhCacheTest, MissesEveryTruncatedFile) {
  const Example example(40);
  ASSERT_TRUE(storeBvh(cache_, example.key, example.bvh));
  const fs::path path = files().at(0);
  const auto whole = readFile(path);
  for (std::size_t size = 0; size < whole.size(); size += size < 400 ? 1 : 37) {
    writeBytes(path, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
    ASSERT_FALSE(loadBvh(cache_, example.key, 40)) << size << " bytes of " << whole.size();
  }
  auto longer = whole;
  longer.push_back(std::byte{0});
  writeBytes(path, longer);
  EXPECT_FALSE(loadBvh(cache_, example.key, 40)) << "one byte too many";
  writeBytes(path, whole);
  EXPECT_TRUE(loadBvh(cache_, example.key, 40));
}

TEST_F(BvhCacheTest, MissesWhateverByteIsFlipped) {
  const Example example(40);
  ASSERT_TRUE(storeBvh(cache_, example.key, example.bvh));
  const fs::path path = files().at(0);
  const auto whole = readFile(path);
  // In place: writing the whole file anew thousands of times takes the file system a minute.
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  const auto put = [&](std::size_t at, std::byte byte) {
    file.seekp(static_cast<std::streamoff>(at));
    file.put(static_cast<char>(byte));
    file.flush();
  };
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int bits : {0x01, 0x80, 0xff}) {
      put(at, whole[at] ^ static_cast<std::byte>(bits));
      ASSERT_FALSE(loadBvh(cache_, example.key, 40)) << "byte " << at << " xor " << bits;
    }
    put(at, whole[at]);
  }
  EXPECT_TRUE(loadBvh(cache_, example.key, 40));
}

TEST_F(BvhCacheTest, MissesFilesWithRandomDamage) {
  const Example example(30000);  // more than one piece of the hash
  ASSERT_TRUE(storeBvh(cache_, example.key, example.bvh));
  const fs::path path = files().at(0);
  const auto whole = readFile(path);
  Random random(17);
  for (int trial = 0; trial < 60; ++trial) {
    auto damaged = whole;
    const std::size_t at = random.below(whole.size()), count = 1 + random.below(trial % 2 == 0 ? 8 : whole.size() - at);
    for (std::size_t i = at; i < std::min(at + count, whole.size()); ++i)
      damaged[i] ^= static_cast<std::byte>(1 + random.below(255));
    writeBytes(path, damaged);
    ASSERT_FALSE(loadBvh(cache_, example.key, 30000)) << "from byte " << at;
  }
}

// What the hash would let through if someone wrote it on purpose: no reference may lead out of the tree.
TEST_F(BvhCacheTest, FindsEveryReferenceThatLeadsAstray) {
  const Example example(300);
  accel::Team team(2);
  ASSERT_TRUE(accel::isSoundTree(example.bvh, 300, team));
  Random random(6);
  int found = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    Bvh bvh = example.bvh;
    shared::BvhNode& node = bvh.nodes[random.below(bvh.nodes.size())];
    std::uint32_t* const words[] = {&node.child0, &node.child1, &node.parent, &node.splitAxis,
                                    &bvh.order[random.below(bvh.order.size())]};
    std::uint32_t& word = *words[random.below(5)];
    const std::uint32_t before = word;
    word = trial % 2 == 0 ? static_cast<std::uint32_t>(random.below(400)) : before ^ (1u << random.below(32));
    // Other leaves, axes and primitives within bounds are a wrong tree, but a safe one: the hash finds those.
    const bool otherLeaf = bvhIsLeaf(before) && bvhIsLeaf(word) && &word != &node.parent &&
                           bvhLeafFirst(word) + bvhLeafCount(word) <= bvh.order.size();
    const bool otherAxis = &word == &node.splitAxis && word < 3;
    const bool otherPrimitive = words[4] == &word && word < 300;
    if (word == before || otherLeaf || otherAxis || otherPrimitive) continue;
    ++found;
    ASSERT_FALSE(accel::isSoundTree(bvh, 300, team)) << "trial " << trial << ": " << before << " became " << word;
  }
  EXPECT_GT(found, 1000);
}

TEST_F(BvhCacheTest, KeepsItsFolderBelowItsBoundByRemovingWhatWasNotUsedLongest) {
  std::vector<Example> examples;
  for (std::uint64_t seed = 0; seed < 6; ++seed) examples.emplace_back(1000, seed);
  cache_.maxBytes = 3 * examples[0].bvh.stats.sizeBytes + 4096;
  const auto age = [&](int hours) {
    for (const fs::path& file : files()) {
      if (fs::file_time_type::clock::now() - fs::last_write_time(file) < std::chrono::minutes(1))
        fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(hours));
    }
  };
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(storeBvh(cache_, examples[static_cast<std::size_t>(i)].key, examples[static_cast<std::size_t>(i)].bvh));
    age(10 - i);
  }
  EXPECT_TRUE(loadBvh(cache_, examples[0].key, 1000)) << "oldest, but used now";
  ASSERT_TRUE(storeBvh(cache_, examples[3].key, examples[3].bvh));
  EXPECT_TRUE(loadBvh(cache_, examples[0].key, 1000));
  EXPECT_FALSE(loadBvh(cache_, examples[1].key, 1000));
  EXPECT_TRUE(loadBvh(cache_, examples[2].key, 1000));
  EXPECT_TRUE(loadBvh(cache_, examples[3].key, 1000));
  cache_.maxBytes = 100;
  EXPECT_FALSE(storeBvh(cache_, examples[4].key, examples[4].bvh)) << "larger than the folder may be";
}

TEST_F(BvhCacheTest, RemovesOnlyItsOwnFiles) {
  fs::create_directories(cache_.folder);
  writeBytes(cache_.folder / "notes.txt", std::vector<std::byte>(100000));
  writeBytes(cache_.folder / "scene.bvh", std::vector<std::byte>(100000));
  const Example example(100);
  cache_.maxBytes = example.bvh.stats.sizeBytes + 4096;
  ASSERT_TRUE(storeBvh(cache_, example.key, example.bvh));
  EXPECT_TRUE(fs::exists(cache_.folder / "notes.txt"));
  EXPECT_TRUE(fs::exists(cache_.folder / "scene.bvh"));
  EXPECT_TRUE(loadBvh(cache_, example.key, 100));
}

TEST_F(BvhCacheTest, IsOnlyAMissWhereNothingCanBeReadOrWritten) {
  const Example example(100);
  EXPECT_FALSE(storeBvh({}, example.key, example.bvh));
  EXPECT_FALSE(loadBvh({}, example.key, 100));
  const BvhCache notAFolder{.folder = "/dev/null/bvh"};
  EXPECT_FALSE(storeBvh(notAFolder, example.key, example.bvh));
  EXPECT_FALSE(loadBvh(notAFolder, example.key, 100));
  ASSERT_TRUE(storeBvh(cache_, example.key, example.bvh));
  const fs::path path = files().at(0);
  fs::remove(path);
  fs::create_directory(path);
  EXPECT_FALSE(loadBvh(cache_, example.key, 100)) << "a folder in the file's place";
  EXPECT_FALSE(storeBvh(cache_, example.key, example.bvh));
}

TEST_F(BvhCacheTest, SurvivesReadersAndWritersAtOnce) {
  const Example some(3000, 1), other(3000, 2);
  cache_.maxBytes = some.bvh.stats.sizeBytes + other.bvh.stats.sizeBytes / 2;  // one always evicts the other
  std::atomic<int> hits{0}, wrong{0};
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&, t] {
        const Example& own = t % 2 == 0 ? some : other;
        for (int i = 0; i < 40; ++i) {
          if (t < 2) storeBvh(cache_, own.key, own.bvh, 1);
          const auto loaded = loadBvh(cache_, own.key, 3000, 1);
          if (!loaded) continue;
          ++hits;
          if (loaded->order != own.bvh.order) ++wrong;
        }
      });
    }
  }
  EXPECT_GT(hits, 0);
  EXPECT_EQ(wrong, 0);
}

TEST_F(BvhCacheTest, BuildsTheSameTreeWithAndWithoutIt) {
  const auto soup = testing::randomSoup(kBvhCachePrimitives, 0.005, 12);
  std::vector<glm::vec3> corners;
  std::vector<std::uint32_t> indices;
  for (const auto& t : soup) {
    for (const glm::vec3& p : {t.v0, t.v1, t.v2}) {
      indices.push_back(static_cast<std::uint32_t>(corners.size()));
      corners.push_back(p);
    }
  }
  const BvhTriangles triangles{corners, indices};
  const Bvh plain = buildTriangleBvh(triangles);
  expectSame(plain, *CachedTrees(cache_).over(triangles));
  EXPECT_EQ(files().size(), 1u);
  expectSame(plain, *CachedTrees(cache_).over(triangles));
  const BvhTriangles few{corners, std::span(indices).first(300)};
  CachedTrees(cache_).over(few);
  EXPECT_EQ(files().size(), 1u) << "small trees are built anew";
}

TEST(BvhCacheFolder, FollowsTheEnvironment) {
  const auto restore = [](const char* name, const std::optional<std::string>& value) {
    value ? setenv(name, value->c_str(), 1) : unsetenv(name);
  };
  const auto get = [](const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? std::nullopt : std::optional<std::string>(value);
  };
  const auto cacheHome = get("XDG_CACHE_HOME"), home = get("HOME");
  setenv("XDG_CACHE_HOME", "/some/cache", 1);
  EXPECT_EQ(defaultBvhCache().folder, "/some/cache/crosslight/bvh");
  setenv("XDG_CACHE_HOME", "relative", 1);
  setenv("HOME", "/home/someone", 1);
  EXPECT_EQ(defaultBvhCache().folder, "/home/someone/.cache/crosslight/bvh");
  unsetenv("HOME");
  EXPECT_TRUE(defaultBvhCache().folder.empty());
  restore("XDG_CACHE_HOME", cacheHome);
  restore("HOME", home);
}

}  // namespace
}  // namespace crosslight
