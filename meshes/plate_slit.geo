// Plate (2 hx by 2 hy) with a slit from (-a, 0) to (a, 0), whose nodes are double:
// two lines between the same two tips.  Mapped blocks of quadrilaterals: nf
// equal cells of length dx on each side of a tip along and above and below it,
// then cells that grow to the middle of the slit and to the sides of the plate.
// All of it turned by angle [degrees] about the middle.
SetFactory("Built-in");
DefineConstant[
  a  = {1, Name "a"},      hx = {2.5, Name "hx"},  hy = {7.5, Name "hy"},
  dx = {0.025, Name "dx"}, nf = {8, Name "nf"},    q  = {1.2, Name "q"},
  angle = {0, Name "angle"}
];
c = Cos(angle*Pi/180);
s = Sin(angle*Pi/180);
f = nf*dx;
// Cells beside the fine ones: the first is longer than those by the factor q,
// about.
Macro GrowingCells // length, first -> cells
  cells = Max(1, Round(Log(1 + length*(q - 1)/(q*first))/Log(q)));
Return
first = dx;
length = a - f;
Call GrowingCells;
ni = cells;
length = hx - a - f;
Call GrowingCells;
no = cells;
length = hy - f;
Call GrowingCells;
nh = cells;
xs[] = {-hx, -a - f, -a, -a + f, 0, a - f, a, a + f, hx};
ys[] = {-hy, -f, 0, f, hy};
// ratios of neighbouring cells and their numbers; 0: equal
mx[] = {no, nf, nf, ni, ni, nf, nf, no};
rx[] = {1/q, 1, 1, q, 1/q, 1, 1, q};
my[] = {nh, nf, nf, nh};
ry[] = {1/q, 1, 1, q};
// Row 2 is y = 0; row 5 holds the upper nodes of the slit between the tips.
For j In {0:4}
  For i In {0:8}
    Point(1 + i + 9*j) = {c*xs[i] - s*ys[j], s*xs[i] + c*ys[j], 0};
  EndFor
EndFor
For i In {3:5}
  Point(46 + i) = {c*xs[i], s*xs[i], 0};
EndFor
For j In {0:4}
  For i In {0:7}
    Line(100 + i + 8*j) = {1 + i + 9*j, 2 + i + 9*j};
    Transfinite Curve{100 + i + 8*j} = mx[i] + 1 Using Progression rx[i];
  EndFor
EndFor
Line(142) = {21, 49};
Line(143) = {49, 50};
Line(144) = {50, 51};
Line(145) = {51, 25};
For i In {2:5}
  Transfinite Curve{140 + i} = mx[i] + 1 Using Progression rx[i];
EndFor
For j In {0:3}
  For i In {0:8}
    // above the slit from its upper nodes
    lower = (j == 2 && i > 2 && i < 6) ? 46 + i : 1 + i + 9*j;
    Line(200 + j + 4*i) = {lower, 10 + i + 9*j};
    Transfinite Curve{200 + j + 4*i} = my[j] + 1 Using Progression ry[j];
  EndFor
EndFor
For j In {0:3}
  For i In {0:7}
    k = 1 + i + 8*j;
    below = (j == 2 && i > 1 && i < 6) ? 140 + i : 100 + i + 8*j;
    Curve Loop(k) = {below, 204 + j + 4*i, -(108 + i + 8*j), -(200 + j + 4*i)};
    Plane Surface(k) = {k};
    Transfinite Surface{k};
    Recombine Surface{k};
  EndFor
EndFor
Physical Surface("domain", 1) = {1:32};
Physical Curve("left", 11) = {200:203};
Physical Curve("right", 12) = {232:235};
Physical Curve("bottom", 13) = {100:107};
Physical Curve("top", 14) = {132:139};
Physical Curve("slit", 15) = {118:121, 142:145};
