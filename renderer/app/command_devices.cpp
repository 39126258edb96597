// `crosslight devices`: every Vulkan device, usable or why not.
#include <memory>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/device_choice.h"
#include "app/output.h"
#include "base/time.h"

namespace crosslight {
namespace {

struct Options {
  DeviceChoice device;
  std::string json;
};

void run(const Options& options, const CommonOptions& common) {
  checkRecordPlace(options.json);
  Stopwatch watch;
  const std::vector<gpu::DeviceReport> reports = gpu::listDevices();
  RecordHead head{"devices", common.arguments, {}, nullptr, {{"list", watch.elapsedMs()}}};
  if (options.json != "-") printToStdout(deviceTable(reports));
  if (!options.json.empty()) {
    Json record = newRecord(head);
    record["devices"] = Json::array();
    for (const gpu::DeviceReport& report : reports) record["devices"].push_back(deviceJson(report));
    writeRecord(options.json, record);
  }
  openIfAsked(options.device);
}

}  // namespace

void addDevicesCommand(CommandLine& line) {
  auto options = std::make_shared<Options>();
  CLI::App& command = line.add("devices", "List the Vulkan devices, usable or why not", "[option...]",
                               "Ends with 0 whatever is found, unless --device or --require-device asks for a device: "
                               "then it is opened, and exit code 4 says that it cannot be.");
  addDeviceOptions(line, command, options->device);
  line.text(command, "--json", options->json, "FILE|-", "Write a JSON record; '-' is standard output", ValueKind::file)
      ->group("Output");
  line.onRun(command, [&line, options] { run(*options, line.common()); });
}

}  // namespace crosslight
