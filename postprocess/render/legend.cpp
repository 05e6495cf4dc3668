#include "postprocess/render/legend.hpp"

#include "postprocess/render/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera::post {

void draw_bar(Canvas& canvas, const ColourScale& scale, const Quantity& quantity, const Range& range,
              Pixel lower, double height, double width) {
  const double left = lower.x, low = lower.y, high = lower.y + height;
  constexpr double thickness = 34;
  constexpr int slices = 200;
  const auto at = [&](double value) {
    return low + (value - scale.minimum) / (scale.maximum - scale.minimum) * (high - low);
  };
  for (int s = 0; s < slices; ++s) {
    const double value = scale.minimum + (s + 0.5) / slices * (scale.maximum - scale.minimum);
    canvas.rectangle({left, low + (high - low) * s / slices},
                     {left + thickness, low + (high - low) * (s + 1) / slices + 1}, scale(value));
  }
  const Unit unit = readable_unit(quantity.unit, std::max(std::abs(scale.minimum), std::abs(scale.maximum)));
  for (const double tick : round_ticks(scale.minimum * unit.factor, scale.maximum * unit.factor, 6)) {
    const double y = at(tick / unit.factor);
    canvas.line({left + thickness, y}, {left + thickness + 8, y}, {80, 80, 80}, 2);
    canvas.text({left + thickness + 16, y}, figure(tick));
  }
  canvas.text({left + 155, (low + high) / 2}, titled(quantity.label, unit.name),
              {.size = 28, .anchor = Anchor::centre, .upwards = true, .width = height});
  const auto extreme = [&](double value) {
    return std::abs(value * unit.factor) < 999.5 ? fmt::format("{:.3g}", value * unit.factor)
                                                 : figure(value * unit.factor);
  };
  const std::string extremes = range.low == range.high
                                   ? fmt::format("{} everywhere", extreme(range.low))
                                   : fmt::format("from {} to {}", extreme(range.low), extreme(range.high));
  canvas.text({left, low - 32}, extremes, {.size = 21, .width = width - 20});
  if (range.gaps) {
    canvas.rectangle({left, low - 67}, {left + 18, low - 51},
                     scale(std::numeric_limits<double>::quiet_NaN()));
    canvas.text({left + 26, low - 59}, "too little stress", {.size = 21, .width = width - 46});
  }
}

void draw_axes(Canvas& canvas, const View& view, Pixel at) {
  constexpr double length = 42;
  at.y -= length * std::min(0.0, static_cast<double>(view.up.minCoeff())); // room for arrows that point down
  const char* names[] = {"x", "y", "z"};
  const Colour colours[] = {{200, 40, 40}, {30, 140, 60}, {40, 80, 200}};
  for (int axis = 0; axis < 3; ++axis) {
    const double right = view.right[axis], up = view.up[axis], shown = std::hypot(right, up);
    if (shown < 0.1)
      continue; // towards the viewer
    const Pixel tip{at.x + length * right, at.y + length * up};
    canvas.line(at, tip, colours[axis], 4);
    canvas.text({tip.x + 16 * right / shown, tip.y + 16 * up / shown}, names[axis],
                {.size = 22, .anchor = Anchor::centre});
  }
}

void draw_length(Canvas& canvas, double metres_per_pixel, Pixel at) {
  const double length = round_length(130 * metres_per_pixel);
  const double pixels = length / metres_per_pixel;
  canvas.line(at, {at.x + pixels, at.y}, {40, 40, 40}, 5);
  canvas.text({at.x + pixels + 14, at.y}, with_unit(length, "m"), {.size = 22});
}

} // namespace tessera::post
