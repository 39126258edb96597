// The program; everything is in renderer/app.
#include "app/cli.h"

int main(int argc, char** argv) { return crosslight::runCommandLine(argc, argv); }
