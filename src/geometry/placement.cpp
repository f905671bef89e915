#include "geometry/placement.h"

namespace trace {
namespace {

/// A point p goes out with an error of 4 roundings of M |p| + m, where M and m are the absolute values of the
/// transform's linear part and offset. The way back has 8 of N (M |p| + m) + n, likewise for the inverse,
/// which M brings out. Both are linear in |p|, and multiplied out in WayOut.
const Real kThere = gammaError(4), kBack = gammaError(8);
/// Room for the rounding of the bound itself.
const Real kOwn = 1 + gammaError(24);

/// The place at `point`, with the direction of its normal by `turned`.
template <class Turned>
SurfacePoint placed(const SurfacePoint& in, const Vec3& point, const Vec3& error, const Turned& turned) {
  SurfacePoint out;
  out.point = point;
  out.error = error;
  // By components: a copy of numbers that were just written would wait for memory.
  const Vec3 normal = normalize(turned(in.normal));
  Vec3 shading{normal.x, normal.y, normal.z};
  if (!(in.shading == in.normal)) shading = normalize(turned(in.shading));
  out.normal = normal;
  out.shading = shading;
  out.uv = in.uv;
  return out;
}

Vec3 diagonal(const Affine& m) { return {m.row[0].x, m.row[1].y, m.row[2].z}; }

Affine scaledAndMoved(const Vec3& scale, const Vec3& offset) {
  Affine m = Affine::scaling(scale);
  m.offset = offset;
  return m;
}

bool isScaledAndMoved(const Affine& m) { return m == scaledAndMoved(diagonal(m), m.offset); }

}  // namespace

WayOut::WayOut(const Affine& outFromIn, const Affine& inFromOut) : outFromIn(outFromIn) {
  const Affine there = absolute(outFromIn), back = absolute(inFromOut), thereAndBack = back * there;
  for (int i = 0; i < 3; ++i)
    rounding.row[i] = there.row[i] * kThere + transposed(thereAndBack, there.row[i]) * kBack;
  rounding.offset = there.offset * kThere + linear(there, thereAndBack.offset) * kBack;
}

SurfacePoint outOf(const SurfacePoint& in, const WayOut& way, const Affine& inFromOut) {
  const Vec3 error = (linear(absolute(way.outFromIn), in.error) + (way.rounding * abs(in.point))) * kOwn;
  return placed(in, way.outFromIn * in.point, error, [&](const Vec3& n) { return transposed(inFromOut, n); });
}

Placement::Placement(const Affine& outFromIn) : moved_(outFromIn != Affine{}) {
  const Affine inFromOut = inverse(outFromIn);
  if (isScaledAndMoved(outFromIn) && isScaledAndMoved(inFromOut))
    way_ = Scaled{diagonal(inFromOut), inFromOut.offset, diagonal(outFromIn), outFromIn.offset};
  else
    way_ = Turned{inFromOut, std::make_shared<const WayOut>(outFromIn, inFromOut)};
}

Affine Placement::outFromIn() const {
  if (const Scaled* s = std::get_if<Scaled>(&way_)) return scaledAndMoved(s->scaleOut, s->offsetOut);
  return std::get_if<Turned>(&way_)->out->outFromIn;
}

Affine Placement::inFromOut() const {
  if (const Scaled* s = std::get_if<Scaled>(&way_)) return scaledAndMoved(s->scaleIn, s->offsetIn);
  return std::get_if<Turned>(&way_)->inFromOut;
}

/// As by a WayOut, of which two thirds are zeros.
SurfacePoint Placement::outOf(const SurfacePoint& in, const Scaled& way) {
  const Vec3 there = abs(way.scaleOut), back = abs(way.scaleIn), offset = abs(way.offsetOut);
  const Vec3 thereAndBack = times(back, there);
  const Vec3 rounding = there * kThere + times(thereAndBack, there) * kBack;
  const Vec3 rest = offset * kThere + times(there, times(back, offset) + abs(way.offsetIn)) * kBack;
  const Vec3 error = (times(there, in.error) + (times(rounding, abs(in.point)) + rest)) * kOwn;
  return placed(in, times(way.scaleOut, in.point) + way.offsetOut, error,
                [&](const Vec3& n) { return times(way.scaleIn, n); });
}

}  // namespace trace
