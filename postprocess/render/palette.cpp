#include "postprocess/render/palette.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace tessera::post {
namespace {

/// Equal steps look equal and lightness grows throughout, so it survives grey printing: dark violet to
/// yellow.
constexpr std::array<Colour, 9> one_sided{{{74, 32, 108},
                                           {74, 58, 136},
                                           {64, 92, 148},
                                           {44, 114, 142},
                                           {33, 145, 140},
                                           {40, 174, 128},
                                           {94, 201, 98},
                                           {173, 220, 48},
                                           {253, 231, 37}}};

/// Blue below, grey in the middle, red above.
constexpr std::array<Colour, 9> two_sided_colours{{{59, 76, 192},
                                                   {98, 130, 234},
                                                   {141, 176, 254},
                                                   {184, 208, 249},
                                                   {221, 221, 221},
                                                   {245, 196, 173},
                                                   {244, 154, 123},
                                                   {222, 96, 77},
                                                   {180, 4, 38}}};

constexpr std::array<Colour, 8> curves{{{0, 90, 181},
                                        {220, 50, 32},
                                        {0, 130, 80},
                                        {230, 140, 0},
                                        {126, 47, 142},
                                        {20, 160, 190},
                                        {120, 80, 40},
                                        {80, 80, 80}}};

} // namespace

Colour ColourScale::operator()(double value) const {
  if (std::isnan(value))
    return {150, 150, 150};
  const std::span<const Colour> colours = two_sided ? std::span(two_sided_colours) : std::span(one_sided);
  const double width = maximum - minimum;
  const double t = width > 0 ? std::clamp((value - minimum) / width, 0.0, 1.0) : 0.0;
  const double place = t * static_cast<double>(colours.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), colours.size() - 2);
  const double part = place - static_cast<double>(below);
  Colour mixed{};
  for (std::size_t c = 0; c < 3; ++c)
    mixed[c] =
        static_cast<std::uint8_t>(std::lround((1 - part) * colours[below][c] + part * colours[below + 1][c]));
  return mixed;
}

Colour curve_colour(int index) {
  return curves[static_cast<std::size_t>(index) % curves.size()];
}

} // namespace tessera::post
