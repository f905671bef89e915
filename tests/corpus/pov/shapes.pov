#version 3.7;
camera { location <0, 2, -12> look_at 0 angle 50 }
light_source { <10, 10, -10>, 1 spotlight point_at 0 radius 20 falloff 30 }
difference { box { -1, 1 } sphere { 0, 1.2 } cylinder { -2 * y, 2 * y, 0.4 } texture { pigment { bozo } } }
intersection { sphere { 0, 1 } plane { -y, 0 } sphere { 0.5, 1 inverse } translate 3 * x }
blob { threshold 0.6 sphere { 0, 1, 1 } cylinder { 0, x, 0.5, 1 } }
lathe { cubic_spline 5, <1, -1>, <1, 0>, <0.5, 1>, <1, 2>, <1, 3> }
prism { linear_sweep linear_spline 0, 1, 5, <0, 0>, <1, 0>, <1, 1>, <0, 1>, <0, 0> }
sor { 4, <0.5, -1>, <1, 0>, <0.5, 1>, <0, 1.5> }
sphere_sweep { b_spline 4, 0, 0.2, x, 0.3, x + y, 0.2, y, 0.1 }
superellipsoid { <0.3, 0.3> }
quadric { <1, 1, 1>, 0, 0, -1 clipped_by { box { -2, 2 } } }
quartic { <1, 0, 0, 0, 2, 0, 0, 2, 0, -2.5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, -2.5, 0, 0, 0, 0, 1, 0, -2.5, 0, 0.6> }
isosurface { function { x * x + y * y + z * z - 1 } contained_by { box { -1.2, 1.2 } } max_gradient 3 }
julia_fractal { <-0.1, 0.8, 0, 0> quaternion sqr max_iteration 6 slice <0, 0, 0, 1>, 0 }
bicubic_patch { type 1 flatness 0.01
  <0, 0, 0> <1, 0, 0> <2, 0, 0> <3, 0, 0> <0, 1, 0> <1, 1, 1> <2, 1, 1> <3, 1, 0>
  <0, 2, 0> <1, 2, 1> <2, 2, 1> <3, 2, 0> <0, 3, 0> <1, 3, 0> <2, 3, 0> <3, 3, 0> }
polygon { 5, <0, 0>, <1, 0>, <1, 1>, <0, 1>, <0, 0> }
mesh { triangle { 0, x, y } smooth_triangle { 0, z, x, z, y, z } }
mesh2 { vertex_vectors { 4, 0, x, y, z } face_indices { 2, <0, 1, 2>, <0, 2, 3> } }
disc { 0, y, 2, 1 }
