// The three classes of trouble (see STYLE): programmer errors go through check.h; bad input, missing devices and
// interruption are the exceptions below, one per exit code; an expected absence is a std::optional.
#pragma once

#include <stdexcept>
#include <string>

namespace crosslight {

enum class ExitCode : int {
  ok = 0,
  checkFailed = 1,
  usage = 2,
  input = 3,
  device = 4,
  internal = 5,
  interrupted = 130,
};

// Base of everything that main() turns into an exit code. The message says what, where, and what to do.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

// The command line asks for something that does not exist.
struct UsageError : Error {
  explicit UsageError(const std::string& message) : Error(ExitCode::usage, message) {}
};

// A file cannot be read, is broken, or needs something unsupported. `where` is the file, then the place inside it
// (a JSON path for glTF), e.g. "scene.gltf: /meshes/0/primitives/1".
struct InputError : Error {
  InputError(const std::string& where, const std::string& what) : Error(ExitCode::input, where + ": " + what) {}
};

// No usable device, or the device lacks a feature; the message names both.
struct DeviceError : Error {
  explicit DeviceError(const std::string& message) : Error(ExitCode::device, message) {}
};

// Device lost, validation message, broken invariant: not the user's fault.
struct InternalError : Error {
  explicit InternalError(const std::string& message) : Error(ExitCode::internal, message) {}
};

// The user pressed Ctrl-C (or the process got SIGTERM).
struct Interrupted : Error {
  Interrupted() : Error(ExitCode::interrupted, "interrupted") {}
};

}  // namespace crosslight
