// The whole program behind main(): parse, run, and turn every exception into its exit code and one message.
#pragma once

namespace crosslight {

int runCommandLine(int argc, char** argv);

}  // namespace crosslight
