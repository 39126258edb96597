// Rays per second of the traversal kernels against Embree on the same rays, on as many threads. Ours come in the order
// in which the tracer makes them (rows of pixels), Embree's in Morton order, which suits its packets best. Rates:
// more is better. That both find the same hits is checked before anything is timed.
#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "bench/bench.h"
#include "bench/embree_peer.h"
#include "bench/host_rays.h"
#include "bench/knot_scene.h"
#include "bench/ray_kernels.h"
#include "scene/load.h"
#include "upload/records.h"

namespace crosslight::bench {
namespace {

// Both sides are single precision, and a ray that passes an edge within rounding may fall on either side of it. That is
// a strip of about 16 u L on each side of an edge seen from a distance L (u = 2^-24), against a pixel of L / 1024 and
// more: 1e-3 of a pixel. Silhouettes cross fewer than one pixel in ten: 1e-4 of all rays. A wrong kernel fails on more.
constexpr double kMostDisagreements = 1e-4;
// Relative difference of distances that is counted as a different hit: far above what rounding explains (16 u and, at a
// grazing angle, its multiple by 1 / cosine), far below the step between neighboring triangles at an edge.
constexpr double kFarT = 1e-4;

struct Agreement {
  std::size_t rays = 0, hits = 0, disagreements = 0, farApart = 0;

  Json json() const {
    return {{"rays", rays}, {"hits", hits}, {"hitMissDisagreements", disagreements}, {"distancesApart", farApart}};
  }
  bool holds() const {
    return static_cast<double>(disagreements + farApart) <= kMostDisagreements * static_cast<double>(rays) + 1.0;
  }
};

// `ours` by node, `theirs` by position in the list.
Agreement compareHits(const HostRays& list, const std::vector<shared::HitRecord>& ours, const EmbreeRays& theirs,
                      const std::vector<std::uint32_t>& slotOfNode) {
  Agreement result{.rays = list.rays.size()};
  for (std::size_t i = 0; i < list.rays.size(); ++i) {
    const shared::HitRecord& mine = ours[slotOfNode[list.nodes[i]]];
    const PeerHit& other = theirs.hits()[i];
    const bool hit = mine.primitive != shared::kNoHit;
    result.hits += hit ? 1 : 0;
    if (hit != (other.triangle != kPeerMiss)) {
      ++result.disagreements;
    } else if (hit && !(std::abs(mine.t - other.t) <= kFarT * std::abs(other.t))) {
      ++result.farApart;
    }
  }
  return result;
}

Agreement compareShadows(const HostRays& list, const std::vector<float>& visibility, const EmbreeRays& theirs) {
  Agreement result{.rays = list.rays.size()};
  for (std::size_t i = 0; i < list.rays.size(); ++i) {
    const bool blocked = visibility[list.nodes[i]] == 0.0f;
    result.hits += blocked ? 1 : 0;
    if (blocked != (theirs.blocked()[i] != 0)) ++result.disagreements;
  }
  return result;
}

// One picture: everything that both sides need, made once.
class Picture {
 public:
  Picture(Bench& bench, std::uint32_t triangles, std::uint32_t size)
      : bench_(bench),
        name_(fmt::format("rays.{}.{}", shortCount(triangles), size)),
        size_(size),
        scene_(loadScene(writeKnotScene(bench.scratch, triangles))),
        settings_(knotSettings(Method::whitted, size, size)),
        plan_(makePlan(scene_, settings_)),
        flat_(flattenScene(scene_, renderOrigin(scene_.cameras[0]), true)),
        bvh_(buildFlatBvh(flat_, scene_, settings_)),
        gpuScene_(bench.device(), scene_, settings_, flat_, &bvh_),
        kernels_(bench.device(), gpuScene_, plan_, settings_) {
    makeRays();
  }

  void run() {
    std::vector<Contender> contenders = ours();
    if (embreeAvailable()) {
      startEmbree();
      check();
      for (Contender& c : theirs()) contenders.push_back(std::move(c));
    }
    const Rounds rounds = interleave(contenders, bench_.rounds);
    report(rounds);
    const RayKernels::Counts counts = kernels_.takeCounts();
    bench_.report.addCheck(name_ + ".traversalLimit", counts.capped + counts.gaveUp == 0,
                           {{"cappedTraversals", counts.capped}});
  }

 private:
  void makeRays() {
    kernels_.camera();
    kernels_.takeCounts();
    kernels_.shadow();
    hits_ = kernels_.hits();
    const glm::vec3 light = makeLightRecords(scene_, renderOrigin(scene_.cameras[0])).front().renderPosition;
    camera_ = cameraRays(makeFrameRecord(scene_, settings_, glm::vec2(0.5f)), hits_.size());
    shadow_ = shadowRays(camera_, hits_, bvh_.primitives, light);
    bounce_ = bounceRays(camera_, hits_, bvh_.primitives, kRaySeed);
    const RayKernels::Counts counts = kernels_.takeCounts();
    bench_.report.addCheck(name_ + ".shadowRays", counts.shadowRays == shadow_.rays.size() && !shadow_.rays.empty(),
                           {{"traced", counts.shadowRays}, {"rebuilt", shadow_.rays.size()}});
    if (bounce_.rays.empty()) throw InternalError("the camera sees nothing of the knot scene");
    kernels_.setBounceRays(asRayRecords(bounce_));
  }

