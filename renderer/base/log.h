// Messages for people, on stderr. Stdout carries only what was asked for. A warning is said once per process.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crosslight {

enum class LogLevel { quiet, normal, verbose };

void setLogLevel(LogLevel level);
LogLevel logLevel();

void logInfo(std::string_view message);     // normal and verbose
void logVerbose(std::string_view message);  // verbose only
void logWarning(std::string_view message);  // all but quiet; the same text is printed once
void logError(std::string_view message);    // always

// Every warning so far, in order, each once (for JSON records).
std::vector<std::string> loggedWarnings();

}  // namespace crosslight
