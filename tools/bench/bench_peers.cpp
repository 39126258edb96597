// Whole processes side by side, from start to PNG: ours with full and with empty caches, and other renderers of the
// same content. Wall time, user CPU time, and the time of tracing alone where a program tells it.
#include <fmt/format.h>

#include <fstream>

#include "base/error.h"
#include "bench/bench.h"
#include "bench/knot_scene.h"
#include "bench/peer_programs.h"
#include "bench/peer_scenes.h"
#include "image/image_io.h"
#include "measure/metrics.h"
#include "scene/load.h"

namespace crosslight::bench {
namespace {

// Linear. POV-Ray's pictures and ours are of the same formulas, rounded to 8 bits by each: near white a step of the
// code is 2.4 / 255, its rounding 0.3 of that, twice: 4e-3. Silhouettes, under one pixel in ten, differ where they
// pass a pixel's center within rounding, 1e-3 of it: pixels that may differ by 1, one in 10^4: 1e-2. A mirrored or
// darker picture is off by 0.1 and more.
constexpr double kMostRmse = 1e-2;

// Pictures of one content, with everything that makes them.
class Contest {
 public:
  Contest(Bench& bench, const std::string& name)
      : bench_(bench), name_("peers." + name), folder_(bench.scratch / name_) {
    std::filesystem::create_directories(folder_);
  }
  const std::filesystem::path& folder() const { return folder_; }

  void setOurs(const std::filesystem::path& gltf, std::uint32_t size, std::vector<std::string> options) {
    ours_ = {"render",
             gltf.string(),
             "-o",
             (folder_ / "ours.png").string(),
             "--resolution",
             fmt::format("{}x{}", size, size),
             "--quiet",
             "--json",
             (folder_ / "ours.json").string()};
    ours_.insert(ours_.end(), options.begin(), options.end());
  }

  // Tries it once. `samePicture`: POV-Ray's must be ours.
  void addPeer(const PeerCommand& peer, bool samePicture) {
    const std::string full = name_ + "." + peer.name;
    const auto program = findProgram(peer.program);
    if (!program) return bench_.report.omit(full, "no " + peer.program + ": tools/bench/run peers --install");
    try {
      runPeer(peer, *program);
    } catch (const Error& error) {
      const std::string what = error.what();
      return bench_.report.omit(full, what.substr(0, what.find('\n')));
    }
    if (samePicture) checkPicture(full, peer);
    peers_.push_back(peer);
    contenders_.push_back([this, peer, program = *program] { return runPeer(peer, program); });
  }

  void run() {
    contenders_.insert(contenders_.begin(), {[this] { return runOurs("crosslight", folder_ / "warm"); },
                                             [this] {
                                               const auto empty = folder_ / fmt::format("cold{}", ++colds_);
                                               Measured measured = runOurs("crosslightCold", empty);
                                               std::filesystem::remove_all(empty);
                                               return measured;
                                             }});
    const Rounds rounds = interleave(contenders_, bench_.rounds);
    const std::string warm = name_ + ".crosslight", cold = warm + "Cold";
    bench_.report.compare(warm, cold, rounds, Quantity::time);
    for (const PeerCommand& peer : peers_) {
      const std::string theirs = name_ + "." + peer.name;
      bench_.report.compare(warm, theirs, rounds, Quantity::time);
      bench_.report.compare(cold, theirs, rounds, Quantity::time);
      bench_.report.compare(warm + ".user", theirs + ".user", rounds, Quantity::time);
      if (peer.traceMs) bench_.report.compare(warm + ".trace", theirs + ".trace", rounds, Quantity::time);
    }
    keepPictures();
  }

 private:
  static std::map<std::string, std::string> environment() {
    const std::string threads = std::to_string(peerThreads());
    return {{"LP_NUM_THREADS", threads}, {"OMP_NUM_THREADS", threads}};
  }

  Measured runOurs(const std::string& name, const std::filesystem::path& cache) {
    std::filesystem::create_directories(cache / "mesa");
    std::filesystem::remove(folder_ / "ours.png");
    auto changed = environment();
    changed["MESA_SHADER_CACHE_DIR"] = (cache / "mesa").string();
    changed["XDG_CACHE_HOME"] = cache.string();
    changed["MESA_SHADER_CACHE_DISABLE"] = changed["MESA_GLSL_CACHE_DISABLE"] = "";
    const PeerRun run = runMeasured(bench_.program, ours_, changed, folder_);
    if (!std::filesystem::exists(folder_ / "ours.png")) throw InternalError("crosslight has written no picture");
    std::ifstream in(folder_ / "ours.json");
    const double traceMs = Json::parse(in).at("timings").at("renderMs");
    const std::string full = name_ + "." + name;
    return {{full, run.wallMs}, {full + ".user", run.userMs}, {full + ".trace", traceMs}};
  }

