// Frames into a video, by the program ffmpeg: raw pictures through a socket that is its standard input.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "image/image_io.h"

namespace crosslight {

// The path of ffmpeg as PATH has it; DeviceError with the remedy when there is none.
std::string findVideoEncoder();

struct VideoFormat {
  std::uint32_t width = 0, height = 0;
  double framesPerSecond = 24;
};

// The words of the command line, the program's name first. The container follows the file's extension.
std::vector<std::string> encoderArguments(const VideoFormat& format, const std::filesystem::path& file);

class VideoPipe {
 public:
  VideoPipe(const VideoFormat& format, const std::filesystem::path& file);
  VideoPipe(const VideoPipe&) = delete;
  VideoPipe& operator=(const VideoPipe&) = delete;
  ~VideoPipe();  // ends the program if finish() was not reached

  // DeviceError with the program's last words when it does not take a picture; Interrupted on Ctrl-C.
  void write(const DisplayPicture& picture);
  // Ends the stream and waits for the program; DeviceError unless it ends with 0.
  void finish();

 private:
  void send(const std::uint8_t* bytes, std::size_t count);
  [[noreturn]] void fail(const std::string& what);
  std::string lastWords() const;
  int waitForEnd();
  void closeSocket();

  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string file_;
  std::unique_ptr<std::FILE, CloseFile> errors_;  // what the program writes to its stderr
  pid_t process_ = -1;
  int socket_ = -1;
};

}  // namespace crosslight
