// JSON as text that people can read and diff: arrays of numbers on one line, one member of an object per line.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace crosslight::scenegen {

using Json = nlohmann::ordered_json;

// Deterministic, ends with a newline; numbers are the shortest text that reads back to the same value.
std::string toText(const Json& json);

}  // namespace crosslight::scenegen
