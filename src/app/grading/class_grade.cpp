#include "app/grading/class_grade.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>

#include "app/compare/grade_files.h"
#include "app/grading/class_results.h"
#include "app/session/output.h"
#include "app/session/version.h"
#include "base/budget.h"
#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "base/hash.h"
#include "base/os/process.h"
#include "base/parallel.h"
#include "base/text.h"
#include "image/codecs/codec.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

constexpr int kThumbnailWidth = 120;  // pixels

/// Means of the pixels that each pixel of the smaller picture covers.
Picture reduced(const Picture& picture) {
  if (picture.width <= kThumbnailWidth) return picture;
  const int width = kThumbnailWidth;
  const int height = std::max(1, static_cast<int>(std::int64_t{picture.height} * width / picture.width));
  const auto begin = [](int i, int small, int large) {
    return static_cast<int>(std::int64_t{i} * large / small);
  };
  Picture small(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int left = begin(x, width, picture.width), top = begin(y, height, picture.height);
      const int right = begin(x + 1, width, picture.width);
      const int bottom = std::max(top + 1, begin(y + 1, height, picture.height));
      Color sum;
      for (int v = top; v < bottom; ++v)
        for (int u = left; u < right; ++u) sum += picture.at(u, v);
      small.at(x, y) = sum / (static_cast<double>(right - left) * static_cast<double>(bottom - top));
    }
  return small;
}

std::string thumbnailFile(const Picture& picture) {
  return encodePicture(pictureFormatFor(".jpg"), reduced(picture), Rounding::nearest);
}

/// The student's folder: its files and a hash of all that a scene in it may read.
struct Submission {
  std::string name, folder;
  FolderFiles files;
  std::uint64_t everything = 0;
};

std::vector<Submission> submissionsIn(const GradeTask& task) {
  std::error_code error;
  std::vector<Submission> all;
  for (fs::directory_iterator i(task.folder, error), end; !error && i != end; i.increment(error)) {
    std::error_code unknown;
    const std::string name = i->path().filename().generic_string();
    if (name[0] == '.' || name == "__MACOSX" || !i->is_directory(unknown)) continue;
    if (fs::equivalent(i->path(), task.reference, unknown)) continue;
    all.push_back({name, i->path().generic_string(), {}, 0});
  }
  if (error) throw Error(Fault::io, "cannot read the folder \"" + task.folder + "\": " + error.message());
  if (all.empty())
    throw Error(Fault::usage, "expected a folder for each student in \"" + task.folder + "\", found none",
                "without --class its files are compared");
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return all;
}

FileKind anyKind(const fs::path&) { return FileKind::wanted; }

/// The hash of the names and bytes of all files below the folder.
std::uint64_t hashOfFolder(const std::string& folder) {
  Hash hash;
  for (const fs::path& file : filesBelow(folder, anyKind).files) {
    hash.add(file.generic_string());
    try {
      hash.add(readFile((folder / file).generic_string()));
    } catch (const Error&) {
      lookAtBudget();  // a file that cannot be read is none for a scene either
    }
  }
  return hash.value();
}

bool liesBelow(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  const fs::path between =
      fs::weakly_canonical(file, error).lexically_relative(fs::weakly_canonical(folder, error));
  return !error && !between.empty() && *between.begin() != "..";
}

/// A reference picture, read once for all students.
struct Reference {
  std::string path;
  std::optional<LoadedPicture> picture;  ///< none if it cannot be read
  std::string problem;
  std::uint64_t hash = 0;
};

class ClassGrader {
 public:
  explicit ClassGrader(const ClassTask& task) : task_(task), results_(task.results) {}

  ClassGrades grade() {
    if (runs() && task_.grade.scenes.empty())
      throw Error(Fault::usage, "--run: expected --scene DIR, the folder of the scenes", "--scene scenes");
    checkRun(task_.run);
    readReferences();
    checkRubric();
    for (Submission& submission : submissionsIn(task_.grade)) students_.push_back(std::move(submission));
    for (const Submission& student : students_) {
      ClassStudent& graded = grades_.students.emplace_back();
      graded.name = student.name;
      graded.pairs.resize(grades_.scenes.size());
      for (std::size_t i = 0; i < graded.pairs.size(); ++i) {
        graded.pairs[i].name = grades_.scenes[i].reference;
        graded.pairs[i].verdict = Verdict::notReached;
      }
    }
    gradeAll();
    addPoints();
    return std::move(grades_);
  }

