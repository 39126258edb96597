// BVH construction against Embree's, on as many threads. Two figures of ours: the tree from ready boxes, and all that a
// scene pays (boxes from vertices, tree, primitives in leaf order), which is what Embree's commit does too.
#include "accel/bvh.h"

#include "base/check.h"
#include "base/time.h"
#include "bench/bench.h"
#include "bench/cpu_time.h"
#include "bench/embree_peer.h"
#include "bench/knot_scene.h"
#include "scene/load.h"
#include "upload/flatten.h"
#include "upload/records.h"

namespace crosslight::bench {
namespace {

std::vector<Bounds> boxesOf(const FlatScene& flat) {
  std::vector<Bounds> boxes(flat.triangleCount());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) boxes[i].add(flat.positions[flat.indices[3 * i + k]]);
  }
  return boxes;
}

std::vector<Contender> ourBuilds(const std::string& name, const FlatScene& flat, const Scene& scene,
                                 const std::vector<Bounds>& boxes, unsigned threads) {
  const Contender tree = [=, &boxes] {
    BvhOptions options;
    options.threads = threads;
    const Stopwatch watch;
    const Bvh bvh = buildBvh(boxes, options);
    const double ms = watch.elapsedMs();
    CL_CHECK_EQ(bvh.order.size(), boxes.size());
    return Measured{{name + ".tree", ms}};
  };
  const Contender whole = [=, &flat, &scene] {
    const RenderSettings settings = knotSettings(Method::whitted, 1, 1);
    const Stopwatch watch;
    const FlatBvh bvh = buildFlatBvh(flat, scene, settings);
    const double ms = watch.elapsedMs();
    CL_CHECK_EQ(bvh.primitives.size(), boxes.size());
    return Measured{{name + ".whole", ms}};
  };
  return {tree, whole};
}

Contender embreeBuild(const std::string& name, const FlatScene& flat, EmbreeQuality quality, unsigned threads) {
  return [=, &flat] { return Measured{{name, EmbreeMesh(flat.positions, flat.indices, quality, threads).buildMs()}}; };
}

void buildTrees(Bench& bench, std::uint32_t triangles) {
  const std::string name = "bvh." + shortCount(triangles);
  const Scene scene = loadScene(writeKnotScene(bench.scratch, triangles));
  const FlatScene flat = flattenScene(scene, renderOrigin(scene.cameras[0]), true);
  const std::vector<Bounds> boxes = boxesOf(flat);
  const unsigned threads = cpuCount();  // what buildFlatBvh takes by itself
  std::vector<Contender> contenders = ourBuilds(name, flat, scene, boxes, threads);
  const std::string low = name + ".embree_low", medium = name + ".embree_medium";
  if (embreeAvailable()) {
    contenders.push_back(embreeBuild(low, flat, EmbreeQuality::low, threads));
    contenders.push_back(embreeBuild(medium, flat, EmbreeQuality::medium, threads));
  }
  const Rounds rounds = interleave(contenders, bench.rounds);
  for (const char* part : {".tree", ".whole"}) {
    bench.report.addTime(name + part, rounds);
    if (!embreeAvailable()) continue;
    bench.report.compare(name + part, low, rounds, Quantity::time);
    bench.report.compare(name + part, medium, rounds, Quantity::time);
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
