// The device of a command, opened in a thread while the first scene is read. Its errors come when it is asked for, so
// that a broken scene is told before a missing device.
#pragma once

#include <exception>
#include <future>
#include <optional>

#include "app/device_choice.h"
#include "app/render_session.h"

namespace crosslight {

class LazyDevice {
 public:
  explicit LazyDevice(const DeviceChoice& choice);

  gpu::Device& get();  // waits the first time
  RenderSession& session();
  bool isOpen() const { return device_.has_value(); }
  // What opening took and what get() waited for it: once, for the record of the first picture.
  Times takeTimes();

 private:
  std::future<gpu::Device> opening_;
  std::optional<gpu::Device> device_;
  std::optional<RenderSession> session_;  // dies before the device
  std::exception_ptr refusal_;            // why there is none; thrown whenever it is asked for
  Times timesMs_;
};

}  // namespace crosslight
