/// Ctrl-C and SIGTERM as a flag that long loops look at, so that nothing is lost half-written.
#pragma once

namespace tessera {

/// Route SIGINT and SIGTERM to the flag. A second signal ends the process at once.
void catch_interrupts();

/// True once a signal has arrived.
bool interrupted();

/// Throws RunError("interrupted during STAGE") once a signal has arrived.
void stop_if_interrupted(const char* stage);

} // namespace tessera
