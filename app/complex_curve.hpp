/// Curves and points of the complex plane in a chart.
#pragma once

#include "postprocess/render_job.hpp"

#include <complex>
#include <string>
#include <vector>

namespace tessera::app {

/// A closed curve by its upper half, the lower half being the mirror image.
post::Curve closed_curve(const std::string& label, const std::vector<std::complex<double>>& upper,
                         bool dashed);

/// Dots at the values times a factor.
post::Curve dots(const std::string& label, const std::vector<std::complex<double>>& values, double factor);

} // namespace tessera::app
