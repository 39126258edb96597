#include "app/record.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "app/render_record.h"

namespace crosslight {
namespace {

TEST(Record, headHasWhatEveryRecordPromises) {
  gpu::DeviceInfo device;
  device.name = "some device";
  device.driverName = "driver";
  device.driverInfo = "1.2";
  const Json record = newRecord({"render", {"crosslight", "render"}, 7, &device, {{"load", 1.5}, {"total", 2.5}}});
  for (const char* key : {"schema", "version", "commit", "device", "driver", "cpu", "command", "seed", "timings"}) {
    EXPECT_TRUE(record.contains(key)) << key;
  }
  EXPECT_EQ(record["schema"], kRecordSchema);
  EXPECT_EQ(record["device"], "some device");
  EXPECT_EQ(record["driver"], "driver: 1.2");
  EXPECT_EQ(record["seed"], 7);
  EXPECT_EQ(record["timings"]["loadMs"], 1.5);
  EXPECT_EQ(record["timings"]["totalMs"], 2.5);
}

TEST(Record, aCommandWithoutDeviceOrSeedSaysNull) {
  const Json record = newRecord({"info", {}, {}, nullptr, {}});
  EXPECT_TRUE(record["device"].is_null());
  EXPECT_TRUE(record["seed"].is_null());
  EXPECT_TRUE(record["timings"].is_object());
}

TEST(Record, namesThatAreNoUtf8AreReplacedNotRefused) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "record_test.json";
  Json record = newRecord({"info", {}, {}, nullptr, {}});
  record["name"] = "broken \xff name";
  writeRecord(file.string(), record);
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(file);
  EXPECT_EQ(Json::parse(text)["name"], "broken \xef\xbf\xbd name");
}

TEST(Record, timesLineNamesEveryPhaseAndTheTotal) {
  EXPECT_EQ(timesText({{"load", 1.25}, {"render", 10.0}, {"total", 12.6}}), "13 ms (load 1.2, render 10.0)");
}

}  // namespace
}  // namespace crosslight
