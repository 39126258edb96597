#include "bench/embree_peer.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include <algorithm>
#include <cstring>

#include "base/check.h"
#include "base/time.h"
#include "bench/parallel.h"

namespace crosslight::bench {
namespace {

constexpr std::size_t kPiece = 4096;  // rays that a thread takes at once; a multiple of 8

// What Embree's manual asks of threads that trace: denormal numbers count as zero.
void flushDenormals() {
#if defined(__SSE__)
  constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
  _mm_setcsr(_mm_getcsr() | kFlushToZero | kDenormalsAreZero);
#endif
}

// Restores the calling thread's mode: it also runs the project's own arithmetic.
class DenormalsFlushed {
 public:
  DenormalsFlushed() { flushDenormals(); }
  ~DenormalsFlushed() {
#if defined(__SSE__)
    _mm_setcsr(before_);
#endif
  }

 private:
#if defined(__SSE__)
  unsigned before_ = _mm_getcsr();
#endif
};

// One for the process: its threads are started once.
RTCDevice sharedDevice(unsigned threads) {
  static const RTCDevice device = rtcNewDevice(fmt::format("threads={},start_threads=1", threads).c_str());
  CL_CHECK(device != nullptr);
  return device;
}

void checkNoError(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE) throw InternalError(fmt::format("Embree reports error {}", static_cast<int>(error)));
}

RTCBuildQuality qualityOf(EmbreeQuality quality) {
  return quality == EmbreeQuality::low ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM;
}

RTCIntersectContext contextFor(Coherence coherence) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags =
      coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

RTCRay rayOf(const PeerRay& r) {
  RTCRay ray{};
  ray.org_x = r.origin.x, ray.org_y = r.origin.y, ray.org_z = r.origin.z, ray.tnear = r.tMin;
  ray.dir_x = r.direction.x, ray.dir_y = r.direction.y, ray.dir_z = r.direction.z, ray.tfar = r.tMax;
  ray.mask = ~0u;
  return ray;
}

void putLane(RTCRay8& packet, std::size_t lane, const PeerRay& r) {
  packet.org_x[lane] = r.origin.x, packet.org_y[lane] = r.origin.y, packet.org_z[lane] = r.origin.z;
  packet.dir_x[lane] = r.direction.x, packet.dir_y[lane] = r.direction.y, packet.dir_z[lane] = r.direction.z;
  packet.tnear[lane] = r.tMin;
  packet.tfar[lane] = r.tMax;
  packet.mask[lane] = ~0u;
}

}  // namespace

bool embreeAvailable() { return true; }
std::string embreeVersion() { return RTC_VERSION_STRING; }

struct EmbreeRays::Packets {
  struct Packet {
    RTCRay8 rays;
    alignas(32) int valid[8];  // -1: the lane holds a ray
  };
  std::vector<Packet> list;
};

EmbreeRays::EmbreeRays(std::span<const PeerRay> rays, Coherence coherence)
    : rays_(rays.begin(), rays.end()),
      packets_(std::make_unique<Packets>()),
      hits_(rays.size()),
      blocked_(rays.size()),
      coherence_(coherence) {
  packets_->list.resize((rays.size() + 7) / 8);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Packets::Packet& packet = packets_->list[i / 8];
    putLane(packet.rays, i % 8, rays[i]);
    packet.valid[i % 8] = -1;
  }
}

EmbreeRays::~EmbreeRays() = default;

struct EmbreeMesh::Impl {
  std::vector<glm::vec3> positions;  // one more than there are: Embree reads 16 bytes at each
  std::vector<std::uint32_t> indices;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  unsigned threads = 1;
  double buildMs = 0;

  // trace(context, first, end) on all threads; wall milliseconds.
  template <class Trace>
  double run(const EmbreeRays& rays, Coherence coherence, const Trace& trace) const {
    const Stopwatch watch;
    parallelFor(rays.size(), kPiece, threads, [&](std::size_t first, std::size_t end) {
      const DenormalsFlushed mode;
      RTCIntersectContext context = contextFor(coherence);
      trace(context, first, end);
    });
    return watch.elapsedMs();
  }
};

