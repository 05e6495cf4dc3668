// Whether this machine can execute what the compiler was told to produce. Runs before every other
// initialisation of the program and is compiled for the plainest processor (see CMakeLists.txt), so that it
// works where the rest would not.

#include <unistd.h>

#include <cstring>

namespace {

__attribute__((constructor(101))) void require_cpu() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
    return;
  const char* line =
      "error: this processor has no AVX2 and FMA instructions, which this build of tessera uses, "
      "configure with -DTESSERA_ARCH=x86-64 and build again\n";
  const ssize_t written = ::write(STDERR_FILENO, line, std::strlen(line));
  ::_exit(written < 0 ? 2 : 1);
}

} // namespace
