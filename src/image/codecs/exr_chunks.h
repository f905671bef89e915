// Whether the rows of an EXR file are whole, looked at before OpenEXR reads them. OpenEXR 3.1 takes a block
// that unpacks to too few bytes, and shows what was in memory behind them; it also takes as much memory as an
// attribute claims to be long. Source: "OpenEXR File Layout" (openexr.com).
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace trace {

inline constexpr std::size_t kExrMagicAndVersion = 8;  ///< bytes

/// Where the first header ends, and where the blocks' offsets begin behind all headers.
struct ExrHeaders {
  bool tiled = false, several = false;  ///< several parts
  std::size_t offsets = 0;
};
/// Throws std::runtime_error for an attribute that does not fit into the file.
ExrHeaders exrHeaders(std::string_view bytes);

/// The expected contents of the blocks of a part.
struct ExrLayout {
  struct Channel {
    int bytes, xSampling, ySampling;
  };
  enum class Packing { none, runs, deflate, other };
  enum class Levels { one, mipmap, ripmap };  ///< the lower resolutions of a tiled part

  Packing packing = Packing::other;
  int rows = 1;  ///< rows of a block
  int minX = 0, minY = 0, maxX = 0, maxY = 0;
  std::vector<Channel> channels;
  int tileWidth = 0, tileHeight = 0;  ///< tile width and tile height of a tiled part
  Levels levels = Levels::one;
  bool roundsUp = false;  ///< sides of lower levels

  bool isTiled() const { return tileWidth > 0 && tileHeight > 0; }
};

/// Throws std::runtime_error unless every block of the full resolution of the last of these parts is there
/// and unpacks to all its pixels. Of Packing::other, which OpenEXR checks itself, only that it is there.
/// `parts` are those of the file from the first on; no window may be empty.
void checkExrBlocks(std::string_view bytes, const ExrHeaders& headers, const std::vector<ExrLayout>& parts);

}  // namespace trace
