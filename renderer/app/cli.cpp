#include "app/cli.h"

#include <exception>
#include <new>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/large_pages.h"
#include "base/error.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "gpu/device.h"

namespace crosslight {
namespace {

int fail(ExitCode code, const std::string& message) {
  logError(message);
  return static_cast<int>(code);
}

}  // namespace

int runCommandLine(int argc, char** argv) {
  try {
    useLargePages();
    installInterruptHandler();
    CommandLine line;
    addRenderCommand(line);
    addExplainCommand(line);
    addStabilityCommand(line);
    addInfoCommand(line);
    addDevicesCommand(line);
    addMergeCommand(line);
    addSheetCommand(line);
    addCompletionCommand(line);
    addManCommand(line);
    line.run(argc, argv);
    if (gpu::lateValidationMessages() > 0) throw InternalError("the validation layer objected while the device closed");
    return static_cast<int>(ExitCode::ok);
  } catch (const Error& error) {
    return fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::internal, "out of memory; a smaller --resolution or scene needs less");
  } catch (const std::exception& error) {
    return fail(ExitCode::internal, std::string("internal error: ") + error.what());
  }
}

}  // namespace crosslight
