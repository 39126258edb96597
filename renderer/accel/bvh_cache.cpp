#include "accel/bvh_cache.h"

#include <algorithm>
#include <exception>
#include <string>

#include "accel/bvh_cache_file.h"
#include "accel/bvh_hash.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/time.h"

namespace crosslight {
namespace fs = std::filesystem;
namespace {

constexpr const char* kExtension = ".bvh";
constexpr std::size_t kNameDigits = 32;

std::string nameOf(const BvhKey& key) { return hexOf(key.high) + hexOf(key.low) + kExtension; }

// All that decides a tree's bits, besides the primitives.
accel::Digest digestOf(const BvhOptions& options, std::uint64_t kind, std::size_t primitives) {
  const std::uint64_t words[] = {accel::kBvhFileVersion,
                                 kind,
                                 primitives,
                                 options.maxLeafSize,
                                 options.binCount,
                                 static_cast<std::uint64_t>(options.quality),
                                 std::bit_cast<std::uint32_t>(options.nodeCost),
                                 std::bit_cast<std::uint32_t>(options.mostDuplicates)};
  return accel::digestOf(std::as_bytes(std::span(words)));
}

template <class... Lists>
BvhKey keyOf(const BvhOptions& options, std::uint64_t kind, std::size_t primitives, const Lists&... lists) {
  accel::Team team(accel::usefulThreads(options.threads, primitives / 8));
  const accel::Digest digests[] = {digestOf(options, kind, primitives),
                                   accel::digestOfPieces(std::as_bytes(lists), team)...};
  const accel::Digest all = accel::digestOf(std::as_bytes(std::span(digests)));
  return {all.a, all.b};
}

bool isCacheFile(const fs::path& path) {
  const std::string stem = path.stem().string();
  return path.extension() == kExtension && stem.size() == kNameDigits &&
         stem.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// What a process that was killed left behind; an hour is more than any write takes.
bool isForgotten(const fs::path& path, fs::file_time_type changed) {
  return path.extension() == kExtension && path.filename().string().starts_with(".") &&
         fs::file_time_type::clock::now() - changed > std::chrono::hours(1);
}

// Files vanish while this looks, because other processes do the same: every step may fail and is then passed over.
void evict(const BvhCache& cache) {
  struct Entry {
    fs::path path;
    std::uint64_t bytes;
    fs::file_time_type used;
  };
  std::vector<Entry> entries;
  std::uint64_t total = 0;
  std::error_code error;
  for (fs::directory_iterator file(cache.folder, error), end; !error && file != end; file.increment(error)) {
    std::error_code gone;
    const fs::file_time_type used = file->last_write_time(gone);
    const std::uint64_t bytes = gone ? 0 : file->file_size(gone);
    if (gone) continue;
    if (isForgotten(file->path(), used)) fs::remove(file->path(), gone);
    if (!isCacheFile(file->path())) continue;
    entries.push_back({file->path(), bytes, used});
    total += bytes;
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (const Entry& entry : entries) {
    if (total <= cache.maxBytes) return;
    fs::remove(entry.path, error);
    total -= entry.bytes;
  }
}

}  // namespace

BvhCache defaultBvhCache() {
  BvhCache cache;
  if (const fs::path folder = cacheFolder(); !folder.empty()) cache.folder = folder / "bvh";
  return cache;
}

BvhKey bvhKey(std::span<const Bounds> primitives, const BvhOptions& options) {
  return keyOf(options, 0, primitives.size(), primitives);
}

BvhKey bvhKey(const BvhTriangles& triangles, const BvhOptions& options) {
  return keyOf(options, 1, triangles.count(), triangles.positions, triangles.indices);
}

std::optional<Bvh> loadBvh(const BvhCache& cache, const BvhKey& key, std::size_t primitives, std::uint32_t threads) {
  if (cache.folder.empty()) return std::nullopt;
  const Stopwatch watch;
  const fs::path path = cache.folder / nameOf(key);
  try {
    accel::Team team(accel::usefulThreads(threads, primitives / 8));
    std::optional<Bvh> bvh = accel::readBvhFile(path, key, primitives, team);
    std::error_code ignored;
    if (!bvh) {
      if (fs::exists(path, ignored)) logWarning("the tree " + path.string() + " is damaged: it is built anew");
      return std::nullopt;
    }
    fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);  // evict() asks for it
    bvh->stats.buildMs = watch.elapsedMs();
    return bvh;
  } catch (const std::exception& trouble) {
    logVerbose(std::string("a tree of the cache is ignored: ") + trouble.what());
    return std::nullopt;
  }
}

bool storeBvh(const BvhCache& cache, const BvhKey& key, const Bvh& bvh, std::uint32_t threads) noexcept {
  try {
    if (cache.folder.empty() || bvh.stats.sizeBytes > cache.maxBytes) return false;
    fs::create_directories(cache.folder);
    accel::Team team(accel::usefulThreads(threads, bvh.nodes.size() / 8));
    accel::writeBvhFile(cache.folder / nameOf(key), key, bvh, team);
    evict(cache);
    return true;
  } catch (const std::exception& trouble) {
    logVerbose(std::string("a tree is not kept: ") + trouble.what());
    return false;
  }
}

}  // namespace crosslight
