// Every test of this suite runs under validation; messages that come while a device closes fail the suite too.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "gpu/device.h"

// The layer (1.3.239) leaks a little with every instance. The leak sanitizer is told so by the library's name, which it
// only knows while the library stays loaded. Mesa's drivers only seem to leak when they are unloaded.
extern "C" const char* __lsan_default_suppressions() { return "leak:libVkLayer_khronos_validation"; }

namespace {

struct Validation : testing::Environment {
  void SetUp() override {
    setenv("CROSSLIGHT_VALIDATION", "1", 1);
    for (const char* library : {"libVkLayer_khronos_validation.so", "libvulkan_radeon.so", "libvulkan_intel.so",
                                "libvulkan_intel_hasvk.so", "libvulkan_lvp.so"}) {
      dlopen(library, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
    }
  }
  void TearDown() override { EXPECT_EQ(crosslight::gpu::lateValidationMessages(), 0u); }
};

const testing::Environment* const kValidation = testing::AddGlobalTestEnvironment(new Validation);

}  // namespace
