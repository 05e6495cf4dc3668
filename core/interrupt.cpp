#include "core/interrupt.hpp"

#include "core/error.hpp"

#include <csignal>

namespace tessera {
namespace {

volatile std::sig_atomic_t signal_seen = 0;

extern "C" void on_signal(int number) {
  if (signal_seen != 0) {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
  signal_seen = 1;
}

} // namespace

void catch_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

bool interrupted() {
  return signal_seen != 0;
}

void stop_if_interrupted(const char* stage) {
  if (interrupted())
    throw RunError(std::string("interrupted during ") + stage, "",
                   "run the same command again to start it anew");
}

} // namespace tessera
