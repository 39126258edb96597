#include "accel/bvh_cache_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <type_traits>

#include "accel/bvh_hash.h"
#include "accel/bvh_memory.h"
#include "base/error.h"
#include "base/file.h"

namespace crosslight::accel {
namespace {

constexpr std::array<char, 8> kMagic{'C', 'L', 'B', 'V', 'H', '2', '\r', '\n'};

struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kBvhFileVersion;
  std::uint32_t headerBytes = 0;
  BvhKey key;
  std::uint64_t nodes = 0, order = 0;  // counts
  std::uint32_t primitives = 0, leaves = 0, maxDepth = 0, unused = 0;
  double sahCost = 0, builtSahCost = 0;
  std::uint64_t peakBytes = 0;
  float bounds[6] = {};
  Digest nodesDigest, orderDigest;
  Digest ownDigest;  // of all above
};
static_assert(sizeof(Header) == 160 && std::is_trivially_copyable_v<Header>);

Digest digestOf(const Header& header) {
  return accel::digestOf(std::as_bytes(std::span(&header, 1)).first(offsetof(Header, ownDigest)));
}

template <class T>
std::span<std::byte> bytesOf(std::vector<T>& list) {
  return std::as_writable_bytes(std::span(list));
}

Header headerOf(const BvhKey& key, const Bvh& bvh, Team& team) {
  Header h;
  h.headerBytes = sizeof(Header);
  h.key = key;
  h.nodes = bvh.nodes.size();
  h.order = bvh.order.size();
  h.primitives = bvh.stats.primitives;
  h.leaves = bvh.stats.leafCount;
  h.maxDepth = bvh.stats.maxDepth;
  h.sahCost = bvh.stats.sahCost;
  h.builtSahCost = bvh.stats.builtSahCost;
  h.peakBytes = bvh.stats.peakBytes;
  std::memcpy(h.bounds, &bvh.bounds, sizeof(h.bounds));
  h.nodesDigest = digestOfPieces(std::as_bytes(std::span(bvh.nodes)), team);
  h.orderDigest = digestOfPieces(std::as_bytes(std::span(bvh.order)), team);
  h.ownDigest = digestOf(h);
  return h;
}

class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path)
      : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~OpenFile() {
    if (file_ >= 0) ::close(file_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  // Nothing for what is not a plain file.
  std::optional<std::uint64_t> size() const {
    struct stat info {};
    if (file_ < 0 || ::fstat(file_, &info) != 0 || !S_ISREG(info.st_mode)) return std::nullopt;
    return static_cast<std::uint64_t>(info.st_size);
  }

  bool read(std::uint64_t offset, std::span<std::byte> to) const {
    while (!to.empty()) {
      const ssize_t got = ::pread(file_, to.data(), to.size(), static_cast<off_t>(offset));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      offset += static_cast<std::uint64_t>(got);
      to = to.subspan(static_cast<std::size_t>(got));
    }
    return true;
  }

 private:
  int file_;
};

// Threads read pieces and hash them while they are in their caches.
bool readPieces(const OpenFile& file, std::uint64_t offset, std::span<std::byte> to, const Digest& expected,
                Team& team) {
  std::vector<Digest> digests((to.size() + kHashPiece - 1) / kHashPiece);
  std::atomic<bool> whole{true};
  team.forEach(static_cast<std::uint32_t>(digests.size()), [&](std::uint32_t i) {
    const std::size_t begin = i * kHashPiece;
    const std::span<std::byte> piece = to.subspan(begin, std::min(kHashPiece, to.size() - begin));
    if (!file.read(offset + begin, piece)) whole = false;
    digests[i] = accel::digestOf(piece);
  });
  return whole && accel::digestOf(std::as_bytes(std::span(digests))) == expected;
}

bool fits(const Header& h, const BvhKey& key, std::size_t primitives, std::uint64_t fileBytes) {
  if (h.magic != kMagic || h.version != kBvhFileVersion || h.headerBytes != sizeof(Header)) return false;
  if (!(h.ownDigest == digestOf(h)) || !(h.key == key) || h.primitives != primitives) return false;
  if (h.nodes < 1 || h.nodes > shared::kBvhFirstMask || h.order > shared::kBvhFirstMask) return false;
  return fileBytes == sizeof(Header) + h.nodes * sizeof(shared::BvhNode) + h.order * sizeof(std::uint32_t);
}

bool leafIsSound(std::uint32_t child, std::size_t orderSize) {
  return std::size_t{bvhLeafFirst(child)} + bvhLeafCount(child) <= orderSize;
}

// Follows depth-first order, which says of every node where its children must be.
bool nodesAreSound(const Bvh& bvh) {
  struct Waiting {
    std::uint32_t node, parent, depth;
  };
  std::vector<Waiting> waiting;
  std::uint32_t parent = shared::kNoId, depth = 1;
  const auto count = static_cast<std::uint32_t>(bvh.nodes.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const shared::BvhNode& node = bvh.nodes[i];
    if (node.parent != parent || node.splitAxis > 2 || depth >= shared::kBvhStackSize) return false;
    const bool leaf0 = bvhIsLeaf(node.child0), leaf1 = bvhIsLeaf(node.child1);
    if (leaf0 && !leafIsSound(node.child0, bvh.order.size())) return false;
    if (leaf1 && !leafIsSound(node.child1, bvh.order.size())) return false;
    if (!leaf0 && !leaf1) waiting.push_back({node.child1, i, depth + 1});
    if (!leaf0 || !leaf1) {
      if ((leaf0 ? node.child1 : node.child0) != i + 1) return false;
      parent = i;
      ++depth;
      continue;
    }
    if (waiting.empty()) return i + 1 == count;
    if (waiting.back().node != i + 1) return false;
    parent = waiting.back().parent;
    depth = waiting.back().depth;
    waiting.pop_back();
  }
  return false;  // the last node's child is missing
}

}  // namespace

