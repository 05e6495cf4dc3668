/// Coloured cells over two lists of choices.
#pragma once

#include "postprocess/render_job.hpp"

namespace tessera::post {

/// Writes chart.file: the panels beside each other, or below where they grow too wide, the meaning of the
/// colours under them. RunError when the disk refuses.
void draw_cell_chart(const CellChart& chart);

} // namespace tessera::post
