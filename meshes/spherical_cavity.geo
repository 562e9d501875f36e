// One eighth of a cube (half width h) with a spherical cavity of radius r0 at
// the origin: three mapped blocks of hexahedra (a cubed sphere), faces
// symmetry_x (x = 0), symmetry_y, symmetry_z, outer (the cube), cavity.
// n cells along each quarter circle of the cavity (n even, n/2 per block
// edge), nr radial cells.
// pr = 0: the first radial cell is as long as the cells of the quarter circle;
// any other value is the ratio of neighbouring radial cells.
SetFactory("Built-in");
DefineConstant[
  r0 = {1, Name "r0"},   h  = {4, Name "h"},
  n  = {16, Name "n"},   nr = {17, Name "nr"},  pr = {0, Name "pr"}
];
Macro GeometricRatio // first cell, length, cells -> ratio of neighbouring cells
  low = 0.3;
  high = 3;
  For k In {1:60}
    ratio = 0.5*(low + high);
    If (Fabs(ratio - 1) < 1e-12)
      total = first*cells;
    Else
      total = first*(ratio^cells - 1)/(ratio - 1);
    EndIf
    If (total < length)
      low = ratio;
    Else
      high = ratio;
    EndIf
  EndFor
Return
first = Pi*r0/2/n;
cells = nr;
For q In {1:3} // along an axis, a face diagonal, the space diagonal
  length = Sqrt(q)*h - r0;
  Call GeometricRatio;
  rp~{q} = (pr > 0) ? pr : ratio;
EndFor

// points 11 to 17 on the sphere, 21 to 27 on the cube, in the directions below
px[] = {1, 0, 0, 0, 1, 1, 1};
py[] = {0, 1, 0, 1, 0, 1, 1};
pz[] = {0, 0, 1, 1, 1, 0, 1};
Point(1) = {0, 0, 0};
For i In {0:6}
  q = px[i] + py[i] + pz[i];
  s = r0/Sqrt(q);
  Point(11 + i) = {s*px[i], s*py[i], s*pz[i]};
  Point(21 + i) = {h*px[i], h*py[i], h*pz[i]};
  Line(101 + i) = {11 + i, 21 + i};
  Transfinite Curve{101 + i} = nr + 1 Using Progression rp~{q};
EndFor
// edges of the blocks: each axis to its two face diagonals, those to the corner
from[] = {1, 1, 2, 2, 3, 3, 4, 5, 6};
to[]   = {6, 5, 6, 4, 4, 5, 7, 7, 7};
For k In {0:8}
  Circle(201 + k) = {10 + from[k], 1, 10 + to[k]};
  Line(301 + k) = {20 + from[k], 20 + to[k]};
  Transfinite Curve{201 + k, 301 + k} = n/2 + 1;
  Curve Loop(401 + k) = {100 + from[k], 301 + k, -(100 + to[k]), -(201 + k)};
  Plane Surface(401 + k) = {401 + k};
EndFor
// faces on the sphere and on the cube, block by block: x, y, z
Curve Loop(501) = {201, 209, -208, -202};
Curve Loop(502) = {204, 207, -209, -203};
Curve Loop(503) = {206, 208, -207, -205};
Curve Loop(601) = {301, 309, -308, -302};
Curve Loop(602) = {304, 307, -309, -303};
Curve Loop(603) = {306, 308, -307, -305};
For k In {1:3}
  Surface(500 + k) = {500 + k} In Sphere {1};
  Plane Surface(600 + k) = {600 + k};
EndFor
Surface Loop(1) = {501, 601, 401, 409, 408, 402};
Surface Loop(2) = {502, 602, 404, 407, 409, 403};
Surface Loop(3) = {503, 603, 406, 408, 407, 405};
For k In {1:3}
  Volume(k) = {k};
EndFor
Transfinite Surface{401:409, 501:503, 601:603};
Recombine Surface{401:409, 501:503, 601:603};
Transfinite Volume{1} = {11, 16, 17, 15, 21, 26, 27, 25};
Transfinite Volume{2} = {12, 14, 17, 16, 22, 24, 27, 26};
Transfinite Volume{3} = {13, 15, 17, 14, 23, 25, 27, 24};
Physical Volume("domain", 1) = {1, 2, 3};
Physical Surface("symmetry_x", 11) = {404, 405};
Physical Surface("symmetry_y", 12) = {402, 406};
Physical Surface("symmetry_z", 13) = {401, 403};
Physical Surface("outer", 14) = {601, 602, 603};
Physical Surface("cavity", 20) = {501, 502, 503};