EmbreeMesh::EmbreeMesh(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                       EmbreeQuality quality, unsigned threads)
    : impl_(std::make_unique<Impl>()) {
  Impl& m = *impl_;
  m.positions.assign(positions.begin(), positions.end());
  m.positions.emplace_back(0.0f);
  m.indices.assign(indices.begin(), indices.end());
  m.threads = threads;
  m.device = sharedDevice(threads);
  m.scene = rtcNewScene(m.device);
  RTCGeometry geometry = rtcNewGeometry(m.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, m.positions.data(), 0,
                             sizeof(glm::vec3), positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, m.indices.data(), 0,
                             3 * sizeof(std::uint32_t), indices.size() / 3);
  rtcSetGeometryBuildQuality(geometry, qualityOf(quality));
  rtcSetSceneBuildQuality(m.scene, qualityOf(quality));
  rtcAttachGeometry(m.scene, geometry);
  const Stopwatch watch;
  rtcCommitGeometry(geometry);
  rtcCommitScene(m.scene);
  m.buildMs = watch.elapsedMs();
  rtcReleaseGeometry(geometry);
  checkNoError(m.device);
}

EmbreeMesh::~EmbreeMesh() { rtcReleaseScene(impl_->scene); }

double EmbreeMesh::buildMs() const { return impl_->buildMs; }

double EmbreeMesh::closest1(EmbreeRays& rays) const {
  return impl_->run(rays, rays.coherence_, [&](RTCIntersectContext& context, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      alignas(16) RTCRayHit query{};
      query.ray = rayOf(rays.rays_[i]);
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(impl_->scene, &context, &query);
      const bool hit = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
      rays.hits_[i] = {query.ray.tfar, hit ? query.hit.primID : kPeerMiss};
    }
  });
}

double EmbreeMesh::closest8(EmbreeRays& rays) const {
  return impl_->run(rays, rays.coherence_, [&](RTCIntersectContext& context, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; i += 8) {
      const EmbreeRays::Packets::Packet& packet = rays.packets_->list[i / 8];
      alignas(32) RTCRayHit8 query;
      query.ray = packet.rays;
      std::fill(std::begin(query.hit.geomID), std::end(query.hit.geomID), RTC_INVALID_GEOMETRY_ID);
      rtcIntersect8(packet.valid, impl_->scene, &context, &query);
      for (std::size_t lane = 0; i + lane < end && lane < 8; ++lane) {
        const bool hit = query.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
        rays.hits_[i + lane] = {query.ray.tfar[lane], hit ? query.hit.primID[lane] : kPeerMiss};
      }
    }
  });
}

// Embree says "blocked" with tfar = -infinity.
double EmbreeMesh::occluded1(EmbreeRays& rays) const {
  return impl_->run(rays, rays.coherence_, [&](RTCIntersectContext& context, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      alignas(16) RTCRay query = rayOf(rays.rays_[i]);
      rtcOccluded1(impl_->scene, &context, &query);
      rays.blocked_[i] = query.tfar < 0 ? 1 : 0;
    }
  });
}

double EmbreeMesh::occluded8(EmbreeRays& rays) const {
  return impl_->run(rays, rays.coherence_, [&](RTCIntersectContext& context, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; i += 8) {
      const EmbreeRays::Packets::Packet& packet = rays.packets_->list[i / 8];
      alignas(32) RTCRay8 query = packet.rays;
      rtcOccluded8(packet.valid, impl_->scene, &context, &query);
      for (std::size_t lane = 0; i + lane < end && lane < 8; ++lane)
        rays.blocked_[i + lane] = query.tfar[lane] < 0 ? 1 : 0;
    }
  });
}

}  // namespace crosslight::bench
