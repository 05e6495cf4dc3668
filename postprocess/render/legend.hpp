/// What stands beside a drawing: the colour bar, the coordinate axes and the length scale.
#pragma once

#include "postprocess/quantity.hpp"
#include "postprocess/render/canvas.hpp"
#include "postprocess/render/colour_range.hpp"
#include "postprocess/render/view.hpp"

namespace tessera::post {

/// The colour bar with its numbers, label and the true extremes. `lower` is its lower left corner, `width`
/// the room there is for it and its numbers.
void draw_bar(Canvas& canvas, const ColourScale& scale, const Quantity& quantity, const Range& range,
              Pixel lower, double height, double width);

/// Short arrows of the coordinate axes, none of them reaching below `at`.
void draw_axes(Canvas& canvas, const View& view, Pixel at);

/// A bar of round length, with that length beside it.
void draw_length(Canvas& canvas, double metres_per_pixel, Pixel at);

} // namespace tessera::post
