// Every test of this suite runs under validation; messages that come while a device closes fail the suite too.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "gpu/device.h"

namespace {

struct Validation : testing::Environment {
  void SetUp() override { setenv("CROSSLIGHT_VALIDATION", "1", 1); }
  void TearDown() override { EXPECT_EQ(crosslight::gpu::lateValidationMessages(), 0u); }
};

const testing::Environment* const kValidation = testing::AddGlobalTestEnvironment(new Validation);

}  // namespace
