/// How threads wait for each other.
#pragma once

namespace tessera::app {

/// Starts this program again with GOMP_SPINCOUNT=2000, unless the user has chosen how OpenMP's threads wait.
///
/// By default they spin for long. As soon as another program wants one of the processors, the spinning thread
/// holds the one its partner needs, and a step takes ten times as long. Sleeping at once
/// (OMP_WAIT_POLICY=passive) gives away what the second thread wins. A short spin costs nothing on a quiet
/// machine and little on a busy one. GCC's OpenMP library reads its environment before main, so only a new
/// start can say so. Does nothing where that fails.
void spin_shortly(char** argv);

} // namespace tessera::app
