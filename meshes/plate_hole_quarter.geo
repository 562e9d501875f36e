// Quarter of a plate with a central circular or elliptical hole (semi-axes a
// along x, b along y; plate 2 hx by 2 hy), two mapped blocks of
// quadrilaterals.
// Symmetry lines: left (x = 0) and bottom (y = 0).
// nt cells along each half of the hole edge, nr cells from the hole to the
// outside.
// pr = 0: the first radial cell is as long as the cells of the hole edge; any
// other value is the ratio of neighbouring radial cells.
SetFactory("Built-in");
DefineConstant[
  a  = {2.5, Name "a"},  b  = {2.5, Name "b"},
  hx = {25, Name "hx"},  hy = {25, Name "hy"},
  nt = {24, Name "nt"},  nr = {48, Name "nr"},  pr = {0, Name "pr"}
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
first = Pi*(a + b)/8/nt;
cells = nr;
length = hx - a;
Call GeometricRatio;
rx = (pr > 0) ? pr : ratio;
length = hy - b;
Call GeometricRatio;
ry = (pr > 0) ? pr : ratio;
length = Sqrt((hx - c*a)^2 + (hy - c*b)^2);
Call GeometricRatio;
rd = (pr > 0) ? pr : ratio;

Point(1) = {0, 0, 0};
Point(2) = {a, 0, 0};
Point(3) = {a*c, b*c, 0};
Point(4) = {0, b, 0};
Point(5) = {hx, 0, 0};
Point(6) = {hx, hy, 0};
Point(7) = {0, hy, 0};
major = (a >= b) ? 2 : 4;
Ellipse(1) = {2, 1, major, 3};
Ellipse(2) = {3, 1, major, 4};
Line(3) = {2, 5};
Line(4) = {5, 6};
Line(5) = {6, 7};
Line(6) = {4, 7};
Line(7) = {3, 6};
Curve Loop(1) = {3, 4, -7, -1};
Plane Surface(1) = {1};
Curve Loop(2) = {7, 5, -6, -2};
Plane Surface(2) = {2};
Transfinite Curve{1, 2, 4, 5} = nt + 1;
Transfinite Curve{3} = nr + 1 Using Progression rx;
Transfinite Curve{6} = nr + 1 Using Progression ry;
Transfinite Curve{7} = nr + 1 Using Progression rd;
Transfinite Surface{1} = {2, 5, 6, 3};
Transfinite Surface{2} = {3, 6, 7, 4};
Recombine Surface{1, 2};
Physical Surface("domain", 1) = {1, 2};
Physical Curve("left", 11) = {6};
Physical Curve("right", 12) = {4};
Physical Curve("bottom", 13) = {3};
Physical Curve("top", 14) = {5};
Physical Curve("hole", 20) = {1, 2};
