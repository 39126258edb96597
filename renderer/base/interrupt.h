// Ctrl-C as a flag that long loops ask about: nothing is torn down inside a signal handler.
#pragma once

namespace crosslight {

void installInterruptHandler();  // SIGINT and SIGTERM set the flag; a second SIGINT ends the process at once
bool interruptRequested();
void throwIfInterrupted();  // throws Interrupted when the flag is set

}  // namespace crosslight
