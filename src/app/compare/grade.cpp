#include "app/compare/grade.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <new>
#include <set>

#include "app/compare/causes.h"
#include "app/compare/grade_files.h"
#include "app/session/session.h"
#include "base/budget.h"
#include "base/files/read_scope.h"
#include "base/parallel.h"
#include "base/text.h"
#include "image/codecs/codec.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

/// Without the suffix: what pairs are made by.
std::string stemOf(const fs::path& file) { return fs::path(file).replace_extension().generic_string(); }

/// The page is written when all is read, and must not go over any of that.
void checkPage(const GradeTask& task, const InputFiles& inputs) {
  if (!task.page.empty()) checkIsNoInput(task.page, inputs);
}

InputFiles filesOf(const GradeTask& task, const Grades& grades) {
  InputFiles files;
  const auto note = [&](const std::string& folder, const std::string& name) {
    if (!name.empty()) files.noteRead((fs::path(folder) / name).generic_string(), {});
  };
  for (const GradedPair& pair : grades.pairs) {
    note(task.reference, pair.name);
    note(task.folder, pair.file);
  }
  for (const std::string& name : grades.extra) note(task.folder, name);
  return files;
}

/// Files that no scene may read: the folder of the references, or, if the scenes lie in it, the pictures
/// there.
std::vector<std::string> hiddenFiles(const GradeTask& task, const FolderFiles& references) {
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(task.folder, error),
                 reference = fs::weakly_canonical(task.reference, error);
  const fs::path between = folder.lexically_relative(reference);
  if (between.empty() || *between.begin() == "..") return {task.reference};
  std::vector<std::string> hidden;
  for (const fs::path& picture : references.files)
    hidden.push_back((task.reference / picture).generic_string());
  return hidden;
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

/// The parts of a change by the names that a rubric has for them.
std::vector<std::string> mistakesOf(const PictureChange& change) {
  std::vector<std::string> names;
  const bool scales =
      change.curve == PictureChange::Curve::scale || change.curve == PictureChange::Curve::lightScale;
  if (!change.turn.text.empty()) names.emplace_back("flipped");
  if (!change.channels.text.empty()) names.emplace_back("channels");
  if (change.curve != PictureChange::Curve::none) names.emplace_back(scales ? "brightness" : "gamma");
  if (change.right != 0 || change.down != 0) names.emplace_back("shift");
  return names;
}

/// Names for what is plain to see.
std::vector<std::string> plainMistakes(const Causes& causes) {
  if (causes.testColor) return {isBlack(*causes.testColor) ? "black" : "one colour"};
  if (causes.isNegative) return {"negative"};
  if (causes.isGrey) return {"grey"};
  return {};
}

/// The one sentence that says most, and the mistakes of a cause that explains the picture.
void addCause(GradedPair& pair, const Causes& causes, std::string_view unit) {
  const std::string reference = "the reference", test = "the picture";
  const std::vector<std::string> notes = causes.notes(reference, test, unit);
  if (causes.picture) {
    pair.cause = causeText(*causes.picture, reference, test, unit);
    if (!causes.picture->isNearest) pair.mistakes = mistakesOf(causes.picture->change);
  } else if (causes.scene) {
    const SceneCauses& scene = *causes.scene;
    const std::vector<std::string> sentences = sceneSentences(scene, reference, test);
    const bool isNamed = scene.test && !scene.test->text().empty();
    if (isNamed) {
      pair.mistakes = scene.test->variants;
      for (std::string& mistake : mistakesOf(scene.test->change)) pair.mistakes.push_back(std::move(mistake));
    }
    if (isNamed || scene.nearest)
      pair.cause = sentences.front();
    else if (scene.pixel && notes.empty())
      pair.cause = sentences.back();
  }
  if (!pair.cause.empty() || notes.empty()) return;
  pair.cause = notes.back();
  pair.mistakes = plainMistakes(causes);
}

/// In words that follow on the name of the pair.
std::string problemOf(const Error& error) {
  constexpr std::string_view kWord = "error: ";
  std::string text = error.what();
  text.erase(text.find_last_not_of('\n') + 1);
  if (text.starts_with(kWord)) return text.substr(kWord.size());
  return error.fault() == Fault::scene ? "cannot be read: " + text : text;
}

void compareInto(GradedPair& pair, const GradeTask& task, InputFiles& inputs) {
  if (pair.file.empty() || pair.verdict == Verdict::unreadable) return;
  const std::string test = (fs::path(task.folder) / pair.file).generic_string();
  const std::string reference = (fs::path(task.reference) / pair.name).generic_string();
  std::string warnings;
  const PictureDifference d = difference(
      loadPicture(reference),
      task.renderScenes ? renderedScene(test, task, inputs, &warnings) : loadPicture(test), task.difference);
  judge(pair, d, task, inputs);
  noteWarnings(pair, warnings);
  if (task.keepsPictures) addPictures(pair, d, task.magnify);
}

void addPair(Grades& grades, const fs::path& reference) {
  GradedPair pair;
  pair.name = reference.generic_string();
  grades.pairs.push_back(std::move(pair));
}

void addUnreadable(Grades& grades, const fs::path& folder, std::string why) {
  GradedPair pair;
  pair.name = folder.generic_string() + "/";
  pair.verdict = Verdict::unreadable;
  pair.problem = std::move(why);
  grades.pairs.push_back(std::move(pair));
}

bool isAmong(const std::vector<fs::path>& files, const fs::path& file) {
  return std::find(files.begin(), files.end(), file) != files.end();
}

/// Says that a pair cannot be compared, for what stands there is not to be read.
void noteNoFile(GradedPair& pair, const fs::path& path) {
  pair.verdict = Verdict::unreadable;
  pair.problem = "\"" + path.generic_string() + "\" is not a file";
}

/// Gives each pair the file of the same name: the same suffix counts before others, what can be read before
/// what cannot, and a name that differs in its case only if there is no other. Returns the files left over.
std::vector<std::string> findPartners(std::vector<GradedPair>& pairs, const FolderFiles& files,
                                      const std::string& root) {
  std::map<std::string, std::vector<fs::path>> byName, byAnyCase;
  for (const std::vector<fs::path>* list : {&files.files, &files.others, &files.noFiles})
    for (const fs::path& file : *list) {
      byName[stemOf(file)].push_back(file);
      byAnyCase[lowerCase(stemOf(file))].push_back(file);
    }
  std::set<std::string> used;
  const auto take = [&](GradedPair& pair, const fs::path& file) {
    pair.file = file.generic_string();
    used.insert(pair.file);
    if (isAmong(files.noFiles, file)) noteNoFile(pair, root / file);
  };
  for (GradedPair& pair : pairs) {
    const auto found = byName.find(stemOf(pair.name));
    if (found == byName.end()) continue;
    const auto same = std::find(found->second.begin(), found->second.end(), fs::path(pair.name));
    take(pair, same != found->second.end() ? *same : found->second.front());
  }
  for (GradedPair& pair : pairs) {
    if (!pair.file.empty()) continue;
    for (const fs::path& file : byAnyCase[lowerCase(stemOf(pair.name))])
      if (pair.file.empty() && !used.contains(file.generic_string())) take(pair, file);
    if (!pair.file.empty()) continue;
    for (const auto& [folder, why] : files.unreadableFolders)
      if (pair.name.starts_with(folder.generic_string() + "/")) {
        pair.verdict = Verdict::unreadable;
        pair.problem = "cannot read the folder \"" + folder.generic_string() + "\": " + why;
      }
  }
  std::vector<std::string> left;
  for (const fs::path& file : files.files)
    if (!used.contains(file.generic_string())) left.push_back(file.generic_string());
  return left;
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
  constexpr std::string_view kTexts[] = {"missing", "unreadable", "not reached", "sizes differ",
                                         "beyond",  "within",     "identical"};
  return kTexts[static_cast<std::size_t>(verdict)];
}

void noteWarnings(GradedPair& pair, const std::string& warnings) {
  if (passes(pair.verdict) || warnings.empty()) return;
  pair.problem += (pair.problem.empty() ? "" : "\n") + warnings;
}

LoadedPicture renderedScene(const std::string& scene, const GradeTask& task, InputFiles& inputs,
                            std::string* warnings) {
  Budget limit(budgetOfThread.budget);
  limit.limitTime(task.sceneLimit);
  Budget own(&limit);  // the session sets it to the scene's own time limit
  const BudgetScope scope(&own);
  Session session;
  session.open(scene, task.choices, task.strict);
  inputs = session.scene().inputs;
  session.build();
  if (warnings)
    for (const Message& message : session.messages().all())
      *warnings += (warnings->empty() ? "" : "\n") + toString(message);
  const RenderResult result = session.renderPicture();
  if (result.end == End::timeLimit && task.sceneLimit > 0 && limit.seconds() > task.sceneLimit)
    throw Error(Fault::limit, "it takes longer than the " + toText(task.sceneLimit) + " s of --scene-limit");
  if (result.end != End::finished)
    throw Error(Fault::limit,
                "the render did not finish" + (result.failure.empty() ? "" : ": " + result.failure));
  const Settings& settings = session.settings();
  return {fromBytes(toBytes(developed(finished(session.picture(), settings), developmentOf(settings)),
                            settings.rounding)),
          true};
}

void judge(GradedPair& pair, const PictureDifference& d, const GradeTask& task, InputFiles& inputs) {
  pair.unit = d.unit();
  pair.width = d.reference.picture.width;
  pair.height = d.reference.picture.height;
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
  if (passes(pair.verdict)) return;
  const std::string scene = sceneOf(task, pair.name);
  const SceneQuestion question{.file = scene, .choices = task.choices, .strict = task.strict};
  const Causes causes = causesOf(d, scene.empty() ? nullptr : &question);
  if (!causes.stopped.empty()) lookAtBudget();  // this pair is not reached
  if (causes.scene) inputs = causes.scene->inputs;
  addCause(pair, causes, d.unit());
}

std::string sceneOf(const GradeTask& task, const std::string& reference) {
  if (task.scenes.empty()) return "";
  const std::string wanted = lowerCase(stemOf(reference));
  std::string found;
  for (const fs::path& file : filesBelow(task.scenes, sceneKind).files)
    if (const std::string stem = lowerCase(stemOf(file)); stem == wanted && found.empty())
      found = (task.scenes / file).generic_string();
  return found;
}

void judgeOrNote(GradedPair& pair, const std::function<void()>& compare) {
  try {
    compare();
  } catch (const Error& error) {
    lookAtBudget();  // if the time of all is over, this pair is not at fault
    pair.values.clear();
    pair.cause.clear();
    pair.mistakes.clear();
    pair.verdict = Verdict::unreadable;
    pair.problem = problemOf(error);
  } catch (const std::bad_alloc&) {
    pair.verdict = Verdict::unreadable;
    pair.problem = "not enough memory";
  }
}

Grades grade(const GradeTask& task) {
  Grades grades;
  FolderFiles files = filesBelow(task.folder, task.renderScenes ? sceneKind : pictureKind);
  std::stable_partition(files.others.begin(), files.others.end(), hasSceneSuffix);
  const FolderFiles references = filesBelow(task.reference, pictureKind);
  for (const std::vector<fs::path>* list : {&references.files, &references.others, &references.noFiles})
    for (const fs::path& reference : *list) addPair(grades, reference);
  for (const auto& [folder, why] : references.unreadableFolders)
    addUnreadable(grades, folder, "cannot read the folder: " + why);
  if (grades.pairs.empty())
    throw Error(Fault::usage, "there is no picture in the folder \"" + task.reference + "\"");
  grades.extra = findPartners(grades.pairs, files, task.folder);
  for (GradedPair& pair : grades.pairs)
    if (isAmong(references.noFiles, pair.name)) noteNoFile(pair, fs::path(task.reference) / pair.name);

  checkPage(task, filesOf(task, grades));

  Job job;
  std::vector<InputFiles> inputs(grades.pairs.size());
  Work work("comparing pictures", static_cast<std::int64_t>(grades.pairs.size()));
  const int threads = resolve({task.choices}).threads;
  std::vector<char> reached(grades.pairs.size());
  const ReadScope scope({}, hiddenFiles(task, references));
  try {
    parallelChunks(static_cast<std::int64_t>(grades.pairs.size()), task.renderScenes ? 1 : threads, job,
                   [&](std::int64_t i, int) {
                     work.reached(job.done);
                     const auto index = static_cast<std::size_t>(i);
                     judgeOrNote(grades.pairs[index],
                                 [&] { compareInto(grades.pairs[index], task, inputs[index]); });
                     reached[index] = true;
                   });
  } catch (const Error& error) {
    if (error.fault() != Fault::limit) throw;
    grades.stopped = error.messages().front().what;
  }
  for (std::size_t i = 0; i < reached.size(); ++i)
    if (!reached[i] && !grades.pairs[i].file.empty()) grades.pairs[i].verdict = Verdict::notReached;
  for (const InputFiles& ofScene : inputs) checkPage(task, ofScene);
  std::sort(grades.pairs.begin(), grades.pairs.end(), worse);
  grades.passed = static_cast<std::size_t>(std::count_if(grades.pairs.begin(), grades.pairs.end(),
                                                         [](const auto& p) { return passes(p.verdict); }));
  return grades;
}

}  // namespace trace
