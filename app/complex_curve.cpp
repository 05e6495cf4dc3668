#include "app/complex_curve.hpp"

namespace tessera::app {

post::Curve closed_curve(const std::string& label, const std::vector<std::complex<double>>& upper,
                         bool dashed) {
  post::Curve curve;
  curve.label = label;
  curve.dashed = dashed;
  for (std::size_t i = 0; i < 2 * upper.size(); ++i) {
    const std::complex<double> z = i < upper.size() ? upper[i] : std::conj(upper[2 * upper.size() - 1 - i]);
    curve.x.push_back(z.real());
    curve.y.push_back(z.imag());
  }
  return curve;
}

post::Curve dots(const std::string& label, const std::vector<std::complex<double>>& values, double factor) {
  post::Curve curve;
  curve.label = label;
  curve.dots = true;
  for (const std::complex<double> value : values) {
    curve.x.push_back(factor * value.real());
    curve.y.push_back(factor * value.imag());
  }
  return curve;
}

} // namespace tessera::app
