// Strip (2 l long in x, 2 w wide in y) with a central circular hole of radius
// r: eight mapped blocks around the hole out to the square -w < x, y < w and
// two blocks on either side from there to the ends; symmetric about both axes.
// nt cells along each eighth of the hole edge, nr radial cells (the first as
// long as the cells of the edge), ne cells along each plain end part.
SetFactory("Built-in");
DefineConstant[
  l  = {75, Name "l"},   w  = {25, Name "w"},   r  = {10, Name "r"},
  nt = {16, Name "nt"},  nr = {20, Name "nr"},  ne = {20, Name "ne"}
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
first = w/nt; // end parts: cells grow from those of the square
length = l - w;
cells = ne;
Call GeometricRatio;
re = ratio;

// points 11 to 18 on the hole, 21 to 28 on the square, every 45 degrees from +x
px[] = {1, 1, 0, -1, -1, -1, 0, 1};
py[] = {0, 1, 1, 1, 0, -1, -1, -1};
Point(1) = {0, 0, 0};
For i In {0:7}
  s = (i % 2 == 0) ? 1 : c;
  Point(11 + i) = {r*s*px[i], r*s*py[i], 0};
  Point(21 + i) = {w*px[i], w*py[i], 0};
EndFor
For i In {1:8}
  j = (i == 8) ? 1 : i + 1;
  Circle(100 + i) = {10 + i, 1, 10 + j};
  Line(200 + i) = {20 + i, 20 + j};
  Line(300 + i) = {10 + i, 20 + i};
EndFor
For i In {1:8}
  j = (i == 8) ? 1 : i + 1;
  Curve Loop(i) = {300 + i, 200 + i, -(300 + j), -(100 + i)};
  Plane Surface(i) = {i};
  Transfinite Curve{100 + i, 200 + i} = nt + 1;
  rp = (i % 2 == 0) ? rd : ra;
  Transfinite Curve{300 + i} = nr + 1 Using Progression rp;
  Transfinite Surface{i} = {10 + i, 20 + i, 20 + j, 10 + j};
  Recombine Surface{i};
EndFor
// end parts: points 31, 32, 38 at x = l beside 21, 22, 28; 34 to 36 at x = -l
ends[] = {1, 2, 8, 4, 5, 6};
For k In {0:5}
  i = ends[k];
  side = (k < 3) ? 1 : -1;
  Point(30 + i) = {side*l, w*py[i - 1], 0};
  Line(400 + i) = {20 + i, 30 + i};
  Transfinite Curve{400 + i} = ne + 1 Using Progression re;
EndFor
Line(501) = {31, 32};
Line(508) = {38, 31};
Line(504) = {34, 35};
Line(505) = {35, 36};
Transfinite Curve{501, 508, 504, 505} = nt + 1;
Curve Loop(11) = {401, 501, -402, -201};
Curve Loop(12) = {408, 508, -401, -208};
Curve Loop(13) = {404, 504, -405, -204};
Curve Loop(14) = {405, 505, -406, -205};
For k In {11:14}
  Plane Surface(k) = {k};
EndFor
Transfinite Surface{11:14};
Recombine Surface{11:14};
Physical Surface("domain", 1) = {1:8, 11:14};
Physical Curve("left", 11) = {504, 505};
Physical Curve("right", 12) = {501, 508};
Physical Curve("bottom", 13) = {206, 207, 406, 408};
Physical Curve("top", 14) = {202, 203, 402, 404};
Physical Curve("hole", 20) = {101:108};
