// L profile, 30 x 30 mm with legs of 10 mm, 20 mm long: what the built-in shape draws, from CAD. Lengths in mm.
SetFactory("OpenCASCADE");
width = 30;
thickness = 10;
length = 20;
Point(1) = {0, 0, 0};
Point(2) = {width, 0, 0};
Point(3) = {width, thickness, 0};
Point(4) = {thickness, thickness, 0};
Point(5) = {thickness, width, 0};
Point(6) = {0, width, 0};
For i In {1:6}
  Line(i) = {i, i % 6 + 1};
EndFor
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};
Extrude {0, 0, length} { Surface{1}; }