 private:
  bool runs() const { return !task_.run.command.empty(); }
  /// Each of them takes all threads, or is measured.
  bool isOneByOne() const { return runs() || task_.grade.renderScenes || !task_.grade.scenes.empty(); }

  void readReferences() {
    const FolderFiles files = filesBelow(task_.grade.reference, pictureKind);
    std::map<std::string, std::string> names;
    for (const fs::path& file : files.files) {
      ClassScene scene{fs::path(file).replace_extension().generic_string(), file.generic_string(), 1, {}};
      const auto [known, isNew] = names.emplace(lowerCase(scene.name), scene.reference);
      if (!isNew)
        throw Error(Fault::usage, "two reference pictures have one name: \"" + known->second + "\" and \"" +
                                      scene.reference + "\"");
      Reference reference;
      reference.path = (task_.grade.reference / file).generic_string();
      checkOutputs(reference.path);
      try {
        Hash hash;
        hash.add(readFile(reference.path));
        reference.hash = hash.value();
        reference.picture = loadPicture(reference.path);
        if (task_.grade.keepsPictures) scene.thumbnail = thumbnailFile(reference.picture->picture);
      } catch (const Error& error) {
        lookAtBudget();
        reference.problem = error.messages().front().what;
      }
      scene.points = task_.rubric.pointsOf(scene.name);
      grades_.possible += scene.points;
      grades_.scenes.push_back(std::move(scene));
      references_.push_back(std::move(reference));
    }
    if (references_.empty())
      throw Error(Fault::usage, "there is no picture in the folder \"" + task_.grade.reference + "\"");
  }

  void checkRubric() const {
    std::vector<std::string> names;
    for (const ClassScene& scene : grades_.scenes) names.push_back(scene.name);
    task_.rubric.checkScenes(names);
  }

  void gradeAll() {
    Job job;
    const auto count = static_cast<std::int64_t>(students_.size());
    Work work("grading the class", count);
    const int threads = resolve({task_.grade.choices}).threads;
    const ReadScope scope({}, {task_.grade.reference});
    optionsHash_ = hashOfOptions();
    if (!task_.grade.scenes.empty()) scenesHash_ = hashOfFolder(task_.grade.scenes);
    try {
      parallelChunks(count, isOneByOne() ? 1 : threads, job, [&](std::int64_t i, int) {
        work.reached(job.done);
        gradeStudent(students_[static_cast<std::size_t>(i)], grades_.students[static_cast<std::size_t>(i)]);
        keepSometimes();
      });
    } catch (const Error& error) {
      if (error.fault() != Fault::limit) throw;
      grades_.stopped = error.messages().front().what;
    }
    const BudgetScope late(nullptr);  // results are kept, whatever the time
    results_.save(grades_.stopped.empty());
  }

  /// The hash of all that decides the result of two files.
  std::uint64_t hashOfOptions() const {
    const GradeTask& task = task_.grade;
    std::string text = programText() + "\n" + (task.renderScenes ? "scenes" : "pictures") + " " +
                       (task.keepsPictures ? "kept" : "") + (task.strict ? " strict" : "");
    for (double value :
         {task.difference.tolerance, task.difference.pixelsPerDegree, task.magnify, task.sceneLimit})
      text += " " + toText(value);
    for (const Limit& limit : task.limits)
      text += "\n" + std::string(limit.metric->name) + " " + toText(limit.value);
    if (runs())
      text += "\nrun " + task_.run.command + "\n" + toText(task_.run.limits.seconds) + " " +
              std::to_string(task_.run.limits.memory) + " " + std::to_string(task_.run.limits.output) +
              (task_.run.isolated ? "" : " not isolated");
    if (task.renderScenes || !task.scenes.empty())
      for (const Choice& choice : task.choices) text += "\n" + choice.option + "=" + choice.value;
    Hash hash;
    hash.add(text);
    return hash.value();
  }

