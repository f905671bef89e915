#include "app/grading/submission_files.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>

#include "app/compare/grade_files.h"
#include "base/text.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

/// The parts of the path from its end on, in small letters, the first without its suffix.
std::vector<std::string> partsFromEnd(const std::string& path) {
  std::vector<std::string> parts;
  fs::path whole(lowerCase(path));
  whole.replace_extension();
  for (const fs::path& part : whole) parts.push_back(part.generic_string());
  std::reverse(parts.begin(), parts.end());
  return parts;
}

std::size_t agreement(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  const std::size_t most = std::min(a.size(), b.size());
  std::size_t count = 0;
  while (count < most && a[count] == b[count]) ++count;
  return count;
}

/// How much the name, without folders, is that of the reference: in letter case, then in suffix.
int likeness(const fs::path& file, const fs::path& reference) {
  if (file.filename() == reference.filename()) return 3;
  if (file.stem() == reference.stem()) return 2;
  return lowerCase(file.extension().generic_string()) == lowerCase(reference.extension().generic_string());
}

}  // namespace

std::vector<std::string> assignSubmissions(const std::vector<std::string>& references,
                                           const std::vector<std::string>& files) {
  std::vector<std::vector<std::string>> wanted;
  for (const std::string& reference : references) wanted.push_back(partsFromEnd(reference));
  std::vector<const std::string*> chosen(references.size());
  std::vector<std::size_t> agreed(references.size());
  const auto better = [&](const std::string& file, std::size_t agrees, std::size_t i) {
    if (!chosen[i]) return true;
    const std::string& other = *chosen[i];
    if (agrees != agreed[i]) return agrees > agreed[i];
    const auto depth = [](const std::string& path) { return std::count(path.begin(), path.end(), '/'); };
    if (depth(file) != depth(other)) return depth(file) < depth(other);
    const int alike = likeness(file, references[i]), otherAlike = likeness(other, references[i]);
    return alike != otherAlike ? alike > otherAlike : file < other;
  };
  for (const std::string& file : files) {
    const std::vector<std::string> parts = partsFromEnd(file);
    std::size_t most = 0;
    for (const auto& reference : wanted) most = std::max(most, agreement(parts, reference));
    if (most == 0) continue;
    // A name that several references share in different folders is that of none without its folder.
    const auto rivals = std::count_if(wanted.begin(), wanted.end(), [&](const auto& reference) {
      return agreement(parts, reference) == most;
    });
    if (rivals > 1) continue;
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (agreement(parts, wanted[i]) == most && better(file, most, i)) chosen[i] = &file, agreed[i] = most;
  }
  std::vector<std::string> result;
  for (const std::string* file : chosen) result.push_back(file ? *file : "");
  return result;
}

std::vector<std::string> withoutReference(const std::vector<std::string>& references,
                                          const std::vector<std::string>& files) {
  std::set<std::string> known;
  for (const std::string& reference : references) known.insert(partsFromEnd(reference).front());
  std::vector<std::string> others;
  for (const std::string& file : files)
    if (!known.contains(partsFromEnd(file).front())) others.push_back(file);
  return others;
}

std::vector<PassedOver> passedOverBy(const std::vector<std::string>& assigned,
                                     const std::vector<std::string>& files,
                                     const std::vector<std::string>& extra) {
  const auto isAmong = [](const std::vector<std::string>& list, const std::string& file) {
    return std::find(list.begin(), list.end(), file) != list.end();
  };
  std::vector<PassedOver> all;
  for (const std::string& file : files) {
    if (isAmong(assigned, file) || isAmong(extra, file)) continue;
    const auto inItsPlace = std::find_if(assigned.begin(), assigned.end(), [&](const std::string& other) {
      return !other.empty() && partsFromEnd(other).front() == partsFromEnd(file).front();
    });
    all.push_back({file, inItsPlace == assigned.end() ? "" : *inItsPlace});
  }
  return all;
}

std::string fileMeant(const std::string& reference, const std::vector<std::string>& files) {
  std::vector<std::string> stems;
  for (const std::string& file : files) stems.push_back(partsFromEnd(file).front());
  const std::vector<std::string_view> candidates(stems.begin(), stems.end());
  const std::string meant = nearest(partsFromEnd(reference).front(), candidates);
  const auto found = std::find(stems.begin(), stems.end(), meant);
  return found == stems.end() ? "" : files[static_cast<std::size_t>(found - stems.begin())];
}

std::string passedOverText(const PassedOver& file) {
  return file.file + ": not compared; " +
         (file.compared.empty() ? "several references have its name" : file.compared + " was");
}

}  // namespace trace
