// A grid of heights, as a picture gives them.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace trace {

/// Rows of columns: the first row at y = -1, the first column at x = -1.
struct HeightGrid {
  int columns = 0, rows = 0;
  std::vector<float> heights;

  HeightGrid() = default;
  HeightGrid(int c, int r)
      : columns(c), rows(r), heights(static_cast<std::size_t>(c) * static_cast<std::size_t>(r)) {}
  float& at(int column, int row) {
    return heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)];
  }
  float at(int column, int row) const {
    return heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)];
  }
  bool operator==(const HeightGrid&) const = default;
};

/// Heights that a file of that name gave, behind a shared const handle; none as made.
struct Heights {
  std::string file;
  std::shared_ptr<const HeightGrid> grid;
  bool operator==(const Heights& other) const {
    return file == other.file && (grid == other.grid || (grid && other.grid && *grid == *other.grid));
  }
};

}  // namespace trace
