// The record of a chain, move by move.
#pragma once

#include <cstdint>
#include <functional>

#include "render/samples/pixel.h"
#include "render/world/move_kind.h"

namespace trace {

/// One move of a chain: a sample that was offered to it.
struct ChainMove {
  std::int64_t number = 0;  ///< from 0; -1 is where the chain starts
  MoveKind kind = MoveKind::nearby;
  int x = 0, y = 0;  ///< the pixel to which the offered sample brings most of its light
  Color brings{};    ///< what it brings there
  Real light = 0;    ///< how bright it is, with what it brings to other pixels
  Real before = 0;   ///< and the sample where the chain was
  Real chance = 1;   ///< with which the move is made
  bool made = true;
};
/// Takes the sample that is offered once more, by those who record its rays.
using OfferedSample = std::function<Splat(PixelTracer&)>;
/// Sees each move before it is made or taken back.
using ChainWatch = std::function<void(const ChainMove&, const OfferedSample&)>;

}  // namespace trace
