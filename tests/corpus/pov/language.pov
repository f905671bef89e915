#version 3.7; /* comments /* nest */ */
#declare A = 1 + 2 * 3;
#local V = <1, 2, 3> + 1;
#macro Twice(X) (2 * X) #end
#declare F = function(x, y) { x * x + y };
#declare S = spline { linear_spline 0, <0, 0, 0>, 1, <2, 4, 6> };
#declare T = array[2][2] { { 1, 2 }, { 3, 4 } };
#for (I, 1, 3)
  sphere { <I, Twice(I), F(I, 1)>, 0.5 pigment { rgb <I / 3, 0, 0> } }
#end
#switch (A) #case (7) box { 0, 1 translate S(0.5) } #break #else plane { y, T[1][0] } #end
#ifndef (Missing) torus { 1, 0.25 } #end
light_source { <10, 10, -10>, color rgb 1 }
camera { location <0, 2, -8> look_at 0 }