bool isSoundTree(const Bvh& bvh, std::size_t primitives, Team& team) {
  bool sound[2] = {false, false};
  team.forEach(2, [&](std::uint32_t i) {
    sound[i] = i == 0
                   ? nodesAreSound(bvh)
                   : std::all_of(bvh.order.begin(), bvh.order.end(), [&](std::uint32_t p) { return p < primitives; });
  });
  return sound[0] && sound[1];
}

void writeBvhFile(const std::filesystem::path& path, const BvhKey& key, const Bvh& bvh, Team& team) {
  const Header header = headerOf(key, bvh, team);
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    const auto write = [&](const void* data, std::size_t bytes) {
      out.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
    };
    write(&header, sizeof(header));
    write(bvh.nodes.data(), bvh.nodes.size() * sizeof(shared::BvhNode));
    write(bvh.order.data(), bvh.order.size() * sizeof(std::uint32_t));
    out.flush();
    if (!out) throw InputError(path.string(), std::string("cannot be written: ") + std::strerror(errno));
  });
}

std::optional<Bvh> readBvhFile(const std::filesystem::path& path, const BvhKey& key, std::size_t primitives,
                               Team& team) {
  const OpenFile file(path);
  const std::optional<std::uint64_t> size = file.size();
  Header h;
  if (!size || !file.read(0, std::as_writable_bytes(std::span(&h, 1))) || !fits(h, key, primitives, *size))
    return std::nullopt;
  Bvh bvh;
  bvh.nodes.reserve(h.nodes);
  adviseHugePages(bvh.nodes.data(), h.nodes * sizeof(shared::BvhNode));
  bvh.nodes.resize(h.nodes);
  bvh.order.resize(h.order);
  const std::uint64_t nodesEnd = sizeof(Header) + h.nodes * sizeof(shared::BvhNode);
  if (!readPieces(file, sizeof(Header), bytesOf(bvh.nodes), h.nodesDigest, team) ||
      !readPieces(file, nodesEnd, bytesOf(bvh.order), h.orderDigest, team) || !isSoundTree(bvh, primitives, team))
    return std::nullopt;
  std::memcpy(&bvh.bounds, h.bounds, sizeof(h.bounds));
  bvh.stats = {.nodeCount = static_cast<std::uint32_t>(h.nodes),
               .leafCount = h.leaves,
               .maxDepth = h.maxDepth,
               .primitives = h.primitives,
               .sahCost = h.sahCost,
               .builtSahCost = h.builtSahCost,
               .sizeBytes = *size - sizeof(Header),
               .peakBytes = h.peakBytes};
  return bvh;
}

}  // namespace crosslight::accel
