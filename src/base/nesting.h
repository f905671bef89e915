// How deep things may be nested in a file. Whatever reads, builds, traces, writes and destroys them is
// recursive; within these limits 1 MiB of stack does. A reader refuses what is nested deeper, with its place.
#pragma once

namespace trace {

/// Brackets of a .ray file, nodes of Inventor and VRML, brackets of glTF. Room for twice the solids and a
/// material: what was read is written with a transform for each solid, and read again.
inline constexpr int kMostNesting = 140;

/// Solids made of solids, and systems of particles in others; groups within them count too. Each level takes
/// more of the stack: a ray visits the parts of a solid one within the other.
inline constexpr int kMostNestedSolids = 64;

}  // namespace trace
