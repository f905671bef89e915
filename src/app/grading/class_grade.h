// A class: a folder for each student, compared with one folder of reference pictures. What `ray grade
// --class` does. Results are kept in a file, so that an interrupted run continues and the page of unchanged
// submissions is the same to the last byte.
#pragma once

#include <string>
#include <vector>

#include "app/compare/grade.h"
#include "app/grading/rubric.h"
#include "app/grading/student_program.h"
#include "app/grading/submission_files.h"

namespace trace {

struct ClassTask {
  GradeTask grade;  ///< its folder has a sub-folder for each student
  Rubric rubric;
  std::string results;  ///< the file that keeps results; "" for none
  ProgramRun run{};     ///< the students' programs make the pictures, of the scenes of `grade`
  std::string csv{};    ///< the file to be written, which must be none of those read; "" for none
};

struct ClassScene {
  std::string name;       ///< the name of the reference, without its suffix
  std::string reference;  ///< the picture, seen from the folder of the references
  double points = 1;
  std::string thumbnail;  ///< a JPEG file; empty where nothing keeps pictures
};

struct ClassStudent {
  std::string name;
  std::vector<GradedPair> pairs;  ///< one for each scene, in their order; its pictures are small JPEG files
  std::vector<double> points;     ///< the points of each pair
  std::vector<std::string> extra{};  ///< files whose name is that of no reference
  std::vector<PassedOver> passedOver{};
  double total = 0;
  std::size_t passed = 0;
};

struct ClassGrades {
  std::vector<ClassScene> scenes;      ///< in the order of names
  std::vector<ClassStudent> students;  ///< worst first
  double possible = 0;                 ///< points of all scenes
  std::size_t computed = 0;            ///< pairs whose result was not kept from an earlier run
  std::string stopped;                 ///< why some pairs were not reached; "" if all were
};

/// Throws Error when a folder cannot be read, there is no student or no reference, or two references have one
/// name; what goes wrong with one picture is its verdict.
ClassGrades gradeClass(const ClassTask& task);

/// One self-contained HTML page: students by scenes, worst first.
std::string classPage(const ClassTask& task, const ClassGrades& grades);

/// One row for each student (RFC 4180): student, points, of; then points, verdict and cause of each scene. A
/// text that a spreadsheet takes for a formula has an apostrophe before it.
std::string classCsv(const ClassGrades& grades);

}  // namespace trace
