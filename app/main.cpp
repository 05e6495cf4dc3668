#include "app/command_line.hpp"
#include "app/short_spins.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/parallel.hpp"

#include <csignal>
#include <iostream>
#include <new>

namespace {

int fail(const std::string& line, tessera::ExitStatus status) {
  std::cerr << "error: " << line << std::endl;
  return static_cast<int>(status);
}

} // namespace

int main(int argc, char** argv) {
  using tessera::ExitStatus;
  tessera::app::spin_shortly(argv);
  tessera::catch_interrupts();
  std::signal(SIGXFSZ, SIG_IGN); // a file grown too large is an error of write(), as a full disk is
  std::signal(SIGPIPE, SIG_IGN);
  try {
    const tessera::app::Invocation invocation = tessera::app::parse_command_line(argc, argv);
    if (invocation.command == nullptr)
      return static_cast<int>(ExitStatus::good);
    tessera::set_threads(invocation.options.threads);
    invocation.command(invocation.options);
    return static_cast<int>(ExitStatus::good);
  } catch (const tessera::Error& e) {
    // Ctrl-C reaches the importer's process too; what it then fails with is not the input's fault.
    if (tessera::interrupted() && e.status() == ExitStatus::bad_input)
      return fail("interrupted before the run began, run the same command again", ExitStatus::run_failed);
    return fail(e.what(), e.status());
  } catch (const std::bad_alloc&) {
    return fail("out of memory, take fewer particles or a machine with more memory", ExitStatus::run_failed);
  } catch (const std::exception& e) {
    return fail(std::string("internal: ") + e.what() + ", please report it with the command and the case",
                ExitStatus::run_failed);
  } catch (...) {
    return fail("internal: unknown, please report it with the command and the case", ExitStatus::run_failed);
  }
}
