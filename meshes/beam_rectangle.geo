// Rectangle x0 < x < x0 + L, -d/2 < y < d/2 with nx by ny equal quadrilaterals
// (ny even puts nodes on the mid line). Cantilever: L = 4, d = 1; plate in
// tension, origin at the centre: L = 1, d = 0.5, x0 = -0.5.
SetFactory("Built-in");
DefineConstant[
  L  = {4, Name "L"},   d  = {1, Name "d"},  x0 = {0, Name "x0"},
  nx = {32, Name "nx"}, ny = {8, Name "ny"}
];
Point(1) = {x0, -d/2, 0};
Point(2) = {x0 + L, -d/2, 0};
Point(3) = {x0 + L, d/2, 0};
Point(4) = {x0, d/2, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1, 3} = nx + 1;
Transfinite Curve{2, 4} = ny + 1;
Transfinite Surface{1};
Recombine Surface{1};
Physical Surface("domain", 1) = {1};
Physical Curve("left", 11) = {4};
Physical Curve("right", 12) = {2};
Physical Curve("bottom", 13) = {1};
Physical Curve("top", 14) = {3};
