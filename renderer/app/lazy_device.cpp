#include "app/lazy_device.h"

#include <utility>

#include "base/log.h"
#include "base/time.h"

namespace crosslight {

LazyDevice::LazyDevice(const DeviceChoice& choice) : opening_(std::async(std::launch::async, openDevice, choice)) {}

gpu::Device& LazyDevice::get() {
  if (device_) return *device_;
  if (refusal_) std::rethrow_exception(refusal_);
  const Stopwatch watch;
  try {
    device_.emplace(opening_.get());
  } catch (...) {
    refusal_ = std::current_exception();
    throw;
  }
  timesMs_ = {{"instance", device_->openTimes().instanceMs},
              {"device", device_->openTimes().deviceMs},
              {"deviceWait", watch.elapsedMs()}};
  sayIfSoftware(device_->info());
  logVerbose("drawing on " + device_->info().name);
  return *device_;
}

Times LazyDevice::takeTimes() { return std::exchange(timesMs_, {}); }

RenderSession& LazyDevice::session() {
  if (!session_) session_.emplace(get());
  return *session_;
}

}  // namespace crosslight
