// Unit cube centred on the origin; its faces are named groups. Lengths in m.
SetFactory("OpenCASCADE");
Box(1) = {-0.5, -0.5, -0.5, 1, 1, 1};
small = 1e-3;
half = 0.5;
xmin() = Surface In BoundingBox {-half - small, -half - small, -half - small, -half + small, half + small, half + small};
xmax() = Surface In BoundingBox {half - small, -half - small, -half - small, half + small, half + small, half + small};
ymin() = Surface In BoundingBox {-half - small, -half - small, -half - small, half + small, -half + small, half + small};
ymax() = Surface In BoundingBox {-half - small, half - small, -half - small, half + small, half + small, half + small};
zmin() = Surface In BoundingBox {-half - small, -half - small, -half - small, half + small, half + small, -half + small};
zmax() = Surface In BoundingBox {-half - small, -half - small, half - small, half + small, half + small, half + small};
Physical Surface("xmin") = {xmin()};
Physical Surface("xmax") = {xmax()};
Physical Surface("ymin") = {ymin()};
Physical Surface("ymax") = {ymax()};
Physical Surface("zmin") = {zmin()};
Physical Surface("zmax") = {zmax()};
Physical Volume("body") = {1};
