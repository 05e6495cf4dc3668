// Plate of 60 x 40 x 8 mm standing on z = 0 with a counterbored hole in its middle, four bolt holes, a slotted hole and
// rounded upright edges. Lengths in mm.
SetFactory("OpenCASCADE");
length = 60;
width = 40;
thickness = 8;
round = 5;             // radius of the upright edges
bore = 8;              // radius of the middle hole
counterbore = 11;      // radius of its wider upper part
counterbore_depth = 3;
bolt = 2.75;           // radius of the bolt holes
inset = 7;             // of the bolt holes from the plate's sides

Rectangle(1) = {0, 0, 0, length, width, round};
plate[] = Extrude {0, 0, thickness} { Surface{1}; };
Cylinder(101) = {length / 2, width / 2, -1, 0, 0, thickness + 2, bore};
Cylinder(102) = {length / 2, width / 2, thickness - counterbore_depth, 0, 0, thickness, counterbore};
Cylinder(103) = {inset, inset, -1, 0, 0, thickness + 2, bolt};
Cylinder(104) = {length - inset, inset, -1, 0, 0, thickness + 2, bolt};
Cylinder(105) = {length - inset, width - inset, -1, 0, 0, thickness + 2, bolt};
Cylinder(106) = {inset, width - inset, -1, 0, 0, thickness + 2, bolt};
// The slotted hole: a box between two cylinders.
Cylinder(107) = {9, width / 2 - 3, -1, 0, 0, thickness + 2, 2};
Cylinder(108) = {9, width / 2 + 3, -1, 0, 0, thickness + 2, 2};
Box(109) = {7, width / 2 - 3, -1, 4, 6, thickness + 2};
BooleanDifference(1000) = { Volume{plate[1]}; Delete; }{ Volume{101:109}; Delete; };

e = 1e-3;
bore_wall() = Surface In BoundingBox {length / 2 - bore - e, width / 2 - bore - e, -e,
                                      length / 2 + bore + e, width / 2 + bore + e, thickness - counterbore_depth + e};
bolts() = Surface In BoundingBox {inset - bolt - e, inset - bolt - e, -e,
                                  inset + bolt + e, inset + bolt + e, thickness + e};
bolts() += Surface In BoundingBox {length - inset - bolt - e, inset - bolt - e, -e,
                                   length - inset + bolt + e, inset + bolt + e, thickness + e};
bolts() += Surface In BoundingBox {length - inset - bolt - e, width - inset - bolt - e, -e,
                                   length - inset + bolt + e, width - inset + bolt + e, thickness + e};
bolts() += Surface In BoundingBox {inset - bolt - e, width - inset - bolt - e, -e,
                                   inset + bolt + e, width - inset + bolt + e, thickness + e};
bottom() = Surface In BoundingBox {-e, -e, -e, length + e, width + e, e};
top() = Surface In BoundingBox {-e, -e, thickness - e, length + e, width + e, thickness + e};
Physical Surface("bore") = {bore_wall()};
Physical Surface("bolts") = {bolts()};
Physical Surface("bottom") = {bottom()};
Physical Surface("top") = {top()};
Physical Volume("plate") = {1000};
