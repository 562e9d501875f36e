// Quarter of a plate with a central circular hole of radius a (plate 2 hx by
// 2 hy), an unstructured mesh of quadrilaterals of one size h, hc at the hole:
// coarse, for local refinement.
// Symmetry lines: left (x = 0) and bottom (y = 0).
SetFactory("Built-in");
DefineConstant[
  a  = {2.5, Name "a"},  hx = {25, Name "hx"},  hy = {25, Name "hy"},
  h  = {2.5, Name "h"},  hc = {1, Name "hc"}
];
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 3;
Point(1) = {0, 0, 0, h};
Point(2) = {a, 0, 0, hc};
Point(3) = {hx, 0, 0, h};
Point(4) = {hx, hy, 0, h};
Point(5) = {0, hy, 0, h};
Point(6) = {0, a, 0, hc};
Line(1) = {2, 3};
Line(2) = {3, 4};
Line(3) = {4, 5};
Line(4) = {5, 6};
Circle(5) = {6, 1, 2};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Recombine Surface{1};
Physical Surface("domain", 1) = {1};
Physical Curve("left", 11) = {4};
Physical Curve("right", 12) = {2};
Physical Curve("bottom", 13) = {1};
Physical Curve("top", 14) = {3};
Physical Curve("hole", 20) = {5};
