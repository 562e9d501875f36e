// Box of hexahedra around the origin, half widths H: cells of size h where
// |x|, |y| < core and |z| < core_z, growing by the factor g beyond. The number
// of cells across z = 0 is odd: the plane z = 0 lies between nodes.
SetFactory("Built-in");
DefineConstant[
  H    = {6, Name "H"},      h      = {0.2, Name "h"},
  core = {1.6, Name "core"}, core_z = {0.8, Name "core_z"},
  g    = {1.5, Name "g"}
];

// Layers of an axis: ones, and cumulative fractions of the length 2 H. The outer
// cells are stretched to end at H.
Macro Axis
  d = h; outer[] = {}; length = 0;
  For k In {1 : 1000}
    If (length < H - half)
      d = d * g; length = length + d; outer[] += {length};
    EndIf
  EndFor
  stretch = (H - half) / length;
  ones[] = {}; ends[] = {};
  m = #outer[];
  For k In {1 : m - 1}
    ones[] += {1}; ends[] += {(H - half - stretch * outer[m - 1 - k]) / (2 * H)};
  EndFor
  ones[] += {1}; ends[] += {(H - half) / (2 * H)};
  For k In {1 : n}
    ones[] += {1}; ends[] += {(H - half + 2 * half * k / n) / (2 * H)};
  EndFor
  For k In {1 : m}
    ones[] += {1}; ends[] += {(H + half + stretch * outer[k - 1]) / (2 * H)};
  EndFor
Return

n = Round(2 * core / h); half = n * h / 2;
Call Axis;
Point(1) = {-H, -H, -H};
l[] = Extrude{2 * H, 0, 0}{ Point{1}; Layers{ones[], ends[]}; };
s[] = Extrude{0, 2 * H, 0}{ Line{l[1]}; Layers{ones[], ends[]}; Recombine; };
n = 2 * Floor(core_z / h) + 1; half = n * h / 2;
Call Axis;
v[] = Extrude{0, 0, 2 * H}{ Surface{s[1]}; Layers{ones[], ends[]}; Recombine; };
Physical Volume("domain", 1) = {v[1]};
Physical Surface("bottom", 13) = {s[1]};
Physical Surface("top", 14) = {v[0]};
