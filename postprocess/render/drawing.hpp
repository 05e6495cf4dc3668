/// Bodies coloured by a field, with colour bar, length scale and captions.
#pragma once

#include "postprocess/render_job.hpp"

namespace tessera::post {

/// Writes drawing.file. InputError where a panel's file or the field is wrong; RunError when the disk
/// refuses.
void draw_body(const Drawing& drawing);

} // namespace tessera::post
