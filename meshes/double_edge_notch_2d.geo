// Double edge notched bar, quarter model: half width w, half length l, notches
// of depth dn with a semicircular root of radius rho (dn >= rho). The root is
// at (w - dn, 0).
// Symmetry lines: left (x = 0) and bottom (y = 0).
// nn cells along each half of the notch arc, nr cells from there inwards, nl
// cells along the plain end part.
// pr = 0: the first cell at the notch is as long as the cells of the arc; any
// other value is the ratio of neighbouring cells.
SetFactory("Built-in");
DefineConstant[
  w  = {30, Name "w"},    l   = {60, Name "l"},
  dn = {7.5, Name "dn"},  rho = {7.5, Name "rho"},
  nn = {16, Name "nn"},   nr  = {24, Name "nr"},
  nl = {10, Name "nl"},   pr  = {0, Name "pr"}
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
c = Sqrt(0.5);
xr = w - dn;  // notch root
xc = xr + rho; // centre of the notch arc
first = Pi*rho/4/nn;
cells = nr;
length = xr;
Call GeometricRatio;
ra = (pr > 0) ? pr : ratio;
length = Sqrt((xc - rho*c)^2 + (l/2 - rho*c)^2);
Call GeometricRatio;
rd = (pr > 0) ? pr : ratio;
length = l/2 - rho;
Call GeometricRatio;
rb = (pr > 0) ? pr : ratio;

Point(1) = {0, 0, 0};
Point(2) = {xr, 0, 0};
Point(3) = {xc, 0, 0};
Point(4) = {xc - rho*c, rho*c, 0};
Point(5) = {xc, rho, 0};
Point(6) = {0, l/2, 0};
Point(7) = {xc, l/2, 0};
Point(8) = {0, l, 0};
Point(9) = {xc, l, 0};
Circle(1) = {2, 3, 4};
Circle(2) = {4, 3, 5};
Line(3) = {2, 1};
Line(4) = {1, 6};
Line(5) = {4, 6};
Line(6) = {7, 6};
Line(7) = {5, 7};
Line(8) = {6, 8};
Line(9) = {7, 9};
Line(10) = {9, 8};
Curve Loop(1) = {1, 5, -4, -3};
Plane Surface(1) = {1};
Curve Loop(2) = {2, 7, 6, -5};
Plane Surface(2) = {2};
Curve Loop(3) = {-6, 9, 10, -8};
Plane Surface(3) = {3};
Transfinite Curve{1, 2, 4, 6, 10} = nn + 1;
Transfinite Curve{3} = nr + 1 Using Progression ra;
Transfinite Curve{5} = nr + 1 Using Progression rd;
Transfinite Curve{7} = nr + 1 Using Progression rb;
Transfinite Curve{8, 9} = nl + 1;
Transfinite Surface{1} = {2, 1, 6, 4};
Transfinite Surface{2} = {4, 6, 7, 5};
Transfinite Surface{3} = {6, 8, 9, 7};
domain[] = {1, 2, 3};
top[] = {10};
right[] = {7, 9};
notch[] = {1, 2};
If (dn > rho*1.0001) // straight flank of the notch, then the outer side
  Point(10) = {w, rho, 0};
  Point(11) = {w, l/2, 0};
  Point(12) = {w, l, 0};
  Line(11) = {5, 10};
  Line(12) = {10, 11};
  Line(13) = {7, 11};
  Line(14) = {11, 12};
  Line(15) = {9, 12};
  Curve Loop(4) = {11, 12, -13, -7};
  Plane Surface(4) = {4};
  Curve Loop(5) = {13, 14, -15, -9};
  Plane Surface(5) = {5};
  ns = Ceil(nn*(dn - rho)/rho);
  ns = (ns < 2) ? 2 : ns;
  Transfinite Curve{11, 13, 15} = ns + 1;
  Transfinite Curve{12} = nr + 1 Using Progression rb;
  Transfinite Curve{14} = nl + 1;
  Transfinite Surface{4} = {5, 10, 11, 7};
  Transfinite Surface{5} = {7, 11, 12, 9};
  domain[] = {1:5};
  top[] = {10, 15};
  right[] = {12, 14};
  notch[] = {1, 2, 11};
EndIf
Recombine Surface{domain[]};
Physical Surface("domain", 1) = domain[];
Physical Curve("left", 11) = {4, 8};
Physical Curve("right", 12) = right[];
Physical Curve("bottom", 13) = {3};
Physical Curve("top", 14) = top[];
Physical Curve("notch", 21) = notch[];
