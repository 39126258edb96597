#include "app/frame_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "app/render_options.h"
#include "base/error.h"

namespace crosslight {
namespace {

struct Range {
  std::uint32_t first, last;
};

bool parsed(const std::string& text, std::uint32_t& value) {
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && stop == text.data() + text.size();
}

Range rangeOf(const std::string& text) {
  Range range{0, 0};
  const std::size_t dash = text.find('-');
  bool good = false;
  if (dash == std::string::npos) {
    good = parsed(text, range.last) && range.last >= 1;
    --range.last;
  } else {
    good = parsed(text.substr(0, dash), range.first) && parsed(text.substr(dash + 1), range.last) &&
           range.first <= range.last;
  }
  if (!good || range.last >= kMostFrames) {
    throw UsageError(fmt::format(
        "--frames: '{}' is neither a number of frames from 1 to {} nor a range A-B below it, e.g. 48 or 24-47", text,
        kMostFrames));
  }
  return range;
}

}  // namespace

bool framesAnimate(const RenderOptions& o) { return !o.frames.empty() || o.timeGiven || !o.animation.empty(); }

std::vector<Frame> framesOf(const RenderOptions& o) {
  if (o.frames.empty() && o.turntable == 0) return {};
  const Range range = o.frames.empty() ? Range{0, o.turntable - 1} : rangeOf(o.frames);
  std::vector<Frame> frames;
  for (std::uint32_t number = range.first; number <= range.last; ++number) {
    Frame frame{number, o.timeSeconds, o.turnDegrees};
    if (!o.frames.empty()) frame.timeSeconds += number / o.framesPerSecond;
    if (o.turntable > 0) frame.turnDegrees += 360.0 * (number % o.turntable) / o.turntable;
    frames.push_back(frame);
  }
  return frames;
}

bool isVideo(const std::filesystem::path& output) {
  static constexpr std::array kExtensions{".mp4", ".mkv", ".webm", ".gif"};
  const std::string extension = output.extension().string();
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

std::string frameName(const std::string& pattern, std::uint32_t number) {
  const std::filesystem::path path(pattern);
  const std::string name = path.filename().string();
  const std::size_t first = name.find('#');
  const std::size_t end = std::min(name.find_first_not_of('#', first), name.size());
  if (first == std::string::npos || name.find('#', end) != std::string::npos) {
    throw UsageError("\"" + pattern +
                     "\": frames need one run of '#' in the file's name for their number, as in frame_####.png, or a "
                     "video (.mp4, .mkv, .webm, .gif)");
  }
  const std::string digits = fmt::format("{:0{}}", number, end - first);
  return std::filesystem::path(path).replace_filename(name.substr(0, first) + digits + name.substr(end)).string();
}

}  // namespace crosslight
