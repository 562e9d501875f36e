// Rectangle 0 < x < L, -d/2 < y < d/2 with unstructured quadrilaterals of size h.
SetFactory("Built-in");
DefineConstant[
  L = {1.5, Name "L"}, d = {1.03125, Name "d"}, h = {0.03125, Name "h"}
];
Point(1) = {0, -d/2, 0};
Point(2) = {L, -d/2, 0};
Point(3) = {L, d/2, 0};
Point(4) = {0, d/2, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Mesh.CharacteristicLengthMin = h;
Mesh.CharacteristicLengthMax = h;
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 3;
Recombine Surface{1};
Physical Surface("domain", 1) = {1};
Physical Curve("left", 11) = {4};
Physical Curve("right", 12) = {2};
Physical Curve("bottom", 13) = {1};
Physical Curve("top", 14) = {3};
