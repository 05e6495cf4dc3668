#include "app/console.hpp"

#include "core/error.hpp"

#include <unistd.h>

#include <iostream>

namespace tessera::app {

Console::Console(const Options& options)
    : quiet_(options.quiet), json_(options.json),
      progress_(std::cerr, ::isatty(STDERR_FILENO) != 0, options.quiet) {}

void Console::result(std::string_view text, std::string_view json) const {
  if (json_ || !quiet_)
    answer(text, json);
}

void Console::answer(std::string_view text, std::string_view json) const {
  const std::string_view shown = json_ ? json : text;
  std::cout << shown;
  if (!shown.ends_with('\n'))
    std::cout << '\n';
  std::cout.flush();
  if (!std::cout)
    throw RunError("cannot write the result", "standard output", "check where it is redirected to");
}

} // namespace tessera::app
