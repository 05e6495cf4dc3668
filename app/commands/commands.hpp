/// One function per command of the program. Each throws the errors people meet; returning means success.
#pragma once

#include "app/options.hpp"

namespace tessera::app {

void run(const Options& options);           ///< prepare, solve, draw
void prepare(const Options& options);       ///< CAD file to particles
void solve(const Options& options);         ///< particles to fields and history
void post(const Options& options);          ///< stored fields to pictures and report
void check(const Options& options);         ///< validate and foretell; writes nothing
void compare(const Options& options);       ///< several runs in one table
void export_fields(const Options& options); ///< a frame's numbers as CSV
void study(const Options& options);         ///< a grid of runs: what accuracy costs
void stability(const Options& options);     ///< chapter 4's model, or the spectrum of a case's operators
void materials(const Options& options);     ///< the laws a case can name, or where they are hyperbolic

} // namespace tessera::app
