// Upper half 0 < x < L, 0 < y < H of a plate with two notches from the left, which are
// not meshed: this one at y = c, between two nodes of the left side.  The boundary impact
// is the left side below it.  Unstructured quadrilaterals of size h.
SetFactory("Built-in");
DefineConstant[
  L = {0.1, Name "L"}, H = {0.1, Name "H"}, c = {0.025, Name "c"},
  h = {0.001, Name "h"}
];
Point(1) = {0, 0, 0};
Point(2) = {L, 0, 0};
Point(3) = {L, H, 0};
Point(4) = {0, H, 0};
Point(5) = {0, c + h/2, 0};
Point(6) = {0, c - h/2, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};
Mesh.CharacteristicLengthMin = h;
Mesh.CharacteristicLengthMax = h;
Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 3;
Recombine Surface{1};
Physical Surface("domain", 1) = {1};
Physical Curve("left", 11) = {4, 5};
Physical Curve("right", 12) = {2};
Physical Curve("bottom", 13) = {1};
Physical Curve("top", 14) = {3};
Physical Curve("impact", 15) = {6};
