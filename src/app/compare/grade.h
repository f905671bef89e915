// A folder of pictures, or of scenes, compared with a folder of reference pictures: what `ray grade` does.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/compare/difference.h"
#include "scene/input_files.h"
#include "scene/options.h"

namespace trace {

struct GradeTask {
  std::string folder, reference;
  bool renderScenes = false;    ///< render the folder's scenes instead of reading its pictures
  std::vector<Choice> choices;  ///< for rendering
  bool strict = false;
  DifferenceOptions difference;
  std::vector<Limit> limits;
  double magnify = 8;         ///< magnify of the heat pictures
  bool keepsPictures = true;  ///< for a page
  std::string page{};         ///< the file to be written, which must be none of those read; "" for none
  double sceneLimit = 0;      ///< seconds that reading and rendering a scene may take; 0 for no limit
  std::string scenes{};       ///< folder of the scenes that the references show; "" if it is not known
};

/// The verdict on one reference picture. The order is from worst to best.
enum class Verdict { missing, unreadable, notReached, sizesDiffer, beyond, within, identical };
std::string_view verdictText(Verdict verdict);
inline bool passes(Verdict verdict) { return verdict >= Verdict::within; }

struct GradedPair {
  std::string name;  ///< name of the reference picture, seen from its folder
  std::string file;  ///< what was compared with it; "" if missing
  Verdict verdict = Verdict::missing;
  std::string problem;  ///< why it could not be compared; may be several lines
  std::string cause;    ///< one sentence, if one change of the whole picture explains a failure
  std::vector<std::string> mistakes{};  ///< the parts of that cause: "flipped", "gamma", "black"
  std::string unit;                     ///< "levels" or "values"
  int width = 0, height = 0;
  std::vector<double> values;    ///< values of metrics(), in their order; empty if it could not be compared
  double cpu = -1, ourCpu = -1;  ///< seconds of the student's program and of Trace; below 0: not measured
  /// Picture files: PNG for the first two, JPEG for the others; empty where there is none.
  std::string referencePicture, testPicture, heatPicture, flipPicture;
};

struct Grades {
  std::vector<GradedPair> pairs;   ///< worst first
  std::vector<std::string> extra;  ///< files of the folder that have no reference, seen from it
  std::size_t passed = 0;
  std::string stopped;  ///< why some pairs were not reached; "" if all were
};

/// Pairs are files of the same name, wherever the suffixes differ, in the same sub-folder. What goes wrong
/// with one pair is its verdict. When the time of all is over, the pairs that are left are not reached.
/// Throws Error when a folder cannot be read or there is no reference picture.
Grades grade(const GradeTask& task);

/// Fills in the comparison of two pictures: numbers, verdict and, of a failure, the cause, also by variants
/// of the scene if one of the task has the name of the reference. `inputs` receives the files that it read.
void judge(GradedPair& pair, const PictureDifference& difference, const GradeTask& task, InputFiles& inputs);

/// The scene in the folder of scenes that has the name of the reference; "" if there is none.
std::string sceneOf(const GradeTask& task, const std::string& reference);

/// Calls `compare`; what it throws is the verdict on the pair, unless the time of all is over.
void judgeOrNote(GradedPair& pair, const std::function<void()>& compare);

/// The picture of a scene of the task's folder, rendered within the limits of the task. `inputs` receives the
/// files that it read, `warnings` what reading warned of, a line each. Throws Error.
LoadedPicture renderedScene(const std::string& scene, const GradeTask& task, InputFiles& inputs,
                            std::string* warnings = nullptr);

/// Notes the warnings about the scene of a pair that failed: they may say why.
void noteWarnings(GradedPair& pair, const std::string& warnings);

/// One self-contained HTML page: a table, worst first, with the pictures in it, and a viewer to swipe between
/// them. Needs nothing but a browser, works offline, by keyboard, in light and dark.
std::string gradePage(const GradeTask& task, const Grades& grades);

}  // namespace trace
