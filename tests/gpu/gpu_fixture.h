// A device for tests of the gpu room; without any device the tests are skipped, visibly.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <string>

#include "base/error.h"
#include "gpu/commands.h"

namespace crosslight::gpu {

inline bool anyUsableDevice() {
  for (const DeviceReport& report : listDevices()) {
    if (report.usable()) return true;
  }
  return false;
}

class GpuTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!anyUsableDevice()) GTEST_SKIP() << "no usable Vulkan device on this machine";
    DeviceOptions options;
    options.usePipelineCache = false;
    device_.emplace(Device::open(options));
  }
  const Device& device() const { return *device_; }

 private:
  std::optional<Device> device_;
};

// The message of the exception of type E that `work` throws; a failure when it throws none.
template <class E>
std::string messageOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const E& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

}  // namespace crosslight::gpu
