// Rectangle 0 < x < L, -d/2 < y < d/2 of mapped quadrilaterals with fine cells at
// x = c below the upper side: n (odd) columns of length h, so that a crack along
// x = c runs between nodes, and rows of height h down to the depth e; from there
// cells grow by the factor q, in x up to the length l.
SetFactory("Built-in");
DefineConstant[
  L = {10, Name "L"}, d = {1, Name "d"}, c = {1, Name "c"},
  h = {0.025, Name "h"}, n = {13, Name "n"}, e = {0.3, Name "e"},
  q = {1.2, Name "q"}, l = {0.2, Name "l"}
];
f = 0.5*n*h;
ml = Ceil(Log(1 + (c - f)*(q - 1)/h)/Log(q));
mg = Ceil(Log(l/h)/Log(q));
g = h*(q^mg - 1)/(q - 1);
mb = Ceil(Log(1 + (d - e)*(q - 1)/h)/Log(q));
xs[] = {0, c - f, c + f, c + f + g, L};
ys[] = {-d/2, d/2 - e, d/2};
For j In {0:2}
  For i In {0:4}
    Point(1 + i + 5*j) = {xs[i], ys[j], 0};
  EndFor
EndFor
For j In {0:2}
  For i In {0:3}
    Line(100 + i + 4*j) = {1 + i + 5*j, 2 + i + 5*j};
  EndFor
EndFor
For i In {0:4}
  For j In {0:1}
    Line(200 + j + 2*i) = {1 + i + 5*j, 6 + i + 5*j};
  EndFor
  Transfinite Curve{200 + 2*i} = mb + 1 Using Progression 1/q;
  Transfinite Curve{201 + 2*i} = Round(e/h) + 1;
EndFor
For j In {0:2}
  Transfinite Curve{100 + 4*j} = ml + 1 Using Progression 1/q;
  Transfinite Curve{101 + 4*j} = n + 1;
  Transfinite Curve{102 + 4*j} = mg + 1 Using Progression q;
  Transfinite Curve{103 + 4*j} = Ceil((L - c - f - g)/l) + 1;
EndFor
For j In {0:1}
  For i In {0:3}
    k = 1 + i + 4*j;
    Curve Loop(k) = {100 + i + 4*j, 200 + j + 2*(i + 1), -(100 + i + 4*(j + 1)), -(200 + j + 2*i)};
    Plane Surface(k) = {k};
  EndFor
EndFor
Transfinite Surface{1:8};
Recombine Surface{1:8};
Physical Surface("domain", 1) = {1:8};
Physical Curve("left", 11) = {200, 201};
Physical Curve("right", 12) = {208, 209};
Physical Curve("bottom", 13) = {100:103};
Physical Curve("top", 14) = {108:111};
