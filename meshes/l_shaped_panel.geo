// L-shaped panel: square of side 2 b without its lower right quarter, 0 < x, y < 2 b.
// Fixed at the bottom, loaded from below on a patch of width w around x = 2 b - c.
// Unstructured quadrilaterals, fine in the box x < b + b/10, y1 < y < y2.
SetFactory("Built-in");
DefineConstant[
  b = {250, Name "b"}, c = {30, Name "c"}, w = {20, Name "w"},
  x1 = {0, Name "x1"}, y1 = {220, Name "y1"}, y2 = {360, Name "y2"},
  h = {8, Name "h"}, H = {25, Name "H"}
];
Point(1) = {0, 0, 0};
Point(2) = {b, 0, 0};
Point(3) = {b, b, 0};
Point(4) = {2*b - c - w/2, b, 0};
Point(5) = {2*b - c + w/2, b, 0};
Point(6) = {2*b, b, 0};
Point(7) = {2*b, 2*b, 0};
Point(8) = {0, 2*b, 0};
For i In {1:7}
  Line(i) = {i, i + 1};
EndFor
Line(8) = {8, 1};
Curve Loop(1) = {1:8};
Plane Surface(1) = {1};
Field[1] = Box;
Field[1].VIn = h;
Field[1].VOut = H;
Field[1].XMin = x1;
Field[1].XMax = 1.1*b;
Field[1].YMin = y1;
Field[1].YMax = y2;
Field[1].Thickness = b/2;
Background Field = 1;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 3;
Recombine Surface{1};
Physical Surface("domain", 1) = {1};
Physical Curve("bottom", 11) = {1};
Physical Curve("load", 12) = {4};
