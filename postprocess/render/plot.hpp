/// Charts of curves.
#pragma once

#include "postprocess/render_job.hpp"

namespace tessera::post {

/// Writes plot.file: one chart above the other. RunError when the disk refuses.
void draw_plot(const Plot& plot);

} // namespace tessera::post
