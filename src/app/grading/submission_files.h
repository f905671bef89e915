// Which of a student's files stands for which reference picture, by their names alone.
#pragma once

#include <string>
#include <vector>

namespace trace {

/// For each reference the student's file, "" if there is none. A file is of the reference with whose path its
/// own agrees longest from the end on; folders, letter case and suffix may differ. Of several files the one
/// in the fewest folders counts, then the one with the very name, then the same letter case, the same suffix,
/// and the first by name.
std::vector<std::string> assignSubmissions(const std::vector<std::string>& references,
                                           const std::vector<std::string>& files);

/// The files whose name, without folders and suffix, is that of no reference.
std::vector<std::string> withoutReference(const std::vector<std::string>& references,
                                          const std::vector<std::string>& files);

/// Among files without a reference, the one whose name is nearest to the reference's, so that it may be
/// meant; "" if none is near.
std::string fileMeant(const std::string& reference, const std::vector<std::string>& files);

/// A file that has the name of a reference, and was not compared.
struct PassedOver {
  std::string file;
  std::string compared;  ///< the one in its place; "" where its name is that of several references
};

/// "b/glass.png: not compared; a/glass.png was".
std::string passedOverText(const PassedOver& file);

/// The files that have the name of a reference and were not assigned to one. `extra` are those without a
/// reference.
std::vector<PassedOver> passedOverBy(const std::vector<std::string>& assigned,
                                     const std::vector<std::string>& files,
                                     const std::vector<std::string>& extra);

}  // namespace trace
