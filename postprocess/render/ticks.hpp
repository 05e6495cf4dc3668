/// Round numbers for scales.
#pragma once

#include <vector>

namespace tessera::post {

/// About `wanted` multiples of 1, 2, 2.5 or 5 times a power of ten in [minimum, maximum].
std::vector<double> round_ticks(double minimum, double maximum, int wanted);

/// The largest 1, 2 or 5 times a power of ten not above `length`.
double round_length(double length);

} // namespace tessera::post
