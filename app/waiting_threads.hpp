/// How threads wait for each other.
#pragma once

namespace tessera::app {

/// Starts this program again with OMP_WAIT_POLICY=passive, unless the user has chosen how OpenMP's threads
/// wait.
///
/// By default they spin. As soon as another program wants one of the processors, the spinning thread holds
/// the one its partner needs, and a step takes ten times as long; asleep they cost a few microseconds a loop.
/// The OpenMP library reads its environment before main, so only a new start can say so. Does nothing where
/// that fails.
void let_waiting_threads_sleep(char** argv);

} // namespace tessera::app
