// crosslight_bench [SUITE]...: the benchmarks against peers; see README.md. Wires, and nothing more.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <optional>

#include "app/output.h"
#include "base/error.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/time.h"
#include "bench/bench.h"
#include "bench/cpu_time.h"
#include "bench/embree_peer.h"
#include "bench/osmesa_peer.h"
#include "bench/peer_programs.h"

namespace crosslight::bench {
namespace {

struct Suite {
  const char* name;
  void (*run)(Bench&);
  bool onlyNamed = false;  // many minutes: not part of "all"
};
constexpr Suite kSuites[] = {
    {"load", benchLoad},   {"bvh", benchBvh},           {"rays", benchRays},           {"raster", benchRaster},
    {"start", benchStart}, {"peers", benchPeers, true}, {"growth", benchGrowth, true}, {"effects", benchEffects, true}};

constexpr const char* kUsage =
    "usage: crosslight_bench [load|bvh|rays|raster|start|peers|growth|effects]... --scenes DIR [option]...\n"
    "when none is named, all but peers, growth and effects\n"
    "  --json FILE|-    write a record too; '-' is stdout, the table then goes to stderr\n"
    "  --rounds N       rounds that count, after 2 to warm up; 9 at least for a result (15)\n"
    "  --large          a million triangles too; ten million in growth\n"
    "  --pictures DIR   keep the pictures of peers\n"
    "  --only TEXT      scenes of effects whose names hold it: 'showcase/', 'feature/mirror'\n"
    "  --quick          tiny sizes: does it run at all?\n"
    "  --device NAME    as in 'crosslight render'\n"
    "  --program FILE   crosslight, for start, peers and growth (beside this program)\n"
    "  --peers          say which peers this build has, and end\n";

struct Options {
  std::vector<const Suite*> suites;
  std::string json, device, only;
  std::filesystem::path scenes, program, pictures;
  std::size_t rounds = 15;
  bool quick = false, large = false, peers = false, help = false;
};

std::size_t positiveNumber(const std::string& text) {
  char* end = nullptr;
  const unsigned long value = std::strtoul(text.c_str(), &end, 10);
  constexpr unsigned long kMostRounds = 1000;
  if (text.empty() || *end != '\0' || text.front() == '-' || value < 1 || value > kMostRounds) {
    throw UsageError(fmt::format("--rounds: '{}' is no number from 1 to {}", text, kMostRounds));
  }
  return value;
}

const Suite* suiteNamed(const std::string& name) {
  for (const Suite& suite : kSuites) {
    if (name == suite.name) return &suite;
  }
  throw UsageError("unexpected '" + name + "'\n" + kUsage);
}

Options parse(const std::vector<std::string>& words) {
  Options o;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const auto value = [&]() -> const std::string& {
      if (i + 1 == words.size()) throw UsageError(word + " needs a value\n" + kUsage);
      return words[++i];
    };
    if (word == "--json")
      o.json = value();
    else if (word == "--rounds")
      o.rounds = positiveNumber(value());
    else if (word == "--device")
      o.device = value();
    else if (word == "--program")
      o.program = value();
    else if (word == "--scenes")
      o.scenes = value();
    else if (word == "--pictures")
      o.pictures = value();
    else if (word == "--only")
      o.only = value();
    else if (word == "--quick")
      o.quick = true;
    else if (word == "--large")
      o.large = true;
    else if (word == "--peers")
      o.peers = true;
    else if (word == "--help" || word == "-h")
      o.help = true;
    else
      o.suites.push_back(suiteNamed(word));
  }
  if (o.suites.empty()) {
    for (const Suite& suite : kSuites) {
      if (!suite.onlyNamed) o.suites.push_back(&suite);
    }
  }
  return o;
}

// A folder that goes away with its owner.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "crosslight_bench_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw InputError(pattern, "cannot be made: " + std::string(strerror(errno)));
    path_ = pattern;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string utcDate() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  return fmt::format("{}-{:02}-{:02}", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday);
}

std::string loadAverage() {
  double average[3] = {};
  if (getloadavg(average, 3) != 3) return "unknown";
  return fmt::format("{:.2f} {:.2f} {:.2f}", average[0], average[1], average[2]);
}

