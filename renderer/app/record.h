// JSON records: what was asked, on what it ran and what was measured. The part that all commands share.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gpu/device.h"

namespace crosslight {

using Json = nlohmann::ordered_json;

// Of every record; it grows when a field changes its meaning or goes away, not when one is added.
inline constexpr int kRecordSchema = 1;

// (phase, wall milliseconds), in the order in which they happened.
using Times = std::vector<std::pair<std::string, double>>;

struct RecordHead {
  std::string command;
  std::vector<std::string> arguments;
  std::optional<std::uint64_t> seed;
  const gpu::DeviceInfo* device = nullptr;  // null: the command used none
  Times timesMs;
};

// schema, version, commit, device, driver, cpu, command, arguments, seed, timings, warnings.
Json newRecord(const RecordHead& head);

std::string driverOf(const gpu::DeviceInfo& device);  // "llvmpipe: Mesa 22.3.6 (LLVM 15.0.6)"
std::string cpuName();                                // as /proc/cpuinfo has it, or "unknown"

// To stdout for "-", else to the file, whole or not at all.
void writeRecord(const std::string& destination, const Json& record);
// Of a destination that is not "-" or "": can it be written? InputError if not.
void checkRecordPlace(const std::string& destination);

}  // namespace crosslight
