#include "bench/peer_programs.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <regex>
#include <sstream>

#include "base/error.h"
#include "base/file.h"
#include "bench/bench.h"
#include "bench/child_process.h"

namespace crosslight::bench {
namespace {

std::optional<double> secondsAsMs(const std::string& printed, const char* pattern) {
  std::smatch found;
  if (!std::regex_search(printed, found, std::regex(pattern))) return std::nullopt;
  return std::stod(found[1]) * 1e3;
}

std::optional<double> povrayTraceMs(const std::string& printed) {
  return secondsAsMs(printed, R"(Trace Time:[^(\n]*\(([0-9.]+) seconds\))");
}

std::optional<double> tachyonTraceMs(const std::string& printed) {
  return secondsAsMs(printed, R"(Ray Tracing Time:\s*([0-9.]+) seconds)");
}

// Minutes and seconds of all after loading, its tree and the picture's file included; the latter is told apart.
std::optional<double> cyclesTraceMs(const std::string& printed) {
  std::smatch found;
  const std::regex line(R"(\n Time: ([0-9]+):([0-9.]+) \(Saving: ([0-9]+):([0-9.]+)\))");
  if (!std::regex_search(printed, found, line)) return std::nullopt;
  const double all = 60.0 * std::stod(found[1]) + std::stod(found[2]);
  const double saving = 60.0 * std::stod(found[3]) + std::stod(found[4]);
  return (all - saving) * 1e3;
}

std::string listed(const double (&v)[3]) { return fmt::format("{},{},{}", v[0], v[1], v[2]); }

double childrensUserMs() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) * 1e3 + static_cast<double>(usage.ru_utime.tv_usec) * 1e-3;
}

std::string printedIn(const std::filesystem::path& scratch) {
  const std::vector<std::byte> bytes = readFile(scratch / "output.txt");
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// What follows its name or the word; "unknown" of one that does not say.
std::optional<std::string> versionOf(const std::filesystem::path& program, const std::filesystem::path& scratch) {
  try {
    runProgram(program, {"--version"}, {}, scratch);
  } catch (const Error&) {
  }
  const std::string printed = printedIn(scratch);
  std::smatch found;
  if (std::regex_search(printed, found, std::regex(R"((?:POV-Ray|Blender|f3d|Version) ([0-9]+(?:\.[0-9]+)+))")))
    return found[1];
  return "unknown";
}

}  // namespace

PeerCommand povrayCommand(const std::filesystem::path& scene, std::uint32_t size, const std::filesystem::path& folder) {
  const std::filesystem::path picture = folder / "povray.png";
  return {"povray",
          "povray",
          {"+I" + scene.string(), "+O" + picture.string(), fmt::format("+W{}", size), fmt::format("+H{}", size),
           fmt::format("+WT{}", peerThreads()), "-D", "-A", "+FN8", "File_Gamma=sRGB"},
          picture,
          povrayTraceMs};
}

PeerCommand tachyonCommand(const std::filesystem::path& scene, const std::filesystem::path& folder) {
  const std::filesystem::path picture = folder / "tachyon.png";
  return {"tachyon",
          "tachyon",
          {scene.string(), "-o", picture.string(), "-format", "PNG", "-numthreads", std::to_string(peerThreads()),
           "-fullshade", "-shade_blinn"},
          picture,
          tachyonTraceMs};
}

PeerCommand cyclesCommand(const std::filesystem::path& mesh, std::uint32_t size, const std::filesystem::path& folder) {
  const std::filesystem::path picture = folder / "cycles.png";
  const std::string script = std::string(CROSSLIGHT_BENCH_DIR) + "/blender_mesh.py";
  return {"cycles",
          "blender",
          {"-b", "--factory-startup", "--python-exit-code", "1", "-P", script, "--", mesh.string(),
           std::to_string(size), std::to_string(peerThreads()), picture.string()},
          picture,
          cyclesTraceMs};
}

PeerCommand f3dCommand(const std::filesystem::path& gltf, std::uint32_t size, const Eye& eye,
                       const std::filesystem::path& folder) {
  const std::filesystem::path picture = folder / "f3d.png";
  return {"f3d",
          "f3d",
          {"--dry-run", "--quiet", "--output", picture.string(), "--resolution", fmt::format("{},{}", size, size),
           "--camera-position", listed(eye.position), "--camera-focal-point", listed(eye.target), "--camera-view-up",
           "0,1,0", "--camera-view-angle", fmt::format("{}", eye.yFovDegrees), gltf.string()},
          picture};
}

std::optional<std::filesystem::path> findProgram(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path file = std::filesystem::path(folder) / program;
    if (!folder.empty() && access(file.c_str(), X_OK) == 0) return file;
  }
  return std::nullopt;
}

std::map<std::string, std::optional<std::string>> peerVersions(const std::filesystem::path& scratch) {
  std::map<std::string, std::optional<std::string>> versions;
  for (const auto& [name, program] :
       {std::pair{"povray", "povray"}, {"tachyon", "tachyon"}, {"cycles", "blender"}, {"f3d", "f3d"}}) {
    const auto file = findProgram(program);
    versions[name] = file ? versionOf(*file, scratch) : std::nullopt;
  }
  return versions;
}

PeerRun runMeasured(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                    const std::map<std::string, std::string>& environment, const std::filesystem::path& scratch) {
  PeerRun run;
  const double before = childrensUserMs();
  run.wallMs = runProgram(program, arguments, environment, scratch);
  run.userMs = childrensUserMs() - before;
  run.printed = printedIn(scratch);
  return run;
}

}  // namespace crosslight::bench