  void gradeStudent(Submission& student, ClassStudent& graded) {
    student.files = filesBelow(student.folder, task_.grade.renderScenes ? sceneKind : pictureKind);
    std::vector<std::string> names, files;
    for (const ClassScene& scene : grades_.scenes) names.push_back(scene.reference);
    for (const std::vector<fs::path>* list :
         {&student.files.files, &student.files.others, &student.files.noFiles})
      for (const fs::path& file : *list)
        if (list == &student.files.files || !task_.grade.renderScenes || hasSceneSuffix(file))
          files.push_back(file.generic_string());
    if (task_.grade.renderScenes || runs()) student.everything = hashOfFolder(student.folder);
    const std::vector<std::string> assigned = assignSubmissions(names, files);
    if (!runs()) {
      graded.extra = withoutReference(names, files);
      graded.passedOver = passedOverBy(assigned, files, graded.extra);
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      GradedPair& pair = graded.pairs[i];
      pair.file = runs() ? "" : assigned[i];
      if (runs())
        runPair(student, references_[i], pair);
      else if (pair.file.empty()) {
        const std::string meant = fileMeant(pair.name, graded.extra);
        pair.verdict = Verdict::missing;
        if (!meant.empty()) pair.problem = "missing; there is " + meant;
      } else
        gradePair(student, references_[i], pair);
    }
  }

  void gradePair(const Submission& student, const Reference& reference, GradedPair& pair) {
    const std::string file = (fs::path(student.folder) / pair.file).generic_string();
    const auto unreadable = [&](std::string why) {
      pair.verdict = Verdict::unreadable;
      pair.problem = std::move(why);
    };
    if (!reference.picture) return unreadable("the reference cannot be read: " + reference.problem);
    if (!liesBelow(file, student.folder))
      return unreadable("it is a link that leads out of the student's folder");
    if (!isOrdinaryFile(file)) return unreadable("\"" + pair.file + "\" is not a file");
    checkOutputs(file);
    InputFiles inputs;
    judgeOrNote(pair, [&] {
      Hash hash;
      hash.add(optionsHash_);
      hash.add(reference.hash);
      hash.add(readFile(file));
      if (task_.grade.renderScenes) hash.add(student.everything), hash.add(pair.file);
      if (!task_.grade.scenes.empty()) hash.add(scenesHash_), hash.add(pair.name);
      const std::uint64_t key = hash.value();
      {
        const std::lock_guard lock(mutex_);
        if (results_.find(key, pair)) return;
      }
      std::string warnings;
      const PictureDifference d = difference(
          *reference.picture,
          task_.grade.renderScenes ? renderedScene(file, task_.grade, inputs, &warnings) : loadPicture(file),
          task_.grade.difference);
      judge(pair, d, task_.grade, inputs);
      noteWarnings(pair, warnings);
      if (task_.grade.keepsPictures && !passes(pair.verdict)) addThumbnails(pair, d);
      const std::lock_guard lock(mutex_);
      results_.add(key, pair);
      ++grades_.computed;
    });
    checkOutputs(inputs);
  }

  /// The student's program makes the picture.
  void runPair(const Submission& student, const Reference& reference, GradedPair& pair) {
    const std::string scene = sceneOf(task_.grade, pair.name);
    if (!reference.picture || scene.empty()) {
      pair.verdict = Verdict::unreadable;
      pair.problem = reference.picture ? "there is no scene of this name in " + task_.grade.scenes
                                       : "the reference cannot be read: " + reference.problem;
      return;
    }
    Hash hash;
    for (const std::uint64_t part : {optionsHash_, scenesHash_, reference.hash, student.everything})
      hash.add(part);
    hash.add(pair.name);
    const std::uint64_t key = hash.value();
    {
      const std::lock_guard lock(mutex_);
      if (results_.find(key, pair)) return;
    }
    double cpu = -1;
    InputFiles inputs;
    judgeOrNote(pair, [&] {
      const std::string suffix = fs::path(reference.path).extension().generic_string();
      const PictureDifference d =
          difference(*reference.picture, programPicture(task_.run, student.folder, scene, suffix, cpu),
                     task_.grade.difference);
      judge(pair, d, task_.grade, inputs);
      if (task_.grade.keepsPictures && !passes(pair.verdict)) addThumbnails(pair, d);
    });
    pair.cpu = cpu;
    pair.ourCpu = ourCpuOf(scene, reference.picture->picture);
    const std::lock_guard lock(mutex_);
    results_.add(key, pair);
    ++grades_.computed;
  }

