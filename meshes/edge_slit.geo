// Plate 0 < x < W, -H/2 < y < H/2 with a slit from (0, 0) to (a, 0), whose nodes
// but for the tip are double.  n by n cells for a = W/2, all of one size.
SetFactory("Built-in");
DefineConstant[
  W = {0.1, Name "W"}, H = {0.1, Name "H"}, a = {0.05, Name "a"},
  n = {100, Name "n"}
];
Point(1) = {0, -H/2, 0};
Point(2) = {a, -H/2, 0};
Point(3) = {W, -H/2, 0};
Point(4) = {W, 0, 0};
Point(5) = {W, H/2, 0};
Point(6) = {a, H/2, 0};
Point(7) = {0, H/2, 0};
Point(8) = {0, 0, 0};
Point(9) = {0, 0, 0};
Point(10) = {a, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {9, 1};
Line(9) = {9, 10};
Line(10) = {8, 10};
Line(11) = {2, 10};
Line(12) = {10, 6};
Line(13) = {10, 4};
Curve Loop(1) = {1, 11, -9, 8};
Curve Loop(2) = {2, 3, -13, -11};
Curve Loop(3) = {13, 4, 5, -12};
Curve Loop(4) = {10, 12, 6, 7};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};
Plane Surface(4) = {4};
Transfinite Curve{1, 6, 9, 10} = Round(n*a/W) + 1;
Transfinite Curve{2, 5, 13} = Round(n*(W - a)/W) + 1;
Transfinite Curve{3, 4, 7, 8, 11, 12} = Round(n*H/W/2) + 1;
Transfinite Surface{1:4};
Recombine Surface{1:4};
Physical Surface("domain", 1) = {1:4};
Physical Curve("left", 11) = {7, 8};
Physical Curve("right", 12) = {3, 4};
Physical Curve("bottom", 13) = {1, 2};
Physical Curve("top", 14) = {5, 6};