Json recordOf(const Bench& bench, const std::vector<std::string>& words, const gpu::Device* device,
              const Times& timesMs, const std::string& loadAtStart) {
  Json record = newRecord({"bench", words, kRaySeed, device ? &device->info() : nullptr, timesMs});
  record["settings"] = {{"date", utcDate()},
                        {"rounds", bench.rounds.rounds},
                        {"warmUps", bench.rounds.warmUps},
                        {"shortestRoundSeconds", bench.rounds.shortestSeconds},
                        {"quick", bench.quick},
                        {"large", bench.large},
                        {"validation", device && device->validationOn()},
                        {"cpus", cpuCount()},
                        {"peerThreads", peerThreads()},
                        {"loadAverageAtStart", loadAtStart}};
  record["peers"] = {{"embree", embreeAvailable() ? Json(embreeVersion()) : Json(nullptr)},
                     {"osmesa", osmesaAvailable()},
                     {"tinygltf", true}};
  for (const auto& [peer, version] : peerVersions(bench.scratch)) {
    record["peers"][peer] = version ? Json(*version) : Json(nullptr);
  }
  bench.report.writeTo(record);
  return record;
}

void checkOptions(const Options& o) {
  if (o.scenes.empty()) throw UsageError(std::string("--scenes is missing\n") + kUsage);
  if (!std::filesystem::is_directory(o.scenes)) throw InputError(o.scenes.string(), "no such folder");
  checkRecordPlace(o.json);
}

std::string headOf(const gpu::Device* device, const std::string& load) {
  std::string head = fmt::format("cpu: {} ({} threads)\n", cpuName(), cpuCount());
  if (device) head += fmt::format("device: {} ({})\n", device->info().name, driverOf(device->info()));
  if (device && device->validationOn()) head += "validation is on: figures of rays and raster mean nothing\n";
  return head + "load average at start: " + load + "\n\n";
}

int runSuites(const Options& options, const std::filesystem::path& self, const std::vector<std::string>& words) {
  checkOptions(options);
  const ScratchFolder scratch;
  std::optional<gpu::Device> device;
  Bench bench;
  bench.rounds.rounds = options.rounds;
  bench.quick = options.quick;
  if (bench.quick) bench.rounds.shortestSeconds = 0;
  bench.large = options.large;
  bench.only = options.only;
  bench.program = options.program.empty() ? self.parent_path() / "crosslight" : options.program;
  bench.scenes = options.scenes;
  bench.pictures = options.pictures;
  bench.scratch = scratch.path();
  bench.device = [&]() -> const gpu::Device& {
    gpu::DeviceOptions wanted;
    wanted.selector = options.device;
    if (!device) device.emplace(gpu::Device::open(wanted));
    return *device;
  };
  const std::string load = loadAverage();
  bench.device();  // the record names the driver, whichever suites run
  Times timesMs;
  for (const Suite* suite : options.suites) {
    logInfo(fmt::format("bench: {}", suite->name));
    const Stopwatch watch;
    suite->run(bench);
    timesMs.emplace_back(suite->name, watch.elapsedMs());
  }
  const std::string text = headOf(&*device, load) + bench.report.table();
  if (options.json == "-") {
    std::fputs(text.c_str(), stderr);
  } else {
    printToStdout(text);
  }
  if (!options.json.empty()) writeRecord(options.json, recordOf(bench, words, &*device, timesMs, load));
  return static_cast<int>(bench.report.passed() ? ExitCode::ok : ExitCode::checkFailed);
}

int run(int argc, char** argv) {
  try {
    installInterruptHandler();
    const std::vector<std::string> words(argv + 1, argv + argc);
    const Options options = parse(words);
    if (options.help) {
      printToStdout(kUsage);
      return 0;
    }
    if (options.peers) {
      printToStdout(
          fmt::format("embree {}\nosmesa {}\n", embreeAvailable() ? "yes" : "no", osmesaAvailable() ? "yes" : "no"));
      return 0;
    }
    return runSuites(options, std::filesystem::read_symlink("/proc/self/exe"), words);
  } catch (const Error& error) {
    std::fprintf(stderr, "crosslight_bench: %s\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "crosslight_bench: %s\n", error.what());
    return static_cast<int>(ExitCode::internal);
  }
}

}  // namespace

unsigned peerThreads() {
  const char* text = std::getenv("LP_NUM_THREADS");
  const long threads = text ? std::strtol(text, nullptr, 10) : 0;
  return threads > 0 ? static_cast<unsigned>(threads) : text ? 1u : cpuCount();
}

}  // namespace crosslight::bench

int main(int argc, char** argv) { return crosslight::bench::run(argc, argv); }
