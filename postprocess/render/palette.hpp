/// From numbers to colours.
#pragma once

#include "postprocess/quantity.hpp"

#include <array>
#include <cstdint>

namespace tessera::post {

using Colour = std::array<std::uint8_t, 3>;

/// A palette over a range of SI values.
struct ColourScale {
  double minimum = 0, maximum = 1;
  bool two_sided = false;

  /// Values outside take the end colours, NaN a grey.
  Colour operator()(double value) const;
};

/// Dark colours that stay apart on white and for most colour-blind readers; repeats after eight.
Colour curve_colour(int index);

} // namespace tessera::post
