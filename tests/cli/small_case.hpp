/// A case of a few hundred particles that runs in a second, and ways to spoil it.
#pragma once

#include "tests/cli/program.hpp"

#include <string>

namespace tessera::cli {

/// Writes box.geo (10 x 10 x 20 mm) and case.toml (lattice of 225 particles thrown at a wall) into the
/// workplace.
void write_small_case(const Workplace& place);

/// The text of that case.toml, one key a line.
extern const std::string small_case;

/// small_case with the first occurrence of `from` replaced; throws where there is none.
std::string with(const std::string& from, const std::string& to);

/// Line of small_case, from 1, on which `text` stands.
int line_of(const std::string& text);

/// Expects status 2 (or `status`), nothing on standard output, and one line "error: ..." holding every piece.
void expect_error(const Result& result, const std::vector<std::string>& pieces, int status = 2);

} // namespace tessera::cli
