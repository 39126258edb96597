// Runs another program and waits for it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace crosslight::bench {

// Wall milliseconds from its start to its end. InternalError, with what it printed, unless it exits with 0. `changes`
// to the environment: an empty value removes the variable. Its output goes to a file in `scratch`.
double runProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                  const std::map<std::string, std::string>& changes, const std::filesystem::path& scratch);

}  // namespace crosslight::bench
