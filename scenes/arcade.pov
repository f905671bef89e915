// A scene in the language of POV-Ray: an arcade of turned columns on a chequered floor, made by a macro and
// two loops. Render it with `ray scenes/arcade.pov`.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 6 }

#declare Columns = 7;
#declare Gap = 2.2;
#declare Stone = texture {
  pigment {
    granite
    color_map { [0.0 rgb <0.62, 0.55, 0.46>] [0.4 rgb <0.85, 0.80, 0.70>] [1.0 rgb <0.95, 0.92, 0.85>] }
    scale 0.4
  }
  finish { ambient 0.15 diffuse 0.75 specular 0.15 roughness 0.05 }
}

#macro Column(Height, Radius)
  union {
    box { <-1.4 * Radius, 0, -1.4 * Radius>, <1.4 * Radius, 0.25, 1.4 * Radius> }
    cone { <0, 0.25, 0>, Radius, <0, Height - 0.4, 0>, Radius * 0.85 }
    torus { Radius, 0.08 translate 0.3 * y }
    torus { Radius * 0.9, 0.08 translate (Height - 0.4) * y }
    box { <-1.3 * Radius, Height - 0.3, -1.3 * Radius>, <1.3 * Radius, Height, 1.3 * Radius> }
    texture { Stone }
  }
#end

#for (Row, 0, 1)
  #for (I, 0, Columns - 1)
    object { Column(3.2, 0.4) translate <(Row * 2 - 1) * 2.1, 0, I * Gap> }
  #end
#end

// The vault: a wall with round arches cut out of it.
#macro Wall()
  difference {
    box { <-0.45, 3.2, -1>, <0.45, 5, (Columns - 1) * Gap + 1> }
    #local I = 0;
    #while (I < Columns - 1)
      cylinder { <-1, 3.2, (I + 0.5) * Gap>, <1, 3.2, (I + 0.5) * Gap>, 0.72 }
      #local I = I + 1;
    #end
    texture { Stone }
  }
#end
object { Wall() translate -2.1 * x }
object { Wall() translate 2.1 * x }

plane {
  y, 0
  pigment { checker rgb <0.9, 0.88, 0.82>, rgb <0.25, 0.2, 0.22> }
  finish { ambient 0.1 diffuse 0.7 reflection 0.15 }
}

#declare R = seed(11);
#for (I, 1, 9)
  #local P = <rand(R) * 2.4 - 1.2, 0.22, rand(R) * 9>;
  sphere {
    P, 0.22
    #if (mod(I, 3) = 0)
      pigment { rgbf <0.9, 0.97, 1, 0.9> } finish { specular 0.6 roughness 0.01 reflection 0.08 } interior { ior 1.5 }
    #else
      pigment { rgb <select(mod(I, 3) - 1.5, 0.9, 0.2), 0.25, 0.15 * mod(I, 5)> } finish { phong 0.6 phong_size 60 }
    #end
  }
#end

sky_sphere { pigment { gradient y color_map { [0 rgb <0.9, 0.92, 0.95>] [0.6 rgb <0.25, 0.45, 0.8>] } } }
light_source { <-9, 12, -6>, rgb <1, 0.95, 0.85> area_light <1.5, 0, 0>, <0, 0, 1.5>, 4, 4 adaptive 1 jitter }
camera { location <0.3, 1.7, -4.5> look_at <0, 1.9, 6> angle 58 }
