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
  if (all.empty())
    return {};
  std::sort(all.begin(), all.end());
  const auto tail = static_cast<std::size_t>(outermost * static_cast<double>(all.size()));
  return {all.front(), all.back(), all[tail], all[all.size() - 1 - tail]};
}

ColourScale scale_of(const Drawing& drawing, const Quantity& quantity, const Range& range) {
  const double likely = std::max(range.likely_high - range.likely_low, 1e-300);
  double low = drawing.cloud || range.low < range.likely_low - likely ? range.likely_low : range.low;
  double high = drawing.cloud || range.high > range.likely_high + likely ? range.likely_high : range.high;
  ColourScale scale;
  scale.two_sided = quantity.palette == Palette::diverging;
  if (scale.two_sided) {
    const double reach = std::max(std::abs(high - quantity.centre), std::abs(low - quantity.centre));
    low = quantity.centre - reach;
    high = quantity.centre + reach;
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
