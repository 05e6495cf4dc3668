// Spur gear of module 3 mm with 14 involute teeth, pressure angle 20 degrees, 12 mm wide, with bore and keyway. Its axis
// is z, it stands on z = 0. Lengths in mm.
SetFactory("OpenCASCADE");
teeth = 14;
module = 3;
pressure = 20 * Pi / 180;
width = 12;
bore = 8;              // radius
key = 5;               // width of the keyway
key_reach = 10.3;      // from the axis to the keyway's ground
pitch = module * teeth / 2;
base = pitch * Cos(pressure);
tip = pitch + module;
root = pitch - 1.25 * module;
half = Pi / (2 * teeth) + Tan(pressure) - pressure; // half a tooth's angle on the base circle
steps = 4;             // pieces of a flank between its points

Point(1) = {0, 0, 0};
For t In {0 : teeth - 1}
  o = 100 * (t + 1);
  middle = 2 * Pi * t / teeth;
  For k In {0 : steps}
    r = base + (tip - base) * k / steps;
    a = Acos(base / r);
    s = half - (Tan(a) - a);
    Point(o + k) = {r * Cos(middle - s), r * Sin(middle - s), 0};
    Point(o + 10 + k) = {r * Cos(middle + s), r * Sin(middle + s), 0};
  EndFor
  Point(o + 20) = {root * Cos(middle - half), root * Sin(middle - half), 0};
  Point(o + 21) = {root * Cos(middle + half), root * Sin(middle + half), 0};
EndFor
outline() = {};
For t In {0 : teeth - 1}
  o = 100 * (t + 1);
  n = t + 1 < teeth ? o + 100 : 100;
  Line(o) = {o + 20, o};
  Spline(o + 1) = {o : o + steps};
  Circle(o + 2) = {o + steps, 1, o + 10 + steps};
  Spline(o + 3) = {o + 10 + steps : o + 10 : -1};
  Line(o + 4) = {o + 10, o + 21};
  Circle(o + 5) = {o + 21, 1, n + 20};
  outline() += {o, o + 1, o + 2, o + 3, o + 4, o + 5};
EndFor
Curve Loop(1) = {outline()};
Plane Surface(1) = {1};
body[] = Extrude {0, 0, width} { Surface{1}; };
Cylinder(101) = {0, 0, -1, 0, 0, width + 2, bore};
Box(102) = {-key / 2, 0, -1, key, key_reach, width + 2};
BooleanDifference(1000) = { Volume{body[1]}; Delete; }{ Volume{101, 102}; Delete; };

e = 1e-3;
seat() = Surface In BoundingBox {-bore - e, -bore - e, -e, bore + e, key_reach + e, width + e};
Physical Surface("seat") = {seat()};
Physical Volume("gear") = {1000};
