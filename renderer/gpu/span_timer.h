// Timestamps around named stretches of a command buffer. Private to this room.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gpu/impl.h"

namespace crosslight::gpu {

class SpanTimer {
 public:
  void restart();  // forgets all spans of the last recording; its queries must not be in use
  void begin(DeviceImpl& device, const vk::raii::CommandBuffer& commands, std::string_view name, bool drawing);
  void end(const DeviceImpl& device, const vk::raii::CommandBuffer& commands, bool drawing);
  void collect(const DeviceImpl& device);  // after the commands have run
  const std::vector<TimedSpan>& spans() const { return spans_; }

 private:
  static constexpr std::uint32_t kSpansPerPool = 256;  // two queries each
  struct Recorded {
    std::string name;
    bool timed;
  };
  bool timed() const { return !recorded_.empty() && recorded_.back().timed; }
  void write(const DeviceImpl& device, const vk::raii::CommandBuffer& commands, std::uint32_t query,
             bool drawing) const;

  std::vector<vk::raii::QueryPool> pools_;  // as many as the longest recording so far needed
  std::vector<Recorded> recorded_;
  bool open_ = false;
  std::vector<TimedSpan> spans_;
};

}  // namespace crosslight::gpu
