// BVH construction against Embree's, on as many threads: the tree from ready boxes in each quality, from triangles, and
// all that a scene pays (boxes from vertices, tree, primitives in leaf order), which is what Embree's commit does too.
// Beside them what spares a build: refitting, and loading from the cache.
#include "accel/bvh.h"

#include "accel/bvh_cache.h"
#include "accel/refit.h"
#include "base/check.h"
#include "base/time.h"
#include "bench/bench.h"
#include "bench/cpu_time.h"
#include "bench/embree_peer.h"
#include "bench/knot_scene.h"
#include "scene/load.h"
#include "upload/flat_bvh.h"
#include "upload/records.h"

namespace crosslight::bench {
namespace {

// What all contenders of one size read; it stays where it is.
struct Input {
  std::string name;
  Scene scene;
  FlatScene flat;
  std::vector<Bounds> boxes;
  unsigned threads = cpuCount();  // what buildFlatBvh takes by itself
  BvhCache cache;

  Input(const Bench& bench, std::uint32_t triangles)
      : name("bvh." + shortCount(triangles)),
        scene(loadScene(writeKnotScene(bench.scratch, triangles))),
        flat(flattenScene(scene, renderOrigin(scene.cameras[0]), true)),
        boxes(flat.triangleCount()),
        cache{.folder = bench.scratch / "trees"} {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) boxes[i].add(flat.positions[flat.indices[3 * i + k]]);
    }
  }

  BvhTriangles triangles() const { return {flat.positions, flat.indices}; }
  BvhOptions options(BvhQuality quality) const { return {.threads = threads, .quality = quality}; }
  Bvh build(BvhQuality quality) const { return buildTriangleBvh(triangles(), options(quality)); }
};

template <class Work>
Contender timed(const std::string& name, const Work& work) {
  return [name, work] {
    const Stopwatch watch;
    work();
    return Measured{{name, watch.elapsedMs()}};
  };
}

std::vector<Contender> ourBuilds(const Input& in) {
  return {
      timed(in.name + ".tree",
            [&in] { CL_CHECK_EQ(buildBvh(in.boxes, in.options(BvhQuality::medium)).order.size(), in.boxes.size()); }),
      timed(in.name + ".fast", [&in] { in.build(BvhQuality::fast); }),
      timed(in.name + ".medium", [&in] { in.build(BvhQuality::medium); }),
      timed(in.name + ".high", [&in] { in.build(BvhQuality::high); }), timed(in.name + ".whole", [&in] {
        const FlatBvh bvh = buildFlatBvh(in.flat, in.scene, knotSettings(Method::whitted, 1, 1));
        CL_CHECK_EQ(bvh.primitives.size(), in.boxes.size());
      })};
}

// Loading includes the key, which a program needs to know what to load.
std::vector<Contender> sparedBuilds(const Input& in, Bvh& refitted) {
  CL_CHECK(storeBvh(in.cache, bvhKey(in.triangles(), in.options(BvhQuality::medium)), in.build(BvhQuality::medium)));
  return {timed(in.name + ".refit", [&in, &refitted] { refit(refitted, in.boxes, in.threads); }),
          timed(in.name + ".load", [&in] {
            const BvhKey key = bvhKey(in.triangles(), in.options(BvhQuality::medium));
            CL_CHECK(loadBvh(in.cache, key, in.boxes.size(), in.threads).has_value());
          })};
}

Contender embreeBuild(const std::string& name, const FlatScene& flat, EmbreeQuality quality, unsigned threads) {
  return [=, &flat] { return Measured{{name, EmbreeMesh(flat.positions, flat.indices, quality, threads).buildMs()}}; };
}

// A quality that costs rays more than the one below it has missed its purpose; 1 % for what a greedy choice may lose.
void reportCosts(Bench& bench, const Input& in) {
  const Bvh fast = in.build(BvhQuality::fast), medium = in.build(BvhQuality::medium), high = in.build(BvhQuality::high);
  constexpr double kGreedyLoss = 1.01;
  const bool ordered = high.stats.sahCost <= kGreedyLoss * medium.stats.sahCost &&
                       medium.stats.sahCost <= kGreedyLoss * fast.stats.sahCost;
  bench.report.addCheck(
      in.name + ".sahCost", ordered,
      {{"fast", fast.stats.sahCost},
       {"medium", medium.stats.sahCost},
       {"high", high.stats.sahCost},
       {"bytesPerPrimitive", medium.stats.bytesPerPrimitive()},
       {"peakBytesPerPrimitive", static_cast<double>(medium.stats.peakBytes) / medium.stats.primitives}});
}

void buildTrees(Bench& bench, std::uint32_t triangles) {
  const Input in(bench, triangles);
  reportCosts(bench, in);
  Bvh refitted = in.build(BvhQuality::medium);
  std::vector<Contender> contenders = ourBuilds(in);
  for (Contender& c : sparedBuilds(in, refitted)) contenders.push_back(std::move(c));
  const std::string low = in.name + ".embree_low", medium = in.name + ".embree_medium";
  if (embreeAvailable()) {
    contenders.push_back(embreeBuild(low, in.flat, EmbreeQuality::low, in.threads));
    contenders.push_back(embreeBuild(medium, in.flat, EmbreeQuality::medium, in.threads));
  }
  const Rounds rounds = interleave(contenders, bench.rounds);
  for (const char* part : {".tree", ".fast", ".medium", ".high", ".whole"}) {
    bench.report.addTime(in.name + part, rounds);
    if (!embreeAvailable()) continue;
    bench.report.compare(in.name + part, low, rounds, Quantity::time);
    bench.report.compare(in.name + part, medium, rounds, Quantity::time);
  }
  for (const char* part : {".refit", ".load"}) {
    bench.report.compare(in.name + part, in.name + ".medium", rounds, Quantity::time);
  }
}

}  // namespace

void benchBvh(Bench& bench) {
  if (!embreeAvailable()) bench.report.omit("bvh against Embree", kNoEmbree);
  if (bench.quick) return buildTrees(bench, 2'000);
  buildTrees(bench, 10'000);
  buildTrees(bench, 100'000);
  if (bench.large) buildTrees(bench, 1'000'000);
}

}  // namespace crosslight::bench
