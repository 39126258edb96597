// The sentences about the program as a whole: summary, exit codes, environment. Help, man page and README show these.
#pragma once

#include "app/command_model.h"

namespace crosslight {

inline constexpr const char* kProgramSummary =
    "Draws one glTF scene in every classical way, on Vulkan, without a window";

// Everything of the model but options and commands.
ProgramModel programText();

}  // namespace crosslight
