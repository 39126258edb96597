#include <numeric>

#include "gpu_fixture.h"

namespace crosslight::gpu {
namespace {

using testing::HasSubstr;

std::vector<std::uint32_t> countingFrom(std::uint32_t first, std::size_t count) {
  std::vector<std::uint32_t> values(count);
  std::iota(values.begin(), values.end(), first);
  return values;
}

TEST_F(GpuTest, BuffersOfEveryUseKeepWhatIsWritten) {
  for (const std::uint32_t use : {std::uint32_t{useStorage}, std::uint32_t{useHostWrite}, std::uint32_t{useReadback},
                                  useVertex | useIndex | useStorage, std::uint32_t{useUniformTexel}}) {
    const auto values = countingFrom(7, 1001);
    Buffer buffer = Buffer::of(device(), "counting", values, use);
    EXPECT_EQ(buffer.sizeBytes(), 4004u);
    EXPECT_EQ(buffer.readAll<std::uint32_t>(), values) << "use " << use;
  }
}

TEST_F(GpuTest, StagedCopiesAcrossPiecesKeepEveryByte) {
  DeviceOptions options;
  options.neverMap = true;
  const Device unmapped = Device::open(options);
  // More than one staging piece of 64 MiB, and not a multiple of it.
  const auto values = countingFrom(1, (std::size_t{65} << 20) / 4 + 3);
  Buffer buffer = Buffer::of(unmapped, "large", values, useStorage);
  EXPECT_EQ(buffer.readAll<std::uint32_t>(), values);
  const std::array<std::uint32_t, 2> patch{111, 222};
  buffer.write(40, std::as_bytes(std::span(patch)));
  std::array<std::uint32_t, 4> around{};
  buffer.read(36, std::as_writable_bytes(std::span(around)));
  EXPECT_THAT(around, testing::ElementsAre(10u, 111u, 222u, 13u));
}

TEST_F(GpuTest, AnEmptyBufferExistsAndHoldsNothing) {
  for (const std::uint32_t use : {std::uint32_t{useStorage}, std::uint32_t{useUniformTexel}}) {
    Buffer buffer(device(), "empty", 0, use);
    EXPECT_TRUE(bool(buffer));
    EXPECT_EQ(buffer.sizeBytes(), 0u);
    EXPECT_TRUE(buffer.readAll<float>().empty());
    buffer.write(0, {});
  }
  EXPECT_FALSE(bool(Buffer()));
}

TEST_F(GpuTest, AccessBeyondTheEndIsABrokenInvariant) {
  Buffer buffer(device(), "small", 64, useStorage);
  std::array<std::byte, 8> bytes{};
  EXPECT_THROW(buffer.read(60, bytes), InternalError);
  EXPECT_THROW(buffer.write(65, {}), InternalError);
  EXPECT_THROW(buffer.write(~std::uint64_t{0}, bytes), InternalError);
}

TEST_F(GpuTest, MemoryIsCountedAndGivenBack) {
  const std::uint64_t before = device().allocatedBytes();
  {
    Buffer buffer(device(), "counted", 1 << 20, useStorage);
    EXPECT_GE(device().allocatedBytes(), before + (1 << 20));
    Buffer moved = std::move(buffer);
    EXPECT_FALSE(bool(buffer));  // NOLINT: what a move leaves behind is part of the contract
    EXPECT_TRUE(bool(moved));
  }
  EXPECT_EQ(device().allocatedBytes(), before);
  EXPECT_GE(device().peakAllocatedBytes(), before + (1 << 20));
}

TEST_F(GpuTest, TooLargeBuffersAreRefusedWithBothFigures) {
  const DeviceInfo& info = device().info();
  const auto refusal = [&](std::uint64_t bytes, std::uint32_t use) {
    return messageOf<DeviceError>([&] { Buffer(device(), "huge", bytes, use); });
  };
  const std::uint64_t storageBytes = info.maxStorageBufferBytes + 1;
  EXPECT_THAT(refusal(storageBytes, useStorage),
              testing::AllOf(HasSubstr("huge"), HasSubstr(std::to_string(storageBytes)),
                             HasSubstr(std::to_string(info.maxStorageBufferBytes))));
  const std::uint64_t texelBytes = info.maxTexelBufferElements * 16 + 1;
  EXPECT_THAT(refusal(texelBytes, useUniformTexel),
              testing::AllOf(HasSubstr(std::to_string(texelBytes)), HasSubstr(std::to_string(texelBytes - 1))));
  EXPECT_THAT(refusal(std::uint64_t{1} << 60, useVertex), HasSubstr(std::to_string(std::uint64_t{1} << 60)));
  EXPECT_THAT(refusal(~std::uint64_t{0}, useVertex), HasSubstr("18446744073709551615"));
}

TEST_F(GpuTest, ImagesBeyondTheLimitsAreRefusedWithTheFigures) {
  const DeviceInfo& info = device().info();
  const auto refusal = [&](std::uint32_t width, std::uint32_t samples) {
    return messageOf<DeviceError>([&] { Image(device(), "target", ImageFormat::rgba32f, width, 4, samples); });
  };
  EXPECT_THAT(refusal(info.maxImageSize + 1, 1), testing::AllOf(HasSubstr(std::to_string(info.maxImageSize + 1)),
                                                                HasSubstr(std::to_string(info.maxImageSize))));
  const std::string message = refusal(4, 3);
  EXPECT_THAT(message, HasSubstr("3 samples"));
  for (const std::uint32_t samples : info.msaaCounts) EXPECT_THAT(message, HasSubstr(std::to_string(samples)));
  EXPECT_THROW(Image(device(), "flat", ImageFormat::rgba32f, 0, 4), InternalError);
}

TEST_F(GpuTest, BoxesAreSearchedWhereTheDeviceCan) {
  const std::vector<SearchBox> boxes{{{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {3, 1, 1}}};
  const auto make = [&](std::uint32_t count) {
    const bool can = device().info().rayQueryLacks.empty();
    const Buffer buffer = Buffer::of(device(), "boxes", boxes, can ? useBoxes : useStorage);
    return BoxSearch(device(), "two boxes", buffer, count);
  };
  if (!device().info().rayQueryLacks.empty()) {
    EXPECT_THROW(make(2), DeviceError);
    GTEST_SKIP() << "the device lacks " << device().info().rayQueryLacks;
  }
  EXPECT_GE(make(2).sizeBytes(), 2 * sizeof(SearchBox));
  EXPECT_TRUE(make(0)) << "a search of nothing can be bound";
}

}  // namespace
}  // namespace crosslight::gpu
