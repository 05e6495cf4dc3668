// Plane billet of 8 x 56 mm, standing at the entry of the die of die.geo. Lengths in mm.
SetFactory("OpenCASCADE");
width = 8;
length = 56;
Point(1) = {0, 0, 0};
Point(2) = {width, 0, 0};
Point(3) = {width, length, 0};
Point(4) = {0, length, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Curve("front") = {1};
Physical Curve("right") = {2};
Physical Curve("pushed") = {3};
Physical Curve("left") = {4};
Physical Surface("billet") = {1};
