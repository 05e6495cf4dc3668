#include "postprocess/render/ticks.hpp"

#include <cmath>

namespace tessera::post {

std::vector<double> round_ticks(double minimum, double maximum, int wanted) {
  const double width = maximum - minimum;
  if (!(width > 0) || !std::isfinite(width))
    return {minimum};
  const double rough = width / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double nice : {5.0, 2.5, 2.0, 1.0})
    if (nice * power >= rough)
      step = nice * power;
  std::vector<double> ticks;
  const double slack = 1e-9 * width;
  for (double k = std::ceil((minimum - slack) / step); k * step <= maximum + slack; ++k)
    ticks.push_back(k * step);
  return ticks;
}

double round_length(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  for (const double nice : {5.0, 2.0})
    if (nice * power <= length)
      return nice * power;
  return power;
}

} // namespace tessera::post
