#include "app/video_pipe.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "base/check.h"
#include "base/error.h"
#include "base/interrupt.h"

extern char** environ;

namespace crosslight {
namespace {

constexpr int kPollMs = 50;               // how late Ctrl-C may be noticed
constexpr std::size_t kMostWords = 2000;  // of the encoder's last words

std::string errnoText(int error) { return std::strerror(error); }

struct SpawnFiles {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  SpawnFiles(int in, int err) {
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err, STDERR_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    // A group of its own: Ctrl-C is for this program, which then ends the encoder.
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
  }
  ~SpawnFiles() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
};

}  // namespace

std::string findVideoEncoder() {
  const char* list = std::getenv("PATH");
  std::string_view rest = list == nullptr ? "" : list;
  while (!rest.empty()) {
    const std::string_view folder = rest.substr(0, rest.find(':'));
    rest.remove_prefix(std::min(folder.size() + 1, rest.size()));
    const std::filesystem::path candidate = std::filesystem::path(folder.empty() ? "." : folder) / "ffmpeg";
    std::error_code ignored;
    if (std::filesystem::is_regular_file(candidate, ignored) && ::access(candidate.c_str(), X_OK) == 0) {
      return candidate.string();
    }
  }
  throw DeviceError(
      "a video needs the program ffmpeg, which is not on the PATH; install it (Debian and Ubuntu: package ffmpeg), or "
      "write frames: -o frame_####.png");
}

std::vector<std::string> encoderArguments(const VideoFormat& format, const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  std::vector<std::string> words = {"ffmpeg",
                                    "-hide_banner",
                                    "-loglevel",
                                    "error",
                                    "-y",
                                    "-f",
                                    "rawvideo",
                                    "-pixel_format",
                                    "rgb24",
                                    "-video_size",
                                    fmt::format("{}x{}", format.width, format.height),
                                    "-framerate",
                                    fmt::format("{}", format.framesPerSecond),
                                    "-i",
                                    "pipe:0"};
  if (extension == ".gif") {
    // One palette for the whole film, or colors would flicker.
    words.insert(words.end(), {"-filter_complex", "[0:v]split[a][b];[a]palettegen[p];[b][p]paletteuse"});
  } else {
    // Players expect half the color resolution, which needs even sides.
    words.insert(words.end(), {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"});
  }
  // A name that begins with a dash is no option.
  words.push_back(file.is_absolute() ? file.string() : "./" + file.string());
  return words;
}

VideoPipe::VideoPipe(const VideoFormat& format, const std::filesystem::path& file)
    : file_(file.string()), errors_(std::tmpfile()) {
  const std::string program = findVideoEncoder();
  if (errors_ == nullptr) throw InternalError("no temporary file can be made: " + errnoText(errno));
  // A socket instead of a pipe: writing to it can be told not to raise SIGPIPE.
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    throw InternalError("no socket can be made: " + errnoText(errno));
  }
  const std::vector<std::string> words = encoderArguments(format, file);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const SpawnFiles files(ends[1], ::fileno(errors_.get()));
  const int error =
      ::posix_spawn(&process_, program.c_str(), &files.actions, &files.attributes, arguments.data(), environ);
  ::close(ends[1]);
  socket_ = ends[0];
  if (error != 0) {
    closeSocket();
    throw DeviceError("'" + program + "' cannot be started: " + errnoText(error));
  }
}

VideoPipe::~VideoPipe() {
  closeSocket();
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

void VideoPipe::closeSocket() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

std::string VideoPipe::lastWords() const {
  std::string text;
  std::fseek(errors_.get(), 0, SEEK_END);
  const long size = std::ftell(errors_.get());
  std::fseek(errors_.get(), std::max(0L, size - static_cast<long>(kMostWords)), SEEK_SET);
  for (int c = std::fgetc(errors_.get()); c != EOF; c = std::fgetc(errors_.get())) text += static_cast<char>(c);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  return text.empty() ? "it said nothing" : "it said: " + text;
}

void VideoPipe::fail(const std::string& what) {
  throw DeviceError("ffmpeg " + what + " while it made " + file_ + "; " + lastWords());
}

void VideoPipe::write(const DisplayPicture& picture) {
  CL_CHECK_EQ(picture.channels, 3u);
  send(picture.codes.data(), picture.codes.size());
}

void VideoPipe::send(const std::uint8_t* bytes, std::size_t count) {
  while (count > 0) {
    throwIfInterrupted();
    pollfd ready{socket_, POLLOUT, 0};
    if (::poll(&ready, 1, kPollMs) <= 0) continue;
    const ssize_t sent = ::send(socket_, bytes, count, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (sent < 0) {
      closeSocket();
      const int status = waitForEnd();
      fail(WIFEXITED(status) ? fmt::format("ended with exit code {}", WEXITSTATUS(status)) : "was ended by a signal");
    }
    bytes += sent;
    count -= static_cast<std::size_t>(sent);
  }
}

// Its wait status. Looks for Ctrl-C, as an encoder may take its time.
int VideoPipe::waitForEnd() {
  int status = 0;
  while (::waitpid(process_, &status, WNOHANG) == 0) {
    throwIfInterrupted();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  process_ = -1;
  return status;
}

void VideoPipe::finish() {
  closeSocket();
  const int status = waitForEnd();
  if (WIFSIGNALED(status)) fail(fmt::format("was ended by signal {}", WTERMSIG(status)));
  if (WEXITSTATUS(status) != 0) fail(fmt::format("ended with exit code {}", WEXITSTATUS(status)));
  std::error_code error;
  if (std::filesystem::file_size(file_, error) == 0 || error) fail("made no file");
}

}  // namespace crosslight
