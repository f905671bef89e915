#include "app/grade.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <new>

#include "app/session.h"
#include "base/budget.h"
#include "base/file.h"
#include "base/parallel.h"
#include "image/codec.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

bool isPicture(const fs::path& file) {
  std::string suffix = file.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  for (const PictureFormat& format : pictureFormats())
    for (std::string_view known : format.suffixes)
      if (known == suffix) return true;
  return false;
}

bool isScene(const fs::path& file) {
  if (isPicture(file)) return false;
  const std::string bytes = readFile(file.string());
  for (const SceneFormat& format : sceneFormats())
    if (format.recognises(bytes)) return true;
  return false;
}

/// The files in and below the folder for which `wanted` holds, seen from the folder, in the order of names.
std::vector<fs::path> filesIn(const std::string& folder, bool (*wanted)(const fs::path&)) {
  std::vector<fs::path> files;
  try {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file() && wanted(entry.path()))
        files.push_back(fs::relative(entry.path(), folder));
  } catch (const fs::filesystem_error& error) {
    throw Error(Fault::io, "cannot read the folder \"" + folder + "\": " + error.code().message());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Without the suffix: what pairs are made by.
std::string stemOf(const fs::path& file) { return fs::path(file).replace_extension().generic_string(); }

LoadedPicture rendered(const std::string& scene, const GradeTask& task) {
  Budget budget(budgetOfThread.budget);  // the scene's own time limit counts from here
  const BudgetScope scope(&budget);
  Session session;
  session.open(scene, task.choices, task.strict);
  session.build();
  const RenderResult result = session.render();
  if (result.end != End::finished)
    throw Error(Fault::limit,
                "the render did not finish" + (result.failure.empty() ? "" : ": " + result.failure));
  const Settings& settings = session.settings();
  return {fromBytes(toBytes(toned(session.picture(), settings.tone), settings.rounding)), true};
}

std::string encoded(const char* suffix, const Picture& picture) {
  return encodePicture(pictureFormatFor(suffix), picture, Rounding::nearest);
}

void addPictures(GradedPair& pair, const PictureDifference& d, double magnify) {
  pair.referencePicture = encoded(".png", d.reference.picture);
  if (pair.verdict == Verdict::identical) return;
  pair.testPicture = encoded(".png", d.test.picture);
  if (!d.numbers.sameSize) return;
  const auto shown = [&](std::string_view name) {
    for (const Show& show : shows())
      if (show.name == name) return encoded(".jpg", show.picture(d.pictures(), magnify));
    return std::string();
  };
  pair.heatPicture = shown("heat");
  pair.flipPicture = shown("flip");
}

void compareInto(GradedPair& pair, const GradeTask& task) {
  if (pair.file.empty()) return;
  const std::string test = (fs::path(task.folder) / pair.file).string();
  const std::string reference = (fs::path(task.reference) / pair.name).string();
  const PictureDifference d = difference(
      loadPicture(reference), task.renderScenes ? rendered(test, task) : loadPicture(test), task.difference);
  pair.unit = d.unit();
  pair.width = d.reference.picture.width, pair.height = d.reference.picture.height;
  pair.verdict = !d.numbers.sameSize      ? Verdict::sizesDiffer
                 : d.numbers.identical    ? Verdict::identical
                 : within(d, task.limits) ? Verdict::within
                                          : Verdict::beyond;
  if (d.numbers.sameSize)
    for (const Metric& metric : metrics()) pair.values.push_back(metric.value(d));
  else
    pair.problem = "the picture is " + std::to_string(d.test.picture.width) + "x" +
                   std::to_string(d.test.picture.height) + ", the reference " + std::to_string(pair.width) +
                   "x" + std::to_string(pair.height);
  if (task.keepsPictures) addPictures(pair, d, task.magnify);
}

void compareOrNote(GradedPair& pair, const GradeTask& task) {
  try {
    compareInto(pair, task);
  } catch (const Error& error) {
    lookAtBudget();  // if the time of all is over, this pair is not at fault
    pair.verdict = Verdict::unreadable;
    pair.problem = error.what();
  } catch (const std::bad_alloc&) {
    pair.verdict = Verdict::unreadable;
    pair.problem = "not enough memory";
  }
}

/// Worst first: by verdict, by what an eye sees, by the numbers, by name.
bool worse(const GradedPair& a, const GradedPair& b) {
  if (a.verdict != b.verdict) return a.verdict < b.verdict;
  if (!a.values.empty() && !b.values.empty())
    for (std::string_view name : {"flip", "rmse"}) {
      const auto index = static_cast<std::size_t>(&findMetric(name) - metrics().data());
      if (a.values[index] != b.values[index]) return a.values[index] > b.values[index];
    }
  return a.name < b.name;
}

}  // namespace

std::string_view verdictText(Verdict verdict) {
  constexpr std::string_view kTexts[] = {"missing", "unreadable", "sizes differ",
                                         "beyond",  "within",     "identical"};
  return kTexts[static_cast<std::size_t>(verdict)];
}

Grades grade(const GradeTask& task) {
  std::map<std::string, std::vector<fs::path>> files;
  for (const fs::path& file : filesIn(task.folder, task.renderScenes ? isScene : isPicture))
    files[stemOf(file)].push_back(file);

  Grades grades;
  std::map<std::string, bool> used;
  for (const fs::path& reference : filesIn(task.reference, isPicture)) {
    GradedPair pair;
    pair.name = reference.generic_string();
    if (const auto found = files.find(stemOf(reference)); found != files.end()) {
      const std::vector<fs::path>& same = found->second;
      const auto best = std::find(same.begin(), same.end(), reference);  // of the same suffix, or the first
      pair.file = (best != same.end() ? *best : same.front()).generic_string();
      used[pair.file] = true;
    }
    grades.pairs.push_back(std::move(pair));
  }
  if (grades.pairs.empty())
    throw Error(Fault::usage, "there is no picture in the folder \"" + task.reference + "\"");
  for (const auto& [stem, same] : files)
    for (const fs::path& file : same)
      if (!used.contains(file.generic_string())) grades.extra.push_back(file.generic_string());

  Job job;
  Work work("comparing pictures", static_cast<std::int64_t>(grades.pairs.size()));
  const int threads = resolve({task.choices}).threads;
  parallelChunks(static_cast<std::int64_t>(grades.pairs.size()), task.renderScenes ? 1 : threads, job,
                 [&](std::int64_t i, int) {
                   work.reached(job.done);
                   compareOrNote(grades.pairs[static_cast<std::size_t>(i)], task);
                 });
  std::sort(grades.pairs.begin(), grades.pairs.end(), worse);
  grades.passed = static_cast<std::size_t>(std::count_if(grades.pairs.begin(), grades.pairs.end(),
                                                         [](const auto& p) { return passes(p.verdict); }));
  return grades;
}

}  // namespace trace
