// Stdout and places for output: found out to be unusable before any work is done, not after it.
#pragma once

#include <filesystem>
#include <string>

namespace crosslight {

// InputError when stdout cannot take it (a full disk, a closed pipe).
void printToStdout(const std::string& text);

// InputError when `file` cannot become a file: its folder is missing or not writable, or it is a folder itself.
// Creates nothing.
void checkOutputPlace(const std::filesystem::path& file);

}  // namespace crosslight
