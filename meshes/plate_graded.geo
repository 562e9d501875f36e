// Rectangle -hx < x < hx, -hy < y < hy: equal cells in a box in its middle,
// |x| < fx, |y| < fy, with nx by ny of them (ny odd: no grid line on y = 0), and
// cells that grow by the factor q from there to the sides.  For cracks, which
// are not meshed.
SetFactory("Built-in");
DefineConstant[
  hx = {25, Name "hx"}, hy = {25, Name "hy"},
  fx = {7, Name "fx"},  fy = {3.0625, Name "fy"},
  nx = {56, Name "nx"}, ny = {49, Name "ny"}, q = {1.1, Name "q"}
];
// Cells beside the box: the first is as long as those of the box, about.
mx = Ceil(Log(1 + (hx - fx)*(q - 1)*nx/(2*fx))/Log(q));
my = Ceil(Log(1 + (hy - fy)*(q - 1)*ny/(2*fy))/Log(q));
xs[] = {-hx, -fx, fx, hx};
ys[] = {-hy, -fy, fy, hy};
For j In {0:3}
  For i In {0:3}
    Point(1 + i + 4*j) = {xs[i], ys[j], 0};
  EndFor
EndFor
For j In {0:3}
  For i In {0:2}
    Line(100 + i + 3*j) = {1 + i + 4*j, 2 + i + 4*j};
    Line(200 + j + 4*i) = {1 + j + 4*i, 5 + j + 4*i};
  EndFor
EndFor
For j In {0:3}
  Transfinite Curve{100 + 3*j} = mx + 1 Using Progression 1/q;
  Transfinite Curve{101 + 3*j} = nx + 1;
  Transfinite Curve{102 + 3*j} = mx + 1 Using Progression q;
  Transfinite Curve{200 + j} = my + 1 Using Progression 1/q;
  Transfinite Curve{204 + j} = ny + 1;
  Transfinite Curve{208 + j} = my + 1 Using Progression q;
EndFor
For j In {0:2}
  For i In {0:2}
    s = 1 + i + 3*j;
    Curve Loop(s) = {100 + i + 3*j, 201 + i + 4*j, -(103 + i + 3*j),
                     -(200 + i + 4*j)};
    Plane Surface(s) = {s};
    Transfinite Surface{s};
    Recombine Surface{s};
  EndFor
EndFor
Physical Surface("domain", 1) = {1:9};
Physical Curve("left", 11) = {200, 204, 208};
Physical Curve("right", 12) = {203, 207, 211};
Physical Curve("bottom", 13) = {100, 101, 102};
Physical Curve("top", 14) = {109, 110, 111};
