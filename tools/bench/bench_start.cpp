// From process start to a PNG: cold (an empty shader cache, as on the first run ever) and warm (the same run once
// more), each with its parts from the program's own record. What the record does not count, the loader of shared
// libraries and the process's end, is `process`.
#include <fmt/format.h>

#include <fstream>

#include "base/check.h"
#include "base/error.h"
#include "bench/bench.h"
#include "bench/child_process.h"

namespace crosslight::bench {
namespace {

class StartRun {
 public:
  explicit StartRun(Bench& bench) : bench_(bench), folder_(bench.scratch / "start") {
    std::filesystem::create_directories(folder_);
  }

  // A cache folder that nobody used before, and the record of one run with it.
  Measured cold() {
    const std::filesystem::path cache = folder_ / fmt::format("cold{}", ++colds_);
    Measured measured = run("start.cold", cache);
    std::filesystem::remove_all(cache);
    return measured;
  }

  // Its warm-up rounds fill the folder.
  Measured warm() { return run("start.warm", folder_ / "warm"); }

 private:
  Measured run(const std::string& name, const std::filesystem::path& cache) {
    std::filesystem::create_directories(cache / "mesa");
    const std::filesystem::path picture = folder_ / "teapot.png", record = folder_ / "record.json";
    std::filesystem::remove(picture);
    const char* size = bench_.quick ? "64x64" : "512x512";
    const double wallMs =
        runProgram(bench_.program,
                   {"render", (bench_.scenes / "showcase/teapot.gltf").string(), "-o", picture.string(), "--method",
                    "phong", "--resolution", size, "--quiet", "--json", record.string()},
                   {{"MESA_SHADER_CACHE_DIR", (cache / "mesa").string()},
                    {"XDG_CACHE_HOME", cache.string()},
                    {"MESA_SHADER_CACHE_DISABLE", ""},
                    {"MESA_GLSL_CACHE_DISABLE", ""}},
                   folder_);
    CL_CHECK(std::filesystem::exists(picture));
    return partsOf(name, record, wallMs);
  }

  static Measured partsOf(const std::string& name, const std::filesystem::path& file, double wallMs) {
    std::ifstream in(file);
    const Json record = Json::parse(in);
    Measured measured{{name, wallMs}};
    for (const auto& [key, value] : record.at("timings").items()) {
      const std::string part = key.substr(0, key.rfind("Ms"));
      if (part == "total") {
        measured.emplace_back(name + ".process", wallMs - value.get<double>());
      } else {
        measured.emplace_back(name + "." + part, value.get<double>());
      }
    }
    return measured;
  }

  Bench& bench_;
  std::filesystem::path folder_;
  unsigned colds_ = 0;
};

}  // namespace

void benchStart(Bench& bench) {
  if (!std::filesystem::exists(bench.program)) {
    throw InputError(bench.program.string(), "there is no such program; build crosslight_program or give --program");
  }
  StartRun start(bench);
  const Rounds rounds = interleave({[&] { return start.cold(); }, [&] { return start.warm(); }}, bench.rounds);
  bench.report.compare("start.warm", "start.cold", rounds, Quantity::time);
  for (const auto& [name, ms] : rounds.series) bench.report.addTime(name, rounds);
}

}  // namespace crosslight::bench
