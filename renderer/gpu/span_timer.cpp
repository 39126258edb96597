#include "gpu/span_timer.h"

#include <algorithm>

#include "base/check.h"

namespace crosslight::gpu {

void SpanTimer::restart() {
  for (vk::raii::QueryPool& pool : pools_) pool.reset(0, 2 * kSpansPerPool);
  recorded_.clear();
  spans_.clear();
  open_ = false;
}

// Both ends wait for all work before them, so that a span does not count the tail of the one before.
void SpanTimer::write(const DeviceImpl& device, const vk::raii::CommandBuffer& commands, std::uint32_t query,
                      bool drawing) const {
  const std::size_t span = recorded_.size() - 1;
  const auto first = static_cast<std::uint32_t>(2 * (span % kSpansPerPool));
  // llvmpipe runs a dispatch at once but takes timestamps with the next flush of its rasterizer, so both ends of a span
  // would get the same time (seen with Mesa 22.3.6). A barrier flushes; inside a rendering pass there can be none.
  const bool flush = device.info.isSoftware && !drawing;
  if (flush) fullBarrier(commands);
  commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *pools_[span / kSpansPerPool], first + query);
  if (flush) fullBarrier(commands);
}

void SpanTimer::begin(DeviceImpl& device, const vk::raii::CommandBuffer& commands, std::string_view name,
                      bool drawing) {
  CL_CHECK(!open_);
  open_ = true;
  recorded_.push_back({std::string(name), device.info.timestampPeriodNs > 0});
  if (!timed()) return;
  if (recorded_.size() > pools_.size() * kSpansPerPool) {
    // Reset by the host: a command buffer cannot reset queries in the middle of a rendering pass.
    const vk::QueryPoolCreateInfo info({}, vk::QueryType::eTimestamp, 2 * kSpansPerPool);
    pools_.emplace_back(device.device, info).reset(0, 2 * kSpansPerPool);
  }
  write(device, commands, 0, drawing);
}

void SpanTimer::end(const DeviceImpl& device, const vk::raii::CommandBuffer& commands, bool drawing) {
  CL_CHECK(open_);
  open_ = false;
  if (timed()) write(device, commands, 1, drawing);
}

void SpanTimer::collect(const DeviceImpl& device) {
  CL_CHECK(!open_);
  std::vector<std::uint64_t> ticks;
  for (std::size_t first = 0; first < recorded_.size(); first += kSpansPerPool) {
    if (device.info.timestampPeriodNs <= 0) break;
    const std::size_t queries = 2 * std::min<std::size_t>(kSpansPerPool, recorded_.size() - first);
    const auto [result, values] = pools_[first / kSpansPerPool].getResults<std::uint64_t>(
        0, static_cast<std::uint32_t>(queries), queries * sizeof(std::uint64_t), sizeof(std::uint64_t),
        vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    CL_CHECK(result == vk::Result::eSuccess);
    ticks.insert(ticks.end(), values.begin(), values.end());
  }
  for (std::size_t i = 0; i < recorded_.size(); ++i) {
    // Masked, because a counter of fewer than 64 bits wraps around.
    const std::uint64_t passed = ticks.empty() ? 0 : (ticks[2 * i + 1] - ticks[2 * i]) & device.timestampMask;
    const double ms = static_cast<double>(passed) * static_cast<double>(device.info.timestampPeriodNs) * 1e-6;
    const auto known = std::find_if(spans_.begin(), spans_.end(),
                                    [&](const TimedSpan& span) { return span.name == recorded_[i].name; });
    if (known == spans_.end()) {
      spans_.push_back({recorded_[i].name, ms});
    } else {
      known->gpuMs += ms;
    }
  }
}

}  // namespace crosslight::gpu
