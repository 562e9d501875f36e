// Unit square with an unstructured mesh of quadrilaterals only:
// Frontal-Delaunay, full-quad blossom recombination; about n cells per side,
// finer towards (1, 1).
// (Mesh.Algorithm = 8, Frontal-Delaunay for quads, crashes in gmsh 4.8.4.)
SetFactory("Built-in");
DefineConstant[ n = {24, Name "n"} ];
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 3;
size = 1/n;
Point(1) = {0, 0, 0, size};
Point(2) = {1, 0, 0, size};
Point(3) = {1, 1, 0, 0.6*size};
Point(4) = {0, 1, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Recombine Surface{1};
Physical Surface("domain", 1) = {1};
Physical Curve("left", 11) = {4};
Physical Curve("right", 12) = {2};
Physical Curve("bottom", 13) = {1};
Physical Curve("top", 14) = {3};
