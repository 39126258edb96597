#include "app/program_text.h"

#include "app/version.h"
#include "base/error.h"

namespace crosslight {
namespace {

int number(ExitCode code) { return static_cast<int>(code); }

}  // namespace

ProgramModel programText() {
  ProgramModel program;
  program.name = "crosslight";
  program.version = versionText();
  program.summary = kProgramSummary;
  program.details =
      "Wireframe, flat, Gouraud and Phong shading through graphics pipelines, and Whitted ray tracing through compute "
      "kernels, all with the same illumination functions.\n\n"
      "Standard output carries only what was asked for; messages and progress go to standard error. Output files are "
      "written whole or not at all.";
  program.exitCodes = {
      {number(ExitCode::ok), "done"},
      {number(ExitCode::checkFailed), "a check failed, or images differ"},
      {number(ExitCode::usage), "the command line asks for something that does not exist"},
      {number(ExitCode::input), "a file cannot be read or written, or needs something unsupported"},
      {number(ExitCode::device), "no usable device, or the device lacks what is needed; both are named"},
      {number(ExitCode::internal), "internal error, or the device was lost"},
      {number(ExitCode::interrupted), "interrupted; no partial output is left"},
  };
  program.environment = {
      {"CROSSLIGHT_VALIDATION", "1: Vulkan's validation layer is on; any message of it ends with exit code 5"},
      {"XDG_CACHE_HOME",
       "the folder of crosslight/, where trees of large scenes and hardware drivers' compiled pipelines are kept"},
      {"VK_DRIVER_FILES", "the Vulkan loader's own: which drivers are looked at"},
      {"LP_NUM_THREADS", "lavapipe's own: its number of threads; the image does not depend on it"},
  };
  return program;
}

}  // namespace crosslight
