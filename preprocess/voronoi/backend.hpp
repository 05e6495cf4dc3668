/// Who finds neighbours and cuts cells.
#pragma once

namespace tessera::preprocess {

/// This project's clipper on CGAL's neighbours, or Voro++ for both. Voro++ is the cross-check: slower, and
/// right to about 1e-13 of a cell.
enum class Backend { clipper, voro };

} // namespace tessera::preprocess
