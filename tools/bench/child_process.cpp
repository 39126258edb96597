#include "bench/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "base/file.h"
#include "base/time.h"

namespace crosslight::bench {
namespace {

std::vector<std::string> changedEnvironment(const std::map<std::string, std::string>& changes) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (!changes.contains(text.substr(0, text.find('=')))) result.push_back(text);
  }
  for (const auto& [name, value] : changes) {
    if (!value.empty()) result.push_back(name + "=" + value);
  }
  return result;
}

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

int waitFor(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) throw InternalError(std::string("waitpid: ") + std::strerror(errno));
  }
  return status;
}

}  // namespace

double runProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                  const std::map<std::string, std::string>& changes, const std::filesystem::path& scratch) {
  const std::filesystem::path output = scratch / "output.txt";
  std::vector<std::string> words{program.string()}, environment = changedEnvironment(changes);
  words.insert(words.end(), arguments.begin(), arguments.end());
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t process = 0;
  const Stopwatch watch;
  const int error = posix_spawn(&process, program.c_str(), &actions, nullptr, pointersTo(words).data(),
                                pointersTo(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw InputError(program.string(), std::string("cannot be started: ") + std::strerror(error));
  const int status = waitFor(process);
  const double ms = watch.elapsedMs();
  if (status != 0) {
    const std::vector<std::byte> said = readFile(output);
    throw InternalError(fmt::format("{} ended with status {}: {}", program.string(), status,
                                    std::string(reinterpret_cast<const char*>(said.data()), said.size())));
  }
  return ms;
}

}  // namespace crosslight::bench
