// Channel of an angular extrusion die with two turns of 90 degrees, all of it 8 mm wide: down the entry, to the right
// through the middle channel, down the exit. The entry takes the billet of billet.geo. Lengths in mm.
SetFactory("OpenCASCADE");
width = 8;
entry = 56;            // length of the entry above the first turn
middle = 24;           // from the centre line of the entry to that of the exit
outlet = 40;           // length of the exit below the second turn
outer = 1.5;           // radius of the fillet on the outside of a turn
inner = 1;             // and on its inside

Point(1) = {0, entry, 0};
Point(2) = {0, -width + outer, 0};
Point(3) = {outer, -width + outer, 0};
Point(4) = {outer, -width, 0};
Point(5) = {middle - inner, -width, 0};
Point(6) = {middle - inner, -width - inner, 0};
Point(7) = {middle, -width - inner, 0};
Point(8) = {middle, -width - outlet, 0};
Point(9) = {middle + width, -width - outlet, 0};
Point(10) = {middle + width, -outer, 0};
Point(11) = {middle + width - outer, -outer, 0};
Point(12) = {middle + width - outer, 0, 0};
Point(13) = {width + inner, 0, 0};
Point(14) = {width + inner, inner, 0};
Point(15) = {width, inner, 0};
Point(16) = {width, entry, 0};
Line(1) = {1, 2};
Circle(2) = {2, 3, 4};
Line(3) = {4, 5};
Circle(4) = {5, 6, 7};
Line(5) = {7, 8};
Line(6) = {8, 9};
Line(7) = {9, 10};
Circle(8) = {10, 11, 12};
Line(9) = {12, 13};
Circle(10) = {13, 14, 15};
Line(11) = {15, 16};
Line(12) = {16, 1};
Curve Loop(1) = {1:12};
Plane Surface(1) = {1};
Physical Curve("entry") = {12};
Physical Curve("exit") = {6};
Physical Curve("outside_of_first_turn") = {2};
Physical Curve("inside_of_first_turn") = {10};
Physical Curve("outside_of_second_turn") = {8};
Physical Curve("inside_of_second_turn") = {4};
Physical Surface("channel") = {1};
