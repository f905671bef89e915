// Where the studio's panels are: arrangements for what people do, and how the docks share the window.
#pragma once

#include <span>
#include <string_view>

namespace trace {

enum class Dock { left, centre, right, bottom, hidden };

/// Shares of the window that docks may have.
struct DockShares {
  double left = 0.23, right = 0.4, bottom = 0.17;
  double upper = 0.55;  ///< share of the centre's dock where all are below each other
  static constexpr double kLeast = 0.12, kMost = 0.6;
};

struct Arrangement {
  struct Place {
    std::string_view panel;
    Dock dock;
  };
  std::string_view name, help;
  DockShares shares;
  std::span<const Place> places;  ///< places of panels that are not where the table of panels has them
};

/// Look, Build and Compare.
std::span<const Arrangement> arrangements();
/// The arrangement for a first start: Build, if its panels have room in so many characters side by side.
const Arrangement& firstArrangement(double charactersAcross);

/// A window that is narrow and tall, as that of a phone, has one column: the picture, and below it the panels
/// that are beside it elsewhere.
bool hasOneColumn(double charactersAcross, double width, double height);

/// The docks that hold a panel.
struct DocksInUse {
  bool left = true, centre = true, right = true, bottom = true;
};

/// Widths of the left and the right dock and the height of the lower one, in pixels; the centre has the rest.
struct DockSizes {
  double left = 0, right = 0, bottom = 0;
};

/// `letter`: the width of a character, as fields of the left dock need room. `drawer`: the height of the
/// lower dock while it is closed; 0 if it is open.
DockSizes dockSizes(const DockShares& shares, const DocksInUse& used, double width, double height,
                    double letter, double drawer);

}  // namespace trace
