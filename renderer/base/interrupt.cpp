#include "base/interrupt.h"

#include <csignal>

#include "base/error.h"

namespace crosslight {
namespace {

volatile std::sig_atomic_t requested = 0;

void onSignal(int signal) {
  if (requested != 0) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  requested = 1;
}

}  // namespace

void installInterruptHandler() {
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
}

bool interruptRequested() { return requested != 0; }

void throwIfInterrupted() {
  if (interruptRequested()) throw Interrupted();
}

}  // namespace crosslight
