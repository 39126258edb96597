// Built where CMake found no Embree.
#include "base/error.h"
#include "bench/embree_peer.h"

namespace crosslight::bench {
namespace {

[[noreturn]] void absent() { throw InternalError("this program was built without Embree"); }

}  // namespace

bool embreeAvailable() { return false; }
std::string embreeVersion() { return ""; }

struct EmbreeRays::Packets {};
EmbreeRays::EmbreeRays(std::span<const PeerRay>, Coherence coherence) : coherence_(coherence) { absent(); }
EmbreeRays::~EmbreeRays() = default;

struct EmbreeMesh::Impl {};
EmbreeMesh::EmbreeMesh(std::span<const glm::vec3>, std::span<const std::uint32_t>, EmbreeQuality, unsigned) {
  absent();
}
EmbreeMesh::~EmbreeMesh() = default;
double EmbreeMesh::buildMs() const { absent(); }
double EmbreeMesh::closest1(EmbreeRays&) const { absent(); }
double EmbreeMesh::closest8(EmbreeRays&) const { absent(); }
double EmbreeMesh::occluded1(EmbreeRays&) const { absent(); }
double EmbreeMesh::occluded8(EmbreeRays&) const { absent(); }

}  // namespace crosslight::bench
