// Angle bracket of 6 mm plate, 40 mm wide, base along x, upright along z, with a filleted inner and a rounded outer
// bend, two bolt holes through the base and one larger hole through the upright. Lengths in mm.
SetFactory("OpenCASCADE");
thickness = 6;
base = 60;
upright = 50;
width = 40;
inner = 6;            // radius of the fillet
outer = 9;            // radius of the outer round
bolt = 3.3;           // radius of the holes in the base
bore = 8;             // radius of the hole in the upright

Point(1) = {outer, 0, 0};
Point(2) = {base, 0, 0};
Point(3) = {base, 0, thickness};
Point(4) = {thickness + inner, 0, thickness};
Point(5) = {thickness + inner, 0, thickness + inner};
Point(6) = {thickness, 0, thickness + inner};
Point(7) = {thickness, 0, upright};
Point(8) = {0, 0, upright};
Point(9) = {0, 0, outer};
Point(10) = {outer, 0, outer};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Circle(4) = {4, 5, 6};
Line(5) = {6, 7};
Line(6) = {7, 8};
Line(7) = {8, 9};
Circle(8) = {9, 10, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7, 8};
Plane Surface(1) = {1};
body[] = Extrude {0, width, 0} { Surface{1}; };

Cylinder(101) = {45, 10, -1, 0, 0, thickness + 2, bolt};
Cylinder(102) = {45, 30, -1, 0, 0, thickness + 2, bolt};
Cylinder(103) = {-1, 20, 32, thickness + 2, 0, 0, bore};
BooleanDifference{ Volume{body[1]}; Delete; }{ Volume{101, 102, 103}; Delete; }
