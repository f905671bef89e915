// What bench/textures.ray says in the courses' language: checker, marble, wood, granite and bumps, in a room of stone.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 5 adc_bailout 0 }
camera { location <0, 3.2, 9> right <0.932615, 0, 0> up <0, 0.905941, -0.221452> direction <0, -0.237453, -0.971399> }
light_source { <-6, 8, 8> rgb 0.8 }
light_source { <7, 6, 6> rgb 0.3 }

#declare Matt = finish { ambient 0 diffuse 1 }
#declare Shine = finish { ambient 0 diffuse 1 phong 0.4 phong_size 40 }
#declare Marble = pigment { marble turbulence 0.6 octaves 6
  color_map { [0 rgb <0.93, 0.9, 0.86>] [1 rgb <0.25, 0.27, 0.35>] } scale 0.5 }
#declare Black = pigment { marble turbulence 0.6 octaves 6
  color_map { [0 rgb <0.1, 0.1, 0.12>] [1 rgb <0.45, 0.45, 0.5>] } scale 0.5 }
#declare Wood = pigment { wood turbulence 0.1 octaves 6
  color_map { [0 rgb <0.8, 0.55, 0.3>] [1 rgb <0.4, 0.2, 0.08>] } scale 0.33 }
#declare Granite = pigment { granite color_map { [0 rgb 0.1] [1 rgb <0.9, 0.85, 0.8>] } }

plane { y, 0 texture { pigment { checker pigment { Marble } pigment { Black } } finish { Matt } } }
plane { z, -5 pigment { Granite } finish { Matt } }

sphere { 0, 1 pigment { Marble } finish { Shine } translate <-3.2, 1, 0> }
box { -0.5, 0.5 pigment { Marble } finish { Shine } scale 2.4 translate <2.2, 1.2, -3> }
sphere { 0, 1 pigment { Wood } finish { Shine } translate <-1.05, 1, 0> }
box { -0.5, 0.5 pigment { Wood } finish { Shine } scale 2.4 translate <-2.2, 1.2, -3> }
sphere { 0, 1 pigment { Granite } finish { Shine } translate <1.05, 1, 0> }
#declare Bumpy = texture { pigment { rgb <0.7, 0.5, 0.2> } normal { bumps 0.6 scale 0.12 } finish { Shine } }
sphere { 0, 1 texture { Bumpy } translate <3.2, 1, 0> }
sphere { 0, 1 texture { Bumpy } translate <0, 2.4, -3> }
