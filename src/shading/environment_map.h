// A picture of everything around a scene: one colour for each direction.
//
// The middle of every picture is what a new camera looks at: direction -z, with +x to the right and +y up.
// Pictures are seen from inside, so what is written in one can be read.
//
//   lat-long  longitude from left to right, all around; latitude from top (+y) to bottom (-y)
//   angular   a disc: the angle to -z grows from the centre to the rim, which is +z (Debevec, Rendering
//             Synthetic Objects into Real Scenes, SIGGRAPH 1998)
//   cube      six faces of a cube around the origin (Greene, Environment Mapping, IEEE CG&A 6(11), 1986), as
//             a cross or as six files. The ends of a face are the centres of its outermost texels, as the
//             courses have it. Files name the faces as OpenGL does, where z runs the other way: "positive z"
//             lies in front, at -z.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "image/picture.h"
#include "math/vec.h"

namespace trace {

/// How a picture shows all directions; automatic: by its shape and name.
enum class EnvironmentKind { automatic, latLong, angular, cube };

class EnvironmentMap {
 public:
  /// Where a direction lies in the picture.
  struct Spot {
    int face = 0;  ///< face of a cube: index into kFaceNames
    Vec2 uv;       ///< from 0 to 1, (0, 0) at the top left of the picture or face
  };
  static constexpr std::array<std::string_view, 6> kFaceNames{"right", "left", "up", "down", "back", "front"};

  /// One picture; a cube is a cross, 4 x 3 or 3 x 4 squares. Throws std::invalid_argument with the reason if
  /// the picture cannot be of that kind. `kind` is not automatic.
  EnvironmentMap(Picture picture, EnvironmentKind kind);
  /// A cube of square faces of one size, in the order of kFaceNames. Throws as above.
  explicit EnvironmentMap(std::array<Picture, 6> faces);

  EnvironmentKind kind() const { return kind_; }
  /// The spot that a direction of any length but 0 hits.
  Spot spot(const Vec3& direction) const;
  /// The direction of a place on a cube.
  static Spot cubeSpot(const Vec3& direction);
  /// The direction seen there, of length 1; (0, 0, 0) outside the disc of an angular map.
  Vec3 direction(const Spot& spot) const;
  /// Interpolated between the four texels around.
  Color at(const Vec3& direction) const { return at(spot(direction)); }
  Color at(const Spot& spot) const;

  /// The mean over all directions within this angle, in degrees from 0 to 90; nearer ones count more. A cube
  /// whose faces share their edges. `threads` as in the settings.
  EnvironmentMap blurred(Real angle, int threads) const;

 private:
  EnvironmentMap(EnvironmentKind kind, std::vector<Picture> pictures);
  /// The angle between two neighbouring texels in the middle of the picture, in radians.
  Real texelAngle() const;
  /// Six faces of side x side texels that share their edges: texel(direction).
  template <class Texel>
  static EnvironmentMap sampled(int side, int threads, const Texel& texel);

  EnvironmentKind kind_;
  std::vector<Picture> pictures_;  // one, or six faces
  Color top_, bottom_;             // poles of a lat-long map: means of its first and last row
};

/// The kind of one picture by its shape: 4 x 3 or 3 x 4 squares are a cross, a square is angular, anything
/// else lat-long.
EnvironmentKind kindByShape(int width, int height);

/// The face that a file shows by the end of its name: "sky_posx.png", "terrain_negative_z.png", "left.hdr".
struct FaceName {
  int face = -1;     ///< index into kFaceNames; -1: none
  std::string rest;  ///< name without folder and suffix, in lower case: that of the cube
};
FaceName faceByName(std::string_view file);

}  // namespace trace
