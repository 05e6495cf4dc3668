// Block of 20 x 10 x 12 mm standing on z = 0 with a slot of 0.5 mm, sawn 8 mm deep from above in its middle. Lengths in mm.
SetFactory("OpenCASCADE");
length = 20;
depth = 10;
height = 12;
slot = 0.5;
sawn = 8;
left = (length - slot) / 2;
Box(1) = {0, 0, 0, length, depth, height};
Box(2) = {left, -1, height - sawn, slot, depth + 2, sawn + 1};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

e = 1e-3;
base() = Surface In BoundingBox {-e, -e, -e, length + e, depth + e, e};
slot_left() = Surface In BoundingBox {left - e, -e, height - sawn - e, left + e, depth + e, height + e};
slot_right() = Surface In BoundingBox {left + slot - e, -e, height - sawn - e, left + slot + e, depth + e, height + e};
Physical Surface("base") = {base()};
Physical Surface("slot_left") = {slot_left()};
Physical Surface("slot_right") = {slot_right()};
Physical Volume("block") = {3};
