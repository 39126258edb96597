// Embree as a peer of the BVH builder and the ray kernels. Without Embree the same names are there (embree_absent.cpp)
// and say so.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace crosslight::bench {

bool embreeAvailable();
std::string embreeVersion();  // "3.13.5"; "" without it

struct PeerRay {
  glm::vec3 origin;
  float tMin = 0;
  glm::vec3 direction;
  float tMax = 0;
};

inline constexpr std::uint32_t kPeerMiss = 0xffffffffu;
struct PeerHit {
  float t = 0;
  std::uint32_t triangle = kPeerMiss;
};

enum class EmbreeQuality { low, medium };
enum class Coherence { coherent, incoherent };

// Rays with room for their answers, laid out beforehand as each call likes them best: one by one, and in packets of 8.
// The order should be Morton's: packets then hold neighbors.
class EmbreeRays {
 public:
  EmbreeRays(std::span<const PeerRay> rays, Coherence coherence);
  ~EmbreeRays();
  std::size_t size() const { return hits_.size(); }
  const std::vector<PeerHit>& hits() const { return hits_; }             // of the last closest*()
  const std::vector<std::uint8_t>& blocked() const { return blocked_; }  // 0 or 1; of the last occluded*()

 private:
  friend class EmbreeMesh;
  std::vector<PeerRay> rays_;
  struct Packets;
  std::unique_ptr<Packets> packets_;
  std::vector<PeerHit> hits_;
  std::vector<std::uint8_t> blocked_;
  Coherence coherence_;
};

// A triangle mesh under Embree's own BVH; single precision, not "robust": its fastest setting.
class EmbreeMesh {
 public:
  EmbreeMesh(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices, EmbreeQuality quality,
             unsigned threads);
  ~EmbreeMesh();

  double buildMs() const;  // rtcCommitGeometry and rtcCommitScene alone

  // Milliseconds of wall time for all rays on `threads` threads.
  double closest1(EmbreeRays& rays) const;
  double closest8(EmbreeRays& rays) const;
  double occluded1(EmbreeRays& rays) const;
  double occluded8(EmbreeRays& rays) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace crosslight::bench
