// Plate (2 hx by 2 hy) with a slender elliptical hole (semi-axes a along x, b
// along y, a > b), eight mapped blocks of quadrilaterals, symmetric about both
// axes, graded towards the tips (+-a, 0): spacing dx there, along the edge and
// along the x axis.
// nt cells along each eighth of the hole edge, nr cells from the hole to the
// outside.
// Tip radius b^2/a = 0.72 for the default values.
SetFactory("Built-in");
DefineConstant[
  a  = {50, Name "a"},    b  = {6, Name "b"},
  hx = {250, Name "hx"},  hy = {250, Name "hy"},
  dx = {0.1, Name "dx"},  nt = {32, Name "nt"},  nr = {60, Name "nr"}
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

// nodes 1000 + k of the hole, 21 to 28 outside, every 45 degrees from +x
sx[] = {1, -1, -1, 1};
sy[] = {1, 1, -1, -1};
px[] = {1, 1, 0, -1, -1, -1, 0, 1};
py[] = {0, 1, 1, 1, 0, -1, -1, -1};
For k In {0:8*nt - 1}
  q = Floor(k/(2*nt));
  m = (q % 2 == 0) ? k - 2*nt*q : 2*nt*(q + 1) - k;
  Point(1000 + k) = {sx[q]*ex[m], sy[q]*ey[m], 0};
EndFor
hole[] = {};
For k In {0:8*nt - 1} // one cell each
  Line(1000 + k) = {1000 + k, 1000 + ((k == 8*nt - 1) ? 0 : k + 1)};
  Transfinite Curve{1000 + k} = 2;
  hole[] += {1000 + k};
EndFor
For i In {0:7}
  Point(21 + i) = {hx*px[i], hy*py[i], 0};
EndFor
For i In {1:8}
  j = (i == 8) ? 1 : i + 1;
  Line(200 + i) = {20 + i, 20 + j};
  Line(300 + i) = {1000 + (i - 1)*nt, 20 + i};
EndFor
For i In {1:8}
  j = (i == 8) ? 1 : i + 1;
  inner[] = {};
  For k In {1:nt}
    inner[] += {-(1000 + i*nt - k)};
  EndFor
  Curve Loop(i) = {300 + i, 200 + i, -(300 + j), inner[]};
  Plane Surface(i) = {i};
  Transfinite Curve{200 + i} = nt + 1;
  rp = (i % 2 == 0) ? rd : ((i % 4 == 1) ? rx : ry);
  Transfinite Curve{300 + i} = nr + 1 Using Progression rp;
  Transfinite Surface{i} =
    {1000 + (i - 1)*nt, 20 + i, 20 + j, 1000 + (j - 1)*nt};
  Recombine Surface{i};
EndFor
Physical Surface("domain", 1) = {1:8};
Physical Curve("left", 11) = {204, 205};
Physical Curve("right", 12) = {201, 208};
Physical Curve("bottom", 13) = {206, 207};
Physical Curve("top", 14) = {202, 203};
Physical Curve("hole", 20) = hole[];
