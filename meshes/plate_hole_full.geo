// Plate with a central circular or elliptical hole (semi-axes a along x, b
// along y; plate 2 hx by 2 hy), eight mapped blocks of quadrilaterals,
// symmetric about both axes.
// nt cells along each eighth of the hole edge, nr cells from the hole to the
// outside.
// pr = 0: the first radial cell is as long as the cells of the hole edge; any
// other value is the ratio of neighbouring radial cells.
SetFactory("Built-in");
DefineConstant[
  a  = {2.5, Name "a"},  b  = {2.5, Name "b"},
  hx = {25, Name "hx"},  hy = {25, Name "hy"},
  nt = {12, Name "nt"},  nr = {28, Name "nr"},  pr = {0, Name "pr"}
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

// points 11 to 18 on the hole, 21 to 28 outside, every 45 degrees from +x
px[] = {1, 1, 0, -1, -1, -1, 0, 1};
py[] = {0, 1, 1, 1, 0, -1, -1, -1};
Point(1) = {0, 0, 0};
For i In {0:7}
  s = (i % 2 == 0) ? 1 : c;
  Point(11 + i) = {a*s*px[i], b*s*py[i], 0};
  Point(21 + i) = {hx*px[i], hy*py[i], 0};
EndFor
major = (a >= b) ? 11 : 13;
For i In {1:8}
  j = (i == 8) ? 1 : i + 1;
  Ellipse(100 + i) = {10 + i, 1, major, 10 + j};
  Line(200 + i) = {20 + i, 20 + j};
  Line(300 + i) = {10 + i, 20 + i};
EndFor
For i In {1:8}
  j = (i == 8) ? 1 : i + 1;
  Curve Loop(i) = {300 + i, 200 + i, -(300 + j), -(100 + i)};
  Plane Surface(i) = {i};
  Transfinite Curve{100 + i, 200 + i} = nt + 1;
  rp = (i % 2 == 0) ? rd : ((i % 4 == 1) ? rx : ry);
  Transfinite Curve{300 + i} = nr + 1 Using Progression rp;
  Transfinite Surface{i} = {10 + i, 20 + i, 20 + j, 10 + j};
  Recombine Surface{i};
EndFor
Physical Surface("domain", 1) = {1:8};
Physical Curve("left", 11) = {204, 205};
Physical Curve("right", 12) = {201, 208};
Physical Curve("bottom", 13) = {206, 207};
Physical Curve("top", 14) = {202, 203};
Physical Curve("hole", 20) = {101:108};
