// Right half 0 < x < hx, -hy < y < hy of a plate with a central circular hole of
// radius r, mapped blocks of quadrilaterals. From the hole to the right side a
// strip -w < y < w of ns (odd) rows of nx cells, so that a crack along y = 0 runs
// between nodes; above and below nt cells along each eighth of the square |x|,
// |y| < hx, and ne cells from there to the ends where hy > hx.
SetFactory("Built-in");
DefineConstant[
  hx = {25, Name "hx"}, hy = {25, Name "hy"}, r = {5, Name "r"},
  w = {2.5, Name "w"}, ns = {5, Name "ns"}, nx = {20, Name "nx"},
  nt = {8, Name "nt"}, ne = {0, Name "ne"}
];
low = Asin(w/r);
mid = 0.5*(low + Pi/2);
Point(1) = {0, 0, 0};
Point(10) = {r*Cos(low), w, 0};
Point(11) = {r*Cos(mid), r*Sin(mid), 0};
Point(12) = {0, r, 0};
Point(13) = {0, hx, 0};
Point(14) = {hx, hx, 0};
Point(15) = {hx, w, 0};
Point(20) = {r*Cos(low), -w, 0};
Point(21) = {r*Cos(mid), -r*Sin(mid), 0};
Point(22) = {0, -r, 0};
Point(23) = {0, -hx, 0};
Point(24) = {hx, -hx, 0};
Point(25) = {hx, -w, 0};
Circle(30) = {20, 1, 10};
Line(31) = {25, 15};
For k In {1:2}
  o = 10*k;
  Circle(o) = {o, 1, o + 1};
  Circle(o + 1) = {o + 1, 1, o + 2};
  Line(o + 2) = {o + 2, o + 3};
  Line(o + 3) = {o + 3, o + 4};
  Line(o + 4) = {o + 4, o + 5};
  Line(o + 5) = {o + 5, o};
  Line(o + 6) = {o + 1, o + 4};
  Curve Loop(o) = {o, o + 6, o + 4, o + 5};
  Curve Loop(o + 1) = {o + 1, o + 2, o + 3, -(o + 6)};
  Transfinite Curve{o, o + 1, o + 3, o + 4} = nt + 1;
  Transfinite Curve{o + 2, o + 5, o + 6} = nx + 1;
EndFor
Curve Loop(30) = {30, -15, -31, 25};
Transfinite Curve{30, 31} = ns + 1;
blocks[] = {10, 11, 20, 21, 30};
left[] = {12, 22};
right[] = {31, 14, 24};
top = 13;
bottom = 23;
If (ne > 0)
  For k In {1:2}
    o = 10*k;
    side = 3 - 2*k;
    Point(o + 7) = {0, side*hy, 0};
    Point(o + 8) = {hx, side*hy, 0};
    Line(o + 7) = {o + 3, o + 7};
    Line(o + 8) = {o + 7, o + 8};
    Line(o + 9) = {o + 8, o + 4};
    Curve Loop(o + 2) = {o + 7, o + 8, o + 9, -(o + 3)};
    Transfinite Curve{o + 7, o + 9} = ne + 1;
    Transfinite Curve{o + 8} = nt + 1;
    blocks[] += {o + 2};
    left[] += {o + 7};
    right[] += {o + 9};
  EndFor
  top = 18;
  bottom = 28;
EndIf
For k In {0:#blocks[] - 1}
  Plane Surface(blocks[k]) = {blocks[k]};
EndFor
Transfinite Surface{blocks[]};
Recombine Surface{blocks[]};
Physical Surface("domain", 1) = {blocks[]};
Physical Curve("left", 11) = {left[]};
Physical Curve("right", 12) = {right[]};
Physical Curve("bottom", 13) = {bottom};
Physical Curve("top", 14) = {top};
Physical Curve("hole", 20) = {10, 11, 20, 21, 30};
