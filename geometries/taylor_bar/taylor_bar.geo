// Taylor's impact specimen: a copper cylinder of radius 3.2 mm and length 32 mm standing on z = 0. Lengths in mm.
SetFactory("OpenCASCADE");
radius = 3.2;
length = 32;
Cylinder(1) = {0, 0, 0, 0, 0, length, radius};
