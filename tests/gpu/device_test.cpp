#include <cstdlib>
#include <filesystem>

#include "base/file.h"
#include "gpu/cache_file.h"
#include "gpu/impl.h"
#include "gpu/selection.h"
#include "gpu_fixture.h"

namespace crosslight::gpu {
namespace {

using testing::HasSubstr;
using testing::Not;

// Sets an environment variable for one test.
class ScopedVariable {
 public:
  ScopedVariable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value, 1);
  }
  ~ScopedVariable() { old_ ? setenv(name_, old_->c_str(), 1) : unsetenv(name_); }
  ScopedVariable(const ScopedVariable&) = delete;
  ScopedVariable& operator=(const ScopedVariable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

DeviceReport report(std::uint32_t index, const char* name, const char* type, std::vector<std::string> refusals = {}) {
  DeviceReport made;
  made.info.index = index;
  made.info.name = name;
  made.info.type = type;
  made.info.isSoftware = made.info.type == "cpu";
  if (made.info.isSoftware) made.info.driverName = "llvmpipe";
  made.refusals = std::move(refusals);
  return made;
}

const std::vector<DeviceReport> kMachine{report(0, "llvmpipe (LLVM 15.0.6, 256 bits)", "cpu"),
                                         report(1, "Radeon Graphics", "integrated"),
                                         report(2, "GeForce RTX 4090", "discrete"),
                                         report(3, "GeForce GT 210", "discrete", {"needs Vulkan 1.3, it has 1.0.5"})};

TEST(DeviceSelector, EmptyTakesTheFastestKindThatCanBeUsed) {
  EXPECT_EQ(chooseDevice(kMachine, ""), 2u);
  EXPECT_EQ(chooseDevice(std::span(kMachine).first(2), ""), 1u);
  EXPECT_EQ(chooseDevice(std::span(kMachine).first(1), ""), 0u);
}

TEST(DeviceSelector, TakesAnIndexOrPartOfANameInAnyCase) {
  EXPECT_EQ(chooseDevice(kMachine, "1"), 1u);
  EXPECT_EQ(chooseDevice(kMachine, "radeon"), 1u);
  EXPECT_EQ(chooseDevice(kMachine, "gEFORCE"), 2u);
  EXPECT_EQ(chooseDevice(kMachine, "lavapipe"), 0u);
}

TEST(DeviceSelector, SaysWhatThereIsWhenNothingMatches) {
  for (const char* selector : {"voodoo", "4", "99999999999999999999"}) {
    const std::string message = messageOf<DeviceError>([&] { chooseDevice(kMachine, selector); });
    EXPECT_THAT(message, HasSubstr(selector));
    for (const DeviceReport& each : kMachine) EXPECT_THAT(message, HasSubstr(each.info.name));
  }
}

TEST(DeviceSelector, SaysWhyTheOnlyMatchIsRefused) {
  const std::string message = messageOf<DeviceError>([] { chooseDevice(kMachine, "gt 210"); });
  EXPECT_THAT(message, HasSubstr("needs Vulkan 1.3, it has 1.0.5"));
}

TEST(DeviceSelector, NamesTheDriverPackageWhenThereIsNoDevice) {
  EXPECT_THAT(messageOf<DeviceError>([] { chooseDevice({}, ""); }), HasSubstr("mesa-vulkan-drivers"));
}

TEST(DeviceList, IsEmptyWithoutDriversAndOpenSaysWhatToInstall) {
  const ScopedVariable drivers("VK_DRIVER_FILES", "/nonexistent/driver.json");
  const ScopedVariable oldName("VK_ICD_FILENAMES", "/nonexistent/driver.json");
  EXPECT_TRUE(listDevices().empty());
  EXPECT_THAT(messageOf<DeviceError>([] { Device::open(); }), HasSubstr("mesa-vulkan-drivers"));
}

TEST(DeviceList, SaysWhichPackageHoldsAMissingValidationLayer) {
  const ScopedVariable layers("VK_LAYER_PATH", "/nonexistent");
  EXPECT_THAT(messageOf<DeviceError>([] { Device::open(); }), HasSubstr("vulkan-validationlayers"));
}

TEST(DeviceList, NumbersTheDevicesInOrder) {
  const auto reports = listDevices();
  for (std::size_t i = 0; i < reports.size(); ++i) {
    EXPECT_EQ(reports[i].info.index, i);
    EXPECT_FALSE(reports[i].info.name.empty());
    for (const std::string& refusal : reports[i].refusals) EXPECT_THAT(refusal, HasSubstr("needs"));
  }
}

TEST_F(GpuTest, OpenDeviceKnowsItsLimits) {
  const DeviceInfo& info = device().info();
  EXPECT_TRUE(device().validationOn());
  // The least that Vulkan 1.3 allows a device to have (its specification, "Required Limits").
  EXPECT_GE(info.maxStorageBufferBytes, std::uint64_t{1} << 27);
  EXPECT_GE(info.maxTexelBufferElements, 65536u);
  EXPECT_GE(info.maxImageSize, 4096u);
  EXPECT_GE(info.maxWorkGroupCountX, 65535u);
  EXPECT_GE(info.subgroupSize, 1u);
  EXPECT_GT(info.deviceLocalBytes, 0u);
  EXPECT_THAT(info.msaaCounts, testing::Contains(1u));
  EXPECT_THAT(info.msaaCounts, testing::Contains(4u));
  EXPECT_TRUE(std::is_sorted(info.msaaCounts.begin(), info.msaaCounts.end()));
  EXPECT_GT(device().openTimes().instanceMs, 0.0);
  EXPECT_GT(device().openTimes().deviceMs, 0.0);
}

TEST_F(GpuTest, AnUnknownSelectorListsTheDevices) {
  DeviceOptions options;
  options.selector = "no such device";
  EXPECT_THAT(messageOf<DeviceError>([&] { Device::open(options); }), HasSubstr(device().info().name));
}

std::filesystem::path freshFolder(const char* name) {
  const auto folder = std::filesystem::path(testing::TempDir()) / name;
  std::filesystem::remove_all(folder);
  return folder;
}

TEST_F(GpuTest, SoftwareDevicesLeaveNoPipelineCacheBehind) {
  if (!device().info().isSoftware) GTEST_SKIP() << "this device is hardware";
  const auto folder = freshFolder("crosslight_gpu_no_cache");
  const ScopedVariable cache("XDG_CACHE_HOME", folder.c_str());
  Device::open().savePipelineCache();
  EXPECT_FALSE(std::filesystem::exists(folder / "crosslight"));
}

// What hardware drivers get, forced upon whatever device there is.
TEST_F(GpuTest, APipelineCacheIsWrittenReadAndReplacedWhenDamaged) {
  const auto file = freshFolder("crosslight_gpu_cache") / "cache.bin";
  const auto usePipelines = [&] {
    Device own = Device::open();
    attachPipelineCache(own.impl(), file);
    const BindingLayout layout(own, {{0, BindingType::storageBuffer}}, 8);
    const ComputePipeline pipeline(own, layout, embeddedShader("spin.comp"), {});
  };
  usePipelines();
  const auto first = loadCache(file);
  ASSERT_TRUE(first.has_value()) << "the closing device writes it";
  EXPECT_GE(first->size(), 32u) << "VkPipelineCacheHeaderVersionOne at least";
  usePipelines();
  EXPECT_TRUE(loadCache(file).has_value());
  std::filesystem::resize_file(file, 40);
  usePipelines();
  EXPECT_TRUE(loadCache(file).has_value()) << "the damaged file is replaced";
  // Whole by our header, but no driver's blob: the driver has to ignore it.
  const std::vector<std::byte> foreign(1000, std::byte{0x5a});
  ASSERT_TRUE(saveCache(file, foreign));
  usePipelines();
  const auto last = loadCache(file);
  ASSERT_TRUE(last.has_value());
  EXPECT_NE(*last, foreign);
}

}  // namespace
}  // namespace crosslight::gpu
