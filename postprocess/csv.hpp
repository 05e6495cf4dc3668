/// Comma-separated values, quoted where a reader would trip.
#pragma once

#include <string>
#include <vector>

namespace tessera::post {

/// One line with its end.
std::string csv_line(const std::vector<std::string>& cells);

/// A number with enough digits to give the same float32 again; empty where it is none.
std::string csv_number(double value);

} // namespace tessera::post
