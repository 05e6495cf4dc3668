/// The lines by which one draws a body: its edges, and where its surface turns away from the viewer.
#pragma once

#include "postprocess/cut_body.hpp"

#include <array>
#include <vector>

namespace tessera::post {

/// Lines of the body as seen along the unit vector `into`, without perspective: its edges and silhouette,
/// none of which lie between two faces that are turned away, and the rim of its section. Of a plane body all
/// its edges.
std::vector<std::array<Vec3, 2>> outline_of(const CutBody& body, const Vec3& into);

} // namespace tessera::post
