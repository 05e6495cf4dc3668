/// What the program has cost so far: processor time and memory. Unlike wall time the former means the same on
/// a busy machine.
#pragma once

#include <cstdint>

namespace tessera {

/// Seconds by the clock since some fixed instant.
double wall_seconds();

/// Processor seconds of this process, all threads together, since it began.
double cpu_seconds();

/// The same of the processes it has started, as far as they have ended.
double cpu_seconds_of_children();

/// Largest memory this process has held, bytes.
std::uint64_t peak_memory();

} // namespace tessera
