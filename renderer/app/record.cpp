#include "app/record.h"

#include <fstream>

#include "app/output.h"
#include "app/version.h"
#include "base/file.h"
#include "base/log.h"

namespace crosslight {

std::string driverOf(const gpu::DeviceInfo& device) { return device.driverName + ": " + device.driverInfo; }

std::string cpuName() {
  std::ifstream in("/proc/cpuinfo");
  std::string line;
  while (std::getline(in, line)) {
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos && line.starts_with("model name")) return line.substr(colon + 2);
  }
  return "unknown";
}

Json newRecord(const RecordHead& head) {
  Json record;
  record["schema"] = kRecordSchema;
  record["version"] = versionText();
  record["commit"] = commitText();
  record["device"] = head.device ? Json(head.device->name) : Json(nullptr);
  record["driver"] = head.device ? Json(driverOf(*head.device)) : Json(nullptr);
  record["softwareDriver"] = head.device ? Json(head.device->isSoftware) : Json(nullptr);
  record["cpu"] = cpuName();
  record["command"] = head.command;
  record["arguments"] = head.arguments;
  record["seed"] = head.seed ? Json(*head.seed) : Json(nullptr);
  Json& timings = record["timings"] = Json::object();
  for (const auto& [phase, wallMs] : head.timesMs) timings[phase + "Ms"] = wallMs;
  record["warnings"] = loggedWarnings();
  return record;
}

void writeRecord(const std::string& destination, const Json& record) {
  // Names come from files: bytes that are no UTF-8 are replaced, not refused.
  const std::string text = record.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  if (destination == "-") {
    printToStdout(text);
  } else {
    writeFileAtomically(destination, text);
  }
}

void checkRecordPlace(const std::string& destination) {
  if (!destination.empty() && destination != "-") checkOutputPlace(destination);
}

}  // namespace crosslight
