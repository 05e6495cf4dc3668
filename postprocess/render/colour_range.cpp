#include "postprocess/render/colour_range.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tessera::post {

Range range_of(const std::vector<Body>& bodies, double outermost) {
  std::vector<double> all;
  for (const Body& body : bodies)
    std::copy_if(body.values.begin(), body.values.end(), std::back_inserter(all),
                 [](double v) { return std::isfinite(v); });
  const bool gaps = std::any_of(bodies.begin(), bodies.end(), [](const Body& body) {
    return std::any_of(body.values.begin(), body.values.end(), [](double v) { return std::isnan(v); });
  });
  if (all.empty())
    return {0, 0, 0, 0, gaps};
  std::sort(all.begin(), all.end());
  const auto tail = static_cast<std::size_t>(outermost * static_cast<double>(all.size()));
  return {all.front(), all.back(), all[tail], all[all.size() - 1 - tail], gaps};
}

ColourScale scale_of(const Drawing& drawing, const Quantity& quantity, const Range& range) {
  const double likely = std::max(range.likely_high - range.likely_low, 1e-300);
  double low = drawing.cloud || range.low < range.likely_low - likely ? range.likely_low : range.low;
  double high = drawing.cloud || range.high > range.likely_high + likely ? range.likely_high : range.high;
  ColourScale scale;
  scale.two_sided = quantity.palette == Palette::diverging;
  if (scale.two_sided) {
    // The limits asked for count as values; a trace beyond the centre makes no second side.
    constexpr double trace = 0.02;
    const double below = quantity.centre - (std::isnan(drawing.minimum) ? low : drawing.minimum);
    const double above = (std::isnan(drawing.maximum) ? high : drawing.maximum) - quantity.centre;
    const double reach = std::max(std::abs(below), std::abs(above));
    scale.two_sided = reach == 0 || (below > trace * reach && above > trace * reach);
    low = !scale.two_sided && below <= trace * reach ? quantity.centre : quantity.centre - reach;
    high = !scale.two_sided && above <= trace * reach ? quantity.centre : quantity.centre + reach;
  } else if (quantity.palette == Palette::from_zero && low > 0) {
    low = 0;
  }
  scale.minimum = std::isnan(drawing.minimum) ? low : drawing.minimum;
  scale.maximum = std::isnan(drawing.maximum) ? high : drawing.maximum;
  const double size = std::max(std::abs(scale.minimum), std::abs(scale.maximum));
  if (scale.maximum - scale.minimum <= 1e-6 * size ||
      size == 0) { // one colour: the middle of a scale about it
    const double half = size == 0 ? 1 : 0.05 * size;
    if (std::isnan(drawing.minimum) && !(quantity.palette == Palette::from_zero && size == 0))
      scale.minimum -= half;
    scale.maximum += half;
  }
  return scale;
}

} // namespace tessera::post