  /// The processor time that Trace takes for the scene in the size of the reference; measured once, and kept.
  double ourCpuOf(const std::string& scene, const Picture& reference) {
    if (const auto known = ourCpu_.find(scene); known != ourCpu_.end()) return known->second;
    Hash hash;
    for (const std::uint64_t part : {optionsHash_, scenesHash_}) hash.add(part);
    hash.add("ours " + scene);
    GradedPair ours;
    {
      const std::lock_guard lock(mutex_);
      if (results_.find(hash.value(), ours)) return ourCpu_[scene] = ours.ourCpu;
    }
    judgeOrNote(ours, [&] {
      InputFiles inputs;
      GradeTask task = task_.grade;
      task.choices.push_back({"width", std::to_string(reference.width), {}});
      task.choices.push_back({"height", std::to_string(reference.height), {}});
      const double begin = os::cpuSeconds();
      renderedScene(scene, task, inputs);
      ours.ourCpu = os::cpuSeconds() - begin;
    });
    const std::lock_guard lock(mutex_);
    results_.add(hash.value(), ours);
    return ourCpu_[scene] = ours.ourCpu;
  }

  void addThumbnails(GradedPair& pair, const PictureDifference& d) const {
    pair.testPicture = thumbnailFile(d.test.picture);
    if (!d.numbers.sameSize) return;
    for (const Show& show : shows())
      if (show.name == "heat")
        pair.heatPicture = thumbnailFile(show.picture(d.pictures(), task_.grade.magnify));
  }

  void checkOutputs(const std::string& read) const {
    InputFiles inputs;
    inputs.noteRead(read, {});
    checkOutputs(inputs);
  }
  void checkOutputs(const InputFiles& inputs) const {
    for (const std::string* output : {&task_.grade.page, &task_.csv, &task_.results})
      if (!output->empty()) checkIsNoInput(*output, inputs);
  }

  /// So that a run that is killed loses a few seconds of work.
  void keepSometimes() {
    constexpr std::chrono::seconds kBetween{5};
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    if (now - saved_ < kBetween) return;
    results_.save(false);
    saved_ = now;
  }

  void addPoints() {
    for (ClassStudent& student : grades_.students) {
      for (std::size_t i = 0; i < student.pairs.size(); ++i) {
        const GradedPair& pair = student.pairs[i];
        student.points.push_back(grades_.scenes[i].points * task_.rubric.shareOf(pair));
        student.total += student.points.back();
        student.passed += passes(pair.verdict);
      }
    }
    std::sort(grades_.students.begin(), grades_.students.end(), [](const auto& a, const auto& b) {
      if (a.total != b.total) return a.total < b.total;
      return a.passed != b.passed ? a.passed < b.passed : a.name < b.name;
    });
  }

  const ClassTask& task_;
  ClassGrades grades_;
  std::vector<Reference> references_;
  std::vector<Submission> students_;
  std::uint64_t optionsHash_ = 0, scenesHash_ = 0;
  std::map<std::string, double> ourCpu_;  ///< by scene; used by one thread
  std::mutex mutex_;                      // guards the members below, and grades_.computed
  ClassResults results_;
  std::chrono::steady_clock::time_point saved_ = std::chrono::steady_clock::now();
};

}  // namespace

ClassGrades gradeClass(const ClassTask& task) { return ClassGrader(task).grade(); }

}  // namespace trace
