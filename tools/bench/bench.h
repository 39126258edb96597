// What every suite gets: the options, a scratch folder, the device when it needs one, and the report.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "bench/report.h"
#include "bench/rounds.h"
#include "gpu/device.h"

namespace crosslight::bench {

struct Bench {
  RoundOptions rounds;
  bool quick = false;              // sizes for a smoke test: the figures mean nothing
  std::string only;                // effects: scenes whose names hold this text
  bool large = false;              // a million triangles too
  std::filesystem::path program;   // crosslight, for the suites that start it
  std::filesystem::path scenes;    // the repository's scenes/
  std::filesystem::path pictures;  // a folder that gets the pictures of `peers`; empty: nowhere
  std::filesystem::path scratch;   // a folder of this run's own, removed at the end
  std::function<const gpu::Device&()> device;
  Report report;
};

// Each adds to the report. Names of what they measure begin with the suite's own.
void benchLoad(Bench& bench);
void benchBvh(Bench& bench);
void benchRays(Bench& bench);
void benchRaster(Bench& bench);
void benchStart(Bench& bench);
void benchPeers(Bench& bench);
void benchGrowth(Bench& bench);
void benchEffects(Bench& bench);

inline constexpr const char* kNoEmbree =
    "this build has no Embree: install libembree-dev (ci/setup test) and configure anew";
inline constexpr const char* kNoOsmesa =
    "this build has no OSMesa: install libosmesa6-dev (ci/setup test) and configure anew";

inline constexpr std::uint32_t kRaySeed = 1;  // of the bounce rays

// Threads that a peer may use: as many as llvmpipe takes (LP_NUM_THREADS if set, else one per CPU).
unsigned peerThreads();

}  // namespace crosslight::bench
