// Quarter of a plate (2 hx by 2 hy) with a slender elliptical hole (semi-axes
// a along x, b along y, a > b), two mapped blocks of quadrilaterals graded
// towards the tip (a, 0): spacing dx there, along the edge and along the x
// axis.
// 2 nt cells along the hole edge, nr cells from the hole to the outside.
// Symmetry lines: left (x = 0) and bottom (y = 0).
// Tip radius b^2/a = 0.72 for the default values.
SetFactory("Built-in");
DefineConstant[
  a  = {50, Name "a"},    b  = {6, Name "b"},
  hx = {250, Name "hx"},  hy = {250, Name "hy"},
  dx = {0.1, Name "dx"},  nt = {40, Name "nt"},  nr = {72, Name "nr"}
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
// Nodes of the hole edge (a cos(eta), b sin(eta)): the steps of eta begin with
// dx/b at the tip and form a geometric series over the quarter.
first = dx/b;
length = Pi/2;
cells = 2*nt;
Call GeometricRatio;
ex[] = {a};
ey[] = {0};
eta = 0;
For k In {1:2*nt}
  eta += first*ratio^(k - 1);
  ex[] += {(k == 2*nt) ? 0 : a*Cos(eta)};
  ey[] += {(k == 2*nt) ? b : b*Sin(eta)};
EndFor
middle = Sqrt((ex[nt] - ex[nt - 1])^2 + (ey[nt] - ey[nt - 1])^2);
pole = Sqrt(ex[2*nt - 1]^2 + (b - ey[2*nt - 1])^2);
// Radial lines: the first cell is as long as the neighbouring cell of the edge.
cells = nr;
first = dx;
length = hx - a;
Call GeometricRatio;
rx = ratio;
first = middle;
length = Sqrt((hx - ex[nt])^2 + (hy - ey[nt])^2);
Call GeometricRatio;
rd = ratio;
first = pole;
length = hy - b;
Call GeometricRatio;
ry = ratio;

Point(5) = {hx, 0, 0};
Point(6) = {hx, hy, 0};
Point(7) = {0, hy, 0};
For k In {0:2*nt}
  Point(1000 + k) = {ex[k], ey[k], 0};
EndFor
loop1[] = {};
loop2[] = {};
hole[] = {};
For k In {1:2*nt} // one cell each
  Line(1000 + k) = {999 + k, 1000 + k};
  Transfinite Curve{1000 + k} = 2;
  hole[] += {1000 + k};
EndFor
For k In {1:nt}
  loop1[] += {-(1001 + nt - k)};
  loop2[] += {-(1001 + 2*nt - k)};
EndFor
Line(3) = {1000, 5};
Line(4) = {5, 6};
Line(5) = {6, 7};
Line(6) = {1000 + 2*nt, 7};
Line(7) = {1000 + nt, 6};
Curve Loop(1) = {3, 4, -7, loop1[]};
Plane Surface(1) = {1};
Curve Loop(2) = {7, 5, -6, loop2[]};
Plane Surface(2) = {2};
Transfinite Curve{4, 5} = nt + 1;
Transfinite Curve{3} = nr + 1 Using Progression rx;
Transfinite Curve{6} = nr + 1 Using Progression ry;
Transfinite Curve{7} = nr + 1 Using Progression rd;
Transfinite Surface{1} = {1000, 5, 6, 1000 + nt};
Transfinite Surface{2} = {1000 + nt, 6, 7, 1000 + 2*nt};
Recombine Surface{1, 2};
Physical Surface("domain", 1) = {1, 2};
Physical Curve("left", 11) = {6};
Physical Curve("right", 12) = {4};
Physical Curve("bottom", 13) = {3};
Physical Curve("top", 14) = {5};
Physical Curve("hole", 20) = hole[];
