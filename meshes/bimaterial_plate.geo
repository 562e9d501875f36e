// Plate -L/2 < x < L/2, -d/2 < y < d/2 of two layers that meet at y = 0, the upper one
// a volume of its own, with nx by ny (even) equal quadrilaterals.  slit: length of a slit
// along the interface from the left, whose nodes but for the tip are double; 0: none.
SetFactory("Built-in");
DefineConstant[
  L  = {0.15, Name "L"},  d  = {0.0375, Name "d"},  slit = {0.03, Name "slit"},
  nx = {200, Name "nx"},  ny = {50, Name "ny"}
];
Point(1) = {-L/2, -d/2, 0};
Point(2) = {L/2, -d/2, 0};
Point(3) = {L/2, 0, 0};
Point(4) = {L/2, d/2, 0};
Point(5) = {-L/2, d/2, 0};
Point(6) = {-L/2, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
If (slit > 0)
  ns = Round(nx*slit/L);
  Point(7) = {-L/2, 0, 0};
  Point(8) = {-L/2 + slit, 0, 0};
  Line(5) = {5, 7};
  Line(6) = {6, 1};
  Line(7) = {8, 3};
  Line(8) = {6, 8};
  Line(9) = {7, 8};
  Transfinite Curve{8, 9} = ns + 1;
  Transfinite Curve{7} = nx - ns + 1;
  Curve Loop(1) = {1, 2, -7, -8, 6};
  Curve Loop(2) = {9, 7, 3, 4, 5};
Else
  Line(5) = {5, 6};
  Line(6) = {6, 1};
  Line(7) = {6, 3};
  Transfinite Curve{7} = nx + 1;
  Curve Loop(1) = {1, 2, -7, 6};
  Curve Loop(2) = {7, 3, 4, 5};
EndIf
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Curve{1, 4} = nx + 1;
Transfinite Curve{2, 3, 5, 6} = Round(ny/2) + 1;
corner = (slit > 0) ? 7 : 6;
Transfinite Surface{1} = {1, 2, 3, 6};
Transfinite Surface{2} = {corner, 3, 4, 5};
Recombine Surface{1, 2};
Physical Surface("domain", 1) = {1};
Physical Surface("upper", 2) = {2};
Physical Curve("left", 11) = {5, 6};
Physical Curve("right", 12) = {2, 3};
Physical Curve("bottom", 13) = {1};
Physical Curve("top", 14) = {4};
Physical Curve("interface", 22) = {7};
If (slit > 0)
  Physical Curve("slit", 15) = {8, 9};
EndIf
