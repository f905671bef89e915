// The points of a class: what each scene is worth, and the share that a picture with a mistake keeps. A text
// file, read by `ray grade --class --rubric FILE`; docs/how-to/grade-a-class.md has its rows.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"

namespace trace {

struct GradedPair;

struct Rubric {
  struct SceneRow {
    std::string pattern;  ///< the name of a scene, in which * stands for any letters
    double points = 0;
    SourcePlace place{};  ///< in the rubric's file
  };
  std::vector<SceneRow> scenes;  ///< the first that fits counts
  /// Names of mistakes (mistakeNames()) and the share that a picture with them keeps, 0 to 1.
  std::vector<std::pair<std::string, double>> mistakes;
  /// A picture whose metric is within this keeps the share.
  struct Step {
    std::string metric;
    double value = 0, share = 0;
  };
  std::vector<Step> steps;

  /// Throws Error(Fault::scene) with all rows whose scene is none of these.
  void checkScenes(const std::vector<std::string>& names) const;
  /// 1 if no row fits.
  double pointsOf(std::string_view scene) const;
  /// The share of the points that the picture gets: 1 within the limits; else the largest share of its rows,
  /// or 0. Shares of several mistakes of one picture are multiplied.
  double shareOf(const GradedPair& pair) const;
};

/// "flipped", "channels", "gamma", "brightness", "shift".
std::vector<std::string_view> mistakeNames();

/// Throws Error(Fault::io), and Error(Fault::scene) with file, line and column of each wrong row.
Rubric readRubric(const std::string& file);

}  // namespace trace
