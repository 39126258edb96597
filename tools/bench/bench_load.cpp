// Loading: everything from the file to the Scene (validation, accessors, normals, bounds), against tinygltf's parse
// alone, which stops at raw buffers. The ratio is the price of all that tinygltf leaves to its user.
#include "base/check.h"
#include "base/time.h"
#include "bench/bench.h"
#include "bench/knot_scene.h"
#include "bench/tinygltf_peer.h"
#include "scene/load.h"

namespace crosslight::bench {
namespace {

void loadFile(Bench& bench, const std::string& name, const std::filesystem::path& file) {
  const std::string theirs = name + ".tinygltf";
  const Contender load = [&] {
    const Stopwatch watch;
    const Scene scene = loadScene(file);
    const double ms = watch.elapsedMs();
    CL_CHECK(scene.stats.triangles > 0);
    return Measured{{name, ms}};
  };
  const Contender parse = [&] {
    const Stopwatch watch;
    const std::size_t accessors = parseWithTinygltf(file);
    const double ms = watch.elapsedMs();
    CL_CHECK(accessors > 0);
    return Measured{{theirs, ms}};
  };
  const Rounds rounds = interleave({load, parse}, bench.rounds);
  bench.report.compare(name, theirs, rounds, Quantity::time);
}

}  // namespace

void benchLoad(Bench& bench) {
  loadFile(bench, "load.teapots", bench.scenes / "showcase/teapots.gltf");
  const std::uint32_t triangles = bench.quick ? 2'000 : 100'000;
  loadFile(bench, "load.knot_" + shortCount(triangles), writeKnotScene(bench.scratch, triangles));
}

}  // namespace crosslight::bench
