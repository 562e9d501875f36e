// Beam -L/2 < x < L/2, 0 < y < d for bending in three points: patches of width w
// under the load (top, middle) and over the supports (bottom, a from the ends).
// Unstructured quadrilaterals, fine in the box x1 < x < x2. The notch is not
// meshed.
SetFactory("Built-in");
DefineConstant[
  L = {4.4, Name "L"}, d = {1, Name "d"}, a = {0.2, Name "a"}, w = {0.2, Name "w"},
  x1 = {-1.3, Name "x1"}, x2 = {0.3, Name "x2"},
  h = {0.03125, Name "h"}, H = {0.125, Name "H"}
];
Point(1) = {-L/2, 0, 0};
Point(2) = {-L/2 + a - w/2, 0, 0};
Point(3) = {-L/2 + a + w/2, 0, 0};
Point(4) = {L/2 - a - w/2, 0, 0};
Point(5) = {L/2 - a + w/2, 0, 0};
Point(6) = {L/2, 0, 0};
Point(7) = {L/2, d, 0};
Point(8) = {w/2, d, 0};
Point(9) = {-w/2, d, 0};
Point(10) = {-L/2, d, 0};
For i In {1:9}
  Line(i) = {i, i + 1};
EndFor
Line(10) = {10, 1};
Curve Loop(1) = {1:10};
Plane Surface(1) = {1};
Field[1] = Box;
Field[1].VIn = h;
Field[1].VOut = H;
Field[1].XMin = x1;
Field[1].XMax = x2;
Field[1].YMin = 0;
Field[1].YMax = d;
Field[1].Thickness = 0.5;
Background Field = 1;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 3;
Recombine Surface{1};
Physical Surface("domain", 1) = {1};
Physical Curve("left_support", 11) = {2};
Physical Curve("right_support", 12) = {4};
Physical Curve("load", 13) = {8};
