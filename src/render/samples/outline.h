// Lines where objects end in the picture and along their edges, found by rays around a sample: a line is as
// wide in the picture wherever it is, and drawn by every sample for itself (Choudhury and Parker, Ray Tracing
// NPR-Style Feature Lines, NPAR 2009).
#pragma once

#include "math/vec.h"
#include "render/rays/tracer.h"
#include "render/samples/picture_size.h"
#include "render/world/hit.h"

namespace trace {

/// How much of a sample is ink, from 0 to 1: its camera ray goes through the place `film` of a picture of
/// that size and through the place `lens`, and has met `hit`.
Real inkAt(Tracer& tracer, const std::optional<Hit>& hit, const Vec2& film, const Vec2& lens,
           const Size& size);

}  // namespace trace
