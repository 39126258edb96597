#include "cli/program.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

namespace crosslight::test {
namespace fs = std::filesystem;
namespace {

constexpr int kLongestSeconds = 120;  // far beyond any of these runs on a loaded machine
constexpr auto kPoll = std::chrono::milliseconds(10);

std::string readText(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

fs::path captureFile(const std::string& name) {
  static int counter = 0;
  return fs::path(testing::TempDir()) /
         ("crosslight_cli_" + std::to_string(::getpid()) + "_" + std::to_string(counter++) + name);
}

}  // namespace

Running::Running(const std::vector<std::string>& arguments, const fs::path& folder, const Environment& extra)
    : out_(captureFile(".out")), err_(captureFile(".err")) {
  const std::string program = CROSSLIGHT_BINARY_DIR "/crosslight";
  std::vector<char*> words = {const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  process_ = ::fork();
  if (process_ != 0) return;
  const int out = ::open(out_.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  const int err = ::open(err_.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  if (out < 0 || err < 0 || ::chdir(folder.c_str()) != 0) ::_exit(126);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  for (const auto& [name, value] : extra) ::setenv(name.c_str(), value.c_str(), 1);
  ::execv(words[0], words.data());
  ::_exit(127);
}

Running::~Running() {
  if (!reaped_) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, &status_, 0);
  }
  std::error_code ignored;
  fs::remove(out_, ignored);
  fs::remove(err_, ignored);
}

bool Running::ended() {
  rusage usage{};
  if (reaped_ || ::wait4(process_, &status_, WNOHANG, &usage) != process_) return reaped_;
  peakBytes_ = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  return reaped_ = true;
}

bool Running::waitForStderr(const std::string& text) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (std::chrono::steady_clock::now() < deadline) {
    if (readText(err_).find(text) != std::string::npos) return true;
    if (ended()) return readText(err_).find(text) != std::string::npos;
    std::this_thread::sleep_for(kPoll);
  }
  return false;
}

void Running::signal(int number) { ::kill(process_, number); }

Outcome Running::wait() {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(kLongestSeconds);
  while (!ended()) {
    if (std::chrono::steady_clock::now() > deadline) {
      ADD_FAILURE() << "still running after " << kLongestSeconds << " s: killed";
      ::kill(process_, SIGKILL);
    }
    std::this_thread::sleep_for(kPoll);
  }
  const int code = WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
  return {code, readText(out_), readText(err_), peakBytes_};
}

void CliTest::SetUp() {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  folder_ = fs::path(testing::TempDir()) / ("crosslight_" + std::string(info->test_suite_name()) + "_" + info->name() +
                                            "_" + std::to_string(::getpid()));
  fs::remove_all(folder_);
  fs::create_directories(folder_);
}

void CliTest::TearDown() {
  std::error_code ignored;
  fs::permissions(folder_, fs::perms::owner_all, ignored);
  fs::remove_all(folder_, ignored);
}

Outcome CliTest::run(const std::vector<std::string>& arguments, const Environment& extra) const {
  return Running(arguments, folder_, extra).wait();
}

void CliTest::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
}

std::string CliTest::read(const std::string& name) const { return readText(path(name)); }

std::vector<std::string> CliTest::files() const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string scene() { return CROSSLIGHT_SOURCE_DIR "/scenes/feature/phong.gltf"; }

}  // namespace crosslight::test
