// Which frames an animation or a turntable has, and into which files they go.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace crosslight {

struct RenderOptions;

inline constexpr std::uint32_t kMostFrames = 1'000'000;     // eleven hours at 24 per second
inline constexpr double kSlowest = 0.001, kFastest = 1000;  // frames per second

// One frame: the single picture with these --time and --turn has the same bits.
struct Frame {
  std::uint32_t number = 0;
  double timeSeconds = 0;
  double turnDegrees = 0;
};

// Empty when neither --frames nor --turntable is given. UsageError on what cannot be meant.
std::vector<Frame> framesOf(const RenderOptions& options);
// Whether the frames' time moves: a turntable alone stands still.
bool framesAnimate(const RenderOptions& options);

bool isVideo(const std::filesystem::path& output);

// The pattern with its one run of '#' replaced by the number, with at least as many digits. UsageError when the file
// name has no such run or several.
std::string frameName(const std::string& pattern, std::uint32_t number);

}  // namespace crosslight
