// Plate 0 < x < w, -h < y < h with an edge crack from (0, 0) to (a, 0), a round
// inclusion above and a round hole below, of radius r, b from its middle.  Equal
// cells of size dx in a box around the crack, from there unstructured ones that
// grow to the size lc.  slit = 1: a slit along the crack, whose nodes but for the
// tip are double; else nodes lie along it.
SetFactory("Built-in");
DefineConstant[
  w = {0.02, Name "w"},         h = {0.02, Name "h"},
  a = {0.004, Name "a"},        r = {0.0045, Name "r"},  b = {0.008, Name "b"},
  dx = {0.0001, Name "dx"},   lc = {0.0004, Name "lc"},
  slit = {0, Name "slit"}
];
f = a/2; // half height of the box, whose length is 2 a
na = 2*Round(a/dx/2);
nf = 2*Round(f/dx/2);
Point(1) = {0, -h, 0, lc};
Point(2) = {w, -h, 0, lc};
Point(3) = {w, h, 0, lc};
Point(4) = {0, h, 0, lc};
For j In {0:2}
  For i In {0:2}
    Point(5 + i + 3*j) = {i*a, (j - 1)*f, 0, dx};
  EndFor
EndFor
If (slit)
  Point(14) = {0, 0, 0, dx};
EndIf
upper = slit ? 14 : 8;
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 11};
Line(5) = {11, upper};
Line(6) = {8, 5};
Line(7) = {5, 1};
Line(8) = {5, 6};
Line(9) = {6, 7};
Line(10) = {7, 10};
Line(11) = {10, 13};
Line(12) = {13, 12};
Line(13) = {12, 11};
Line(14) = {8, 9};
Line(15) = {9, 10};
Line(16) = {6, 9};
Line(17) = {9, 12};
above = 14;
If (slit)
  Line(18) = {14, 9};
  above = 18;
EndIf
Transfinite Curve{8, 9, 12, 13, 14, 15, above} = na + 1;
Transfinite Curve{5, 6, 10, 11, 16, 17} = nf + 1;
Curve Loop(1) = {8, 16, -14, 6};
Curve Loop(2) = {9, 10, -15, -16};
Curve Loop(3) = {15, 11, 12, -17};
Curve Loop(4) = {above, 17, 13, 5};
For k In {1:4}
  Plane Surface(k) = {k};
  Transfinite Surface{k};
EndFor
For k In {0:1}
  y = (1 - 2*k)*b;
  p = 20 + 10*k;
  Point(p) = {w/2, y, 0};
  Point(p + 1) = {w/2 + r, y, 0, lc};
  Point(p + 2) = {w/2, y + r, 0, lc};
  Point(p + 3) = {w/2 - r, y, 0, lc};
  Point(p + 4) = {w/2, y - r, 0, lc};
  Circle(p + 1) = {p + 1, p, p + 2};
  Circle(p + 2) = {p + 2, p, p + 3};
  Circle(p + 3) = {p + 3, p, p + 4};
  Circle(p + 4) = {p + 4, p, p + 1};
  Curve Loop(p) = {p + 1:p + 4};
EndFor
Curve Loop(5) = {1, 2, 3, 4, -13, -12, -11, -10, -9, -8, 7};
Plane Surface(5) = {5, 20, 30};
Plane Surface(6) = {20};
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 3;
Recombine Surface{1:6};
Physical Surface("domain", 1) = {1:5};
Physical Surface("inclusion", 2) = {6};
Physical Curve("left", 11) = {4:7};
Physical Curve("right", 12) = {2};
Physical Curve("bottom", 13) = {1};
Physical Curve("top", 14) = {3};
Physical Curve("hole", 20) = {31:34};
Physical Curve("interface", 22) = {21:24};
If (slit)
  Physical Curve("slit", 15) = {14, 18};
EndIf
