// Runs build/crosslight as a user does: arguments in, exit code, stdout and stderr out, in a folder of its own.
#pragma once

#include <gmock/gmock.h>
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace crosslight::test {

struct Outcome {
  int exitCode = -1;  // 128 + signal when a signal ended it
  std::string out;
  std::string err;
  std::uint64_t peakBytes = 0;  // of memory at once
};

using Environment = std::map<std::string, std::string>;

// A running program.
class Running {
 public:
  Running(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
          const Environment& extra = {});
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running();

  // True once stderr contains `text`; false when the program ends, or a minute passes, without it.
  bool waitForStderr(const std::string& text);
  void signal(int number);
  Outcome wait();  // kills it after `kLongestSeconds`

 private:
  bool ended();

  pid_t process_ = -1;
  int status_ = 0;
  std::uint64_t peakBytes_ = 0;
  bool reaped_ = false;
  std::filesystem::path out_, err_;
};

class CliTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  Outcome run(const std::vector<std::string>& arguments, const Environment& extra = {}) const;
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  // Names in the test's folder, hidden ones too, in order.
  std::vector<std::string> files() const;

  std::filesystem::path folder_;  // empty at the start of each test; the program's working folder
};

// A scene of the repository, small and with everything the tests need.
std::string scene();

}  // namespace crosslight::test
