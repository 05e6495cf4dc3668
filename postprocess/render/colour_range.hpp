/// Which values the colours of a drawing span.
#pragma once

#include "postprocess/quantity.hpp"
#include "postprocess/render/body.hpp"
#include "postprocess/render/palette.hpp"
#include "postprocess/render_job.hpp"

#include <vector>

namespace tessera::post {

struct Range {
  double low = 0, high = 0;               ///< of all finite values
  double likely_low = 0, likely_high = 0; ///< of all but the outermost on each side
  bool gaps = false;                      ///< some particles have no value
};

/// `outermost`: which share of the values on each side is not likely.
Range range_of(const std::vector<Body>& bodies, double outermost);

/// The drawing's own limits where it has them. Where a handful of particles lies far out (a spurious strain
/// of 150 beside a body at 3) they would hide the body: then the scale ends where the others do. A cloud's
/// scale always spans the likely ones. Two-sided fields that lie on one side of their centre get a one-sided
/// scale that begins there. The extremes are printed beside the scale in any case.
ColourScale scale_of(const Drawing& drawing, const Quantity& quantity, const Range& range);

} // namespace tessera::post
