// Quarter of a strip (2 l long in x, 2 w wide in y) with a central circular
// hole of radius r: two mapped blocks around the hole out to the square 0 < x,
// y < w, one block from there to the end.
// Symmetry lines: left (x = 0) and bottom (y = 0).
// nt cells along each half of the hole edge, nr radial cells (the first as
// long as the cells of the edge), ne cells along the plain end part.
SetFactory("Built-in");
DefineConstant[
  l  = {75, Name "l"},   w  = {25, Name "w"},   r  = {10, Name "r"},
  nt = {24, Name "nt"},  nr = {30, Name "nr"},  ne = {32, Name "ne"}
];
Macro GeometricRatio // first cell, length, cells -> ratio of neighbouring cells
  low = 0.3;
  high = 3;
  For k In {1:60}
    ratio = 0.5*(low + high);
    If (Fabs(ratio - 1) < 1e-12)
      total = first*cells;
    Else
      total = first*(ratio^cells - 1)/(ratio - 1);
    EndIf
    If (total < length)
      low = ratio;
    Else
      high = ratio;
    EndIf
  EndFor
Return
c = Sqrt(0.5);
first = Pi*r/4/nt;
cells = nr;
length = w - r;
Call GeometricRatio;
ra = ratio;
length = Sqrt(2)*w - r;
Call GeometricRatio;
rd = ratio;
first = w/nt; // end part: cells grow from those of the square
length = l - w;
cells = ne;
Call GeometricRatio;
re = ratio;

Point(1) = {0, 0, 0};
Point(2) = {r, 0, 0};
Point(3) = {r*c, r*c, 0};
Point(4) = {0, r, 0};
Point(5) = {w, 0, 0};
Point(6) = {w, w, 0};
Point(7) = {0, w, 0};
Point(8) = {l, 0, 0};
Point(9) = {l, w, 0};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Line(3) = {2, 5};
Line(4) = {5, 6};
Line(5) = {6, 7};
Line(6) = {4, 7};
Line(7) = {3, 6};
Line(8) = {5, 8};
Line(9) = {8, 9};
Line(10) = {6, 9};
Curve Loop(1) = {3, 4, -7, -1};
Plane Surface(1) = {1};
Curve Loop(2) = {7, 5, -6, -2};
Plane Surface(2) = {2};
Curve Loop(3) = {8, 9, -10, -4};
Plane Surface(3) = {3};
Transfinite Curve{1, 2, 4, 5, 9} = nt + 1;
Transfinite Curve{3, 6} = nr + 1 Using Progression ra;
Transfinite Curve{7} = nr + 1 Using Progression rd;
Transfinite Curve{8, 10} = ne + 1 Using Progression re;
Transfinite Surface{1} = {2, 5, 6, 3};
Transfinite Surface{2} = {3, 6, 7, 4};
Transfinite Surface{3} = {5, 8, 9, 6};
Recombine Surface{1, 2, 3};
Physical Surface("domain", 1) = {1, 2, 3};
Physical Curve("left", 11) = {6};
Physical Curve("right", 12) = {9};
Physical Curve("bottom", 13) = {3, 8};
Physical Curve("top", 14) = {5, 10};
Physical Curve("hole", 20) = {1, 2};
