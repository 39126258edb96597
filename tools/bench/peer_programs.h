// Other renderers as whole processes: how each is started, and what it says of its own times.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace crosslight::bench {

// One picture by one program, PNG.
struct PeerCommand {
  std::string name;  // povray, tachyon, cycles, f3d
  std::string program;
  std::vector<std::string> arguments;
  std::filesystem::path picture;
  // Milliseconds of tracing alone, out of what it printed; null where it does not tell.
  std::optional<double> (*traceMs)(const std::string& printed) = nullptr;
};

PeerCommand povrayCommand(const std::filesystem::path& scene, std::uint32_t size, const std::filesystem::path& folder);
PeerCommand tachyonCommand(const std::filesystem::path& scene, const std::filesystem::path& folder);
PeerCommand cyclesCommand(const std::filesystem::path& mesh, std::uint32_t size, const std::filesystem::path& folder);

struct Eye {
  double position[3], target[3], yFovDegrees;
};
PeerCommand f3dCommand(const std::filesystem::path& gltf, std::uint32_t size, const Eye& eye,
                       const std::filesystem::path& folder);

// Of a program in PATH; nothing where there is none.
std::optional<std::filesystem::path> findProgram(const std::string& program);

// Of each peer that is there, what it calls its version; null for the others. `scratch` takes what they print.
std::map<std::string, std::optional<std::string>> peerVersions(const std::filesystem::path& scratch);

// Runs it and waits; what it printed. Wall and user CPU time, its own threads and children counted in.
struct PeerRun {
  double wallMs = 0, userMs = 0;
  std::string printed;
};
PeerRun runMeasured(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                    const std::map<std::string, std::string>& environment, const std::filesystem::path& scratch);

}  // namespace crosslight::bench