  Measured runPeer(const PeerCommand& peer, const std::filesystem::path& program) {
    std::filesystem::remove(peer.picture);
    const PeerRun run = runMeasured(program, peer.arguments, environment(), folder_);
    if (!std::filesystem::exists(peer.picture)) throw InternalError(peer.program + " has written no picture");
    const std::string full = name_ + "." + peer.name;
    Measured measured{{full, run.wallMs}, {full + ".user", run.userMs}};
    if (peer.traceMs) {
      const std::optional<double> traceMs = peer.traceMs(run.printed);
      if (!traceMs) throw InternalError(peer.program + " does not say how long it has traced");
      measured.emplace_back(full + ".trace", *traceMs);
    }
    return measured;
  }

  void checkPicture(const std::string& full, const PeerCommand& peer) {
    runOurs("crosslight", folder_ / "warm");
    const Metrics metrics = measureImages(readImage(folder_ / "ours.png"), readImage(peer.picture));
    bench_.report.addCheck(full + ".picture", metrics.rmse <= kMostRmse,
                           {{"rmse", metrics.rmse}, {"pixels", metrics.values / 3}});
  }

  void keepPictures() {
    if (bench_.pictures.empty()) return;
    std::filesystem::create_directories(bench_.pictures);
    const auto keep = [&](const std::filesystem::path& from, const std::string& name) {
      std::filesystem::copy_file(from, bench_.pictures / (name_.substr(6) + "." + name + ".png"),
                                 std::filesystem::copy_options::overwrite_existing);
    };
    keep(folder_ / "ours.png", "crosslight");
    for (const PeerCommand& peer : peers_) keep(peer.picture, peer.name);
  }

  Bench& bench_;
  std::string name_;
  std::filesystem::path folder_;
  std::vector<std::string> ours_;
  std::vector<PeerCommand> peers_;
  std::vector<Contender> contenders_;
  unsigned colds_ = 0;
};

// F3D opens a window, even for a file.
void addF3d(Bench& bench, Contest& contest, const std::filesystem::path& gltf, std::uint32_t size, const Eye& eye) {
  if (findProgram("f3d") && !std::getenv("DISPLAY")) {
    return bench.report.omit(contest.folder().filename().string() + ".f3d",
                             "it needs a display; tools/bench/run starts Xvfb where that is installed");
  }
  contest.addPeer(f3dCommand(writeWithoutLights(gltf, contest.folder() / "f3d"), size, eye, contest.folder()), false);
}

void knotByRays(Bench& bench, std::uint32_t triangles, std::uint32_t size) {
  Contest contest(bench, "knot");
  const std::filesystem::path& folder = contest.folder();
  const std::filesystem::path gltf = writeKnotScene(folder, triangles);
  const Scene scene = loadScene(gltf);
  contest.setOurs(gltf, size, {"--method", "whitted", "--max-depth", "0", "--set", "two-sided=always"});
  contest.addPeer(povrayCommand(writePovMesh(scene, folder), size, folder), true);
  contest.addPeer(tachyonCommand(writeTachyonMesh(scene, size, folder), folder), false);
  contest.addPeer(cyclesCommand(writeBlenderMesh(scene, folder), size, folder), false);
  contest.run();
}

void knotByRaster(Bench& bench, std::uint32_t triangles, std::uint32_t size) {
  Contest contest(bench, "knotRaster");
  const std::filesystem::path gltf = writeKnotScene(contest.folder(), triangles);
  contest.setOurs(gltf, size, {"--method", "phong"});
  addF3d(bench, contest, gltf, size, {{0.0, 5.0, 7.5}, {0.0, -0.3, 0.4}, 44.0});  // as knot_scene.cpp has it
  contest.run();
}

void spheres(Bench& bench, std::uint32_t size) {
  Contest contest(bench, "spheres");
  const std::filesystem::path gltf = writeSpheresScene(contest.folder());
  contest.setOurs(gltf, size, {"--method", "whitted", "--max-depth", "5"});
  contest.addPeer(povrayCommand(writePovSpheres(loadScene(gltf), contest.folder()), size, contest.folder()), true);
  contest.run();
}

void teapot(Bench& bench, std::uint32_t size) {
  Contest contest(bench, "teapot");
  const std::filesystem::path gltf = bench.scenes / "showcase/teapot.gltf";
  contest.setOurs(gltf, size, {"--method", "phong"});
  addF3d(bench, contest, gltf, size, {{0.5, 5.0, 11.0}, {0.1, 1.35, 0.0}, 40.0});  // as the file's camera
  contest.run();
}

}  // namespace

void benchPeers(Bench& bench) {
  if (!std::filesystem::exists(bench.program)) {
    throw InputError(bench.program.string(), "there is no such program; build crosslight_program or give --program");
  }
  const std::uint32_t triangles = bench.quick ? 2'000 : 100'000, size = bench.quick ? 64 : 1024;
  knotByRays(bench, triangles, size);
  spheres(bench, size);
  knotByRaster(bench, triangles, size);
  teapot(bench, bench.quick ? 64 : 512);
}

}  // namespace crosslight::bench
