/// The grammar of the command line.
#pragma once

#include "app/options.hpp"

namespace tessera::app {

using Command = void (*)(const Options&);

struct Invocation {
  Command command = nullptr; ///< null: help or version was asked for and has been printed
  Options options;
};

/// InputError in one line for unknown commands and options, missing or malformed arguments.
Invocation parse_command_line(int argc, const char* const* argv);

} // namespace tessera::app
