/// What stands in a scene: spheres, cells, boxes.
#pragma once

#include "postprocess/cell_surfaces.hpp"
#include "postprocess/cut_body.hpp"
#include "postprocess/render/body.hpp"
#include "postprocess/render/palette.hpp"

#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace tessera::post {

/// How a scene is drawn, for spheres to lie at their true depth.
struct Optics {
  double depth = 1;            ///< m between the nearest and farthest the camera sees
  double metres_per_pixel = 1; ///< without perspective
};

/// Particles as shaded spheres of Body::radii, coloured by their values.
vtkSmartPointer<vtkActor> spheres(const Body& body, const ColourScale& scale, const Optics& optics);

/// Particles as dark dots of `part` of Body::radii.
vtkSmartPointer<vtkActor> dots(const Body& body, double part, const Optics& optics);

/// Faces of cells coloured by values[particle].
vtkSmartPointer<vtkActor> cell_faces(const CellSurfaces& cells, const std::vector<double>& values,
                                     const ColourScale& scale);

/// Their edges, `width` pixels wide, moved by `towards_viewer` (m) so that the faces do not swallow them.
vtkSmartPointer<vtkActor> cell_edges(const CellSurfaces& cells, const Point& towards_viewer, float width);

/// The surface of a body, smooth but for its edges, coloured by its values.
vtkSmartPointer<vtkActor> skin_faces(const CutBody& body, const ColourScale& scale);

/// Flat faces coloured by the body's values, as bright as the legend: its section, or all of a plane one.
vtkSmartPointer<vtkActor> flat_faces(const CutBody& body, const std::vector<CutBody::Polygon>& faces,
                                     const ColourScale& scale);

/// Flat quadrilaterals of one grey (0 is black), whatever the light.
vtkSmartPointer<vtkActor> grey_faces(const std::vector<std::array<Vec3, 4>>& faces, double grey);

/// How lines are drawn.
struct Pen {
  double grey = 0.55; ///< 0 is black
  float width = 2;    ///< pixels
};

/// Lines moved by `towards_viewer` (m).
vtkSmartPointer<vtkActor> drawn_lines(const std::vector<std::array<Vec3, 2>>& lines, const Pen& pen,
                                      const Point& towards_viewer = Point::Zero());

/// The edges of a box.
std::vector<std::array<Vec3, 2>> box_lines(const Eigen::AlignedBox3f& box);

} // namespace tessera::post
