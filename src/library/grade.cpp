// A folder of pictures or scenes graded, for programs.
#include "app/compare/grade.h"

#include <algorithm>

#include "base/budget.h"
#include "base/files/file.h"
#include "image/comparison/flip.h"
#include "library/guard.h"
#include "library/scene_state.h"
#include "library/watched_work.h"

namespace traceray {
namespace {

Grade gradeOf(const trace::GradedPair& pair) {
  Grade one{.name = pair.name,
            .file = pair.file,
            .verdict = std::string(verdictText(pair.verdict)),
            .passed = passes(pair.verdict),
            .problem = pair.problem,
            .cause = pair.cause,
            .unit = pair.unit,
            .width = pair.width,
            .height = pair.height};
  for (std::size_t i = 0; i < pair.values.size(); ++i)
    one.metrics.emplace_back(trace::metrics()[i].name, pair.values[i]);
  return one;
}

}  // namespace

Grades grade(const std::string& folder, const std::string& reference, const GradeOptions& options,
             const OnProgress& progress) {
  std::exception_ptr thrown;  // by `progress`
  Grades grades = guarded([&] {
    trace::GradeTask task{.folder = folder,
                          .reference = reference,
                          .renderScenes = options.renderScenes,
                          .choices = choicesOf(options.options),
                          .strict = options.strict,
                          .difference = {options.tolerance, trace::usualPixelsPerDegree()},
                          .limits = {},
                          .keepsPictures = !options.page.empty(),
                          .page = options.page,
                          .sceneLimit = options.sceneLimit};
    for (const std::string& limit : options.limits) task.limits.push_back(trace::parseLimit(limit));
    if (!options.page.empty()) trace::checkWritable(options.page);
    trace::Grades found;
    trace::Budget budget;
    bool isStopped = false;
    const auto work = [&] { found = trace::grade(task); };
    if (progress) {
      const auto share = [&] { return budget.outermost().first.share; };
      const auto stop = [&] {
        isStopped = true;
        budget.letFinish();
        budget.limitTime(std::max(budget.seconds(), 1e-6));
      };
      thrown = runWatched(budget, work, progress, share, stop);
    } else {
      work();
    }
    if (!options.page.empty()) trace::writeFile(options.page, gradePage(task, found));
    Grades result{.pictures = {}, .extra = found.extra, .passed = found.passed, .stopped = found.stopped};
    if (isStopped && !found.stopped.empty()) result.stopped = "the caller stopped it";
    for (const trace::GradedPair& pair : found.pairs) result.pictures.push_back(gradeOf(pair));
    return result;
  });
  if (thrown) std::rethrow_exception(thrown);
  return grades;
}

}  // namespace traceray