  void startEmbree() {
    mesh_.emplace(flat_.positions, flat_.indices, EmbreeQuality::medium, peerThreads());
    cameraOrdered_ = inMortonOrder(camera_, size_);
    shadowOrdered_ = inMortonOrder(shadow_, size_);
    bounceOrdered_ = inMortonOrder(bounce_, size_);
    embreeCamera_.emplace(cameraOrdered_.rays, Coherence::coherent);
    embreeShadow_.emplace(shadowOrdered_.rays, Coherence::coherent);
    embreeBounce_.emplace(bounceOrdered_.rays, Coherence::incoherent);
  }

  void check() {
    std::vector<std::uint32_t> same(hits_.size()), bounceSlot(hits_.size());
    for (std::uint32_t i = 0; i < same.size(); ++i) same[i] = i;
    for (std::uint32_t i = 0; i < bounce_.nodes.size(); ++i) bounceSlot[bounce_.nodes[i]] = i;
    kernels_.bounce();
    const auto add = [&](const char* kind, const Agreement& a) {
      bench_.report.addCheck(name_ + kind, a.holds(), a.json());
    };
    mesh_->closest1(*embreeCamera_);
    add(".primary.embree1", compareHits(cameraOrdered_, hits_, *embreeCamera_, same));
    mesh_->closest8(*embreeCamera_);
    add(".primary.embree8", compareHits(cameraOrdered_, hits_, *embreeCamera_, same));
    mesh_->occluded1(*embreeShadow_);
    add(".shadow.embree1", compareShadows(shadowOrdered_, kernels_.visibility(), *embreeShadow_));
    mesh_->occluded8(*embreeShadow_);
    add(".shadow.embree8", compareShadows(shadowOrdered_, kernels_.visibility(), *embreeShadow_));
    mesh_->closest1(*embreeBounce_);
    add(".bounce.embree1", compareHits(bounceOrdered_, kernels_.bounceHits(), *embreeBounce_, bounceSlot));
    mesh_->closest8(*embreeBounce_);
    add(".bounce.embree8", compareHits(bounceOrdered_, kernels_.bounceHits(), *embreeBounce_, bounceSlot));
  }

  Contender timed(const std::string& what, std::function<double()> run) const {
    return [name = name_ + what, run = std::move(run)] { return Measured{{name, run()}}; };
  }

  std::vector<Contender> ours() {
    return {timed(".primary", [&] { return kernels_.camera(); }), timed(".shadow", [&] { return kernels_.shadow(); }),
            timed(".bounce", [&] { return kernels_.bounce(); })};
  }

  std::vector<Contender> theirs() {
    return {timed(".primary.embree1", [&] { return mesh_->closest1(*embreeCamera_); }),
            timed(".primary.embree8", [&] { return mesh_->closest8(*embreeCamera_); }),
            timed(".shadow.embree1", [&] { return mesh_->occluded1(*embreeShadow_); }),
            timed(".shadow.embree8", [&] { return mesh_->occluded8(*embreeShadow_); }),
            timed(".bounce.embree1", [&] { return mesh_->closest1(*embreeBounce_); }),
            timed(".bounce.embree8", [&] { return mesh_->closest8(*embreeBounce_); })};
  }

  void report(const Rounds& rounds) {
    const std::pair<const char*, std::size_t> kinds[] = {
        {".primary", camera_.rays.size()}, {".shadow", shadow_.rays.size()}, {".bounce", bounce_.rays.size()}};
    for (const auto& [kind, count] : kinds) {
      const std::string ours = name_ + kind;
      bench_.report.addTime(ours, rounds);
      bench_.report.addRate(ours, rounds, static_cast<double>(count));
      if (!embreeAvailable()) continue;
      for (const char* width : {".embree1", ".embree8"}) {
        bench_.report.compare(ours, ours + width, rounds, Quantity::rate);
        bench_.report.addRate(ours + width, rounds, static_cast<double>(count));
      }
    }
  }

  Bench& bench_;
  std::string name_;
  std::uint32_t size_;
  Scene scene_;
  RenderSettings settings_;
  Plan plan_;
  FlatScene flat_;
  FlatBvh bvh_;
  GpuScene gpuScene_;
  RayKernels kernels_;
  std::vector<shared::HitRecord> hits_;
  HostRays camera_, shadow_, bounce_, cameraOrdered_, shadowOrdered_, bounceOrdered_;
  std::optional<EmbreeMesh> mesh_;
  std::optional<EmbreeRays> embreeCamera_, embreeShadow_, embreeBounce_;
};

}  // namespace

void benchRays(Bench& bench) {
  if (!embreeAvailable()) bench.report.omit("rays against Embree", kNoEmbree);
  if (bench.quick) return Picture(bench, 2'000, 64).run();
  for (const std::uint32_t size : {512u, 1024u}) Picture(bench, 100'000, size).run();
  if (bench.large) Picture(bench, 1'000'000, 1024).run();
}

}  // namespace crosslight::bench
