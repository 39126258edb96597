// The commands of the program; each is declared and defined in its own command_*.cpp.
#pragma once

namespace crosslight {

class CommandLine;

void addRenderCommand(CommandLine& line);
void addExplainCommand(CommandLine& line);
void addStabilityCommand(CommandLine& line);
void addInfoCommand(CommandLine& line);
void addDevicesCommand(CommandLine& line);
void addMergeCommand(CommandLine& line);
void addSheetCommand(CommandLine& line);
void addCompletionCommand(CommandLine& line);
void addManCommand(CommandLine& line);

}  // namespace crosslight
