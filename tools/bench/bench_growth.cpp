// How the time of tracing grows: with the number of triangles, and with the number of rays, on one thread and on two.
// Each run is a process of its own, because the software driver reads its number of threads once; shader caches warm.
#include <fmt/format.h>

#include <fstream>

#include "base/error.h"
#include "bench/bench.h"
#include "bench/knot_scene.h"
#include "bench/peer_programs.h"

namespace crosslight::bench {
namespace {

struct Point {
  std::string name;  // growth.triangles.10k
  std::uint32_t triangles, size;
};

class Growth {
 public:
  explicit Growth(Bench& bench) : bench_(bench), folder_(bench.scratch / "growth") {
    std::filesystem::create_directories(folder_ / "cache/mesa");
  }

  void run(const std::vector<Point>& points, const RoundOptions& options) {
    std::vector<Contender> contenders;
    for (const Point& point : points) {
      count(point);
      for (const unsigned threads : {1u, 2u}) {
        contenders.push_back([this, point, threads] { return render(point, threads); });
      }
    }
    const Rounds rounds = interleave(contenders, options);
    for (const Point& point : points) {
      const std::string one = seriesName(point, 1), two = seriesName(point, 2);
      bench_.report.compare(two, one, rounds, Quantity::time);
      for (const std::string& name : {one, two}) {
        bench_.report.addRate(name, rounds, rays_.at(point.name));
        bench_.report.addTime(name + ".whole", rounds);
      }
    }
  }

 private:
  static std::string seriesName(const Point& point, unsigned threads) {
    return fmt::format("{}.threads{}", point.name, threads);
  }

  // `NAME`: wall time of rendering, tracing and shading, as the record has it. `NAME`.whole: of the process.
  Measured render(const Point& point, unsigned threads) {
    const std::filesystem::path gltf = sceneOf(point.triangles), record = folder_ / "record.json";
    const PeerRun run =
        runMeasured(bench_.program,
                    {"render", gltf.string(), "-o", (folder_ / "picture.png").string(), "--method", "whitted",
                     "--max-depth", "0", "--resolution", fmt::format("{}x{}", point.size, point.size), "--bvh-cache",
                     "off", "--quiet", "--json", record.string()},
                    {{"LP_NUM_THREADS", std::to_string(threads)},
                     {"MESA_SHADER_CACHE_DIR", (folder_ / "cache/mesa").string()},
                     {"XDG_CACHE_HOME", (folder_ / "cache").string()},
                     {"MESA_SHADER_CACHE_DISABLE", ""},
                     {"MESA_GLSL_CACHE_DISABLE", ""}},
                    folder_);
    std::ifstream in(record);
    last_ = Json::parse(in);
    const std::string name = seriesName(point, threads);
    return {{name, last_.at("timings").at("renderMs")}, {name + ".whole", run.wallMs}};
  }

  std::filesystem::path sceneOf(std::uint32_t triangles) {
    std::filesystem::path& file = scenes_[triangles];
    if (file.empty()) file = writeKnotScene(folder_, triangles);
    return file;
  }

  void count(const Point& point) {
    render(point, 2);
    double rays = 0;
    for (const auto& [kind, number] : last_.at("rays").items()) rays += number.get<double>();
    rays_[point.name] = rays;
    bench_.report.addCheck(point.name + ".count", rays >= static_cast<double>(point.size) * point.size,
                           {{"rays", rays}, {"triangles", last_.at("scene").at("triangles")}});
  }

  Bench& bench_;
  std::filesystem::path folder_;
  std::map<std::uint32_t, std::filesystem::path> scenes_;
  std::map<std::string, double> rays_;
  Json last_;
};

}  // namespace

void benchGrowth(Bench& bench) {
  if (!std::filesystem::exists(bench.program)) {
    throw InputError(bench.program.string(), "there is no such program; build crosslight_program or give --program");
  }
  std::vector<std::uint32_t> triangles{1'000, 10'000, 100'000, 1'000'000}, sizes{128, 256, 512, 1024, 2048};
  if (bench.quick) triangles = {1'000, 2'000}, sizes = {32, 64};
  std::vector<Point> byTriangles, byRays;
  for (const std::uint32_t n : triangles) {
    byTriangles.push_back({"growth.triangles." + shortCount(n), n, bench.quick ? 32u : 512u});
  }
  for (const std::uint32_t size : sizes) {
    byRays.push_back({fmt::format("growth.rays.{}", size), bench.quick ? 1'000u : 100'000u, size});
  }
  Growth growth(bench);
  growth.run(byTriangles, bench.rounds);
  growth.run(byRays, bench.rounds);
  if (!bench.large) return;
  // Half a minute each: three rounds, so that an interval tells little, and none to warm up beyond the run that counts.
  growth.run({{"growth.triangles.10M", 10'000'000, 512}}, {.rounds = 3, .warmUps = 0, .shortestSeconds = 0});
}

}  // namespace crosslight::bench
