#include "base/budget.h"

#include <algorithm>
#include <exception>
#include <vector>

#include "base/error.h"
#include "base/looks.h"
#include "base/text.h"

namespace trace {
namespace {

constinit thread_local std::int64_t looksOfThread = 0;

/// With the innermost step first, as threads know them.
std::string inWords(const std::vector<Budget::Step>& steps) {
  std::string text;
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    text += (text.empty() ? "" : ", ") + std::string(step->doing);
    if (step->total > 0)
      text += " (" + std::to_string(step->done) + " of " + std::to_string(step->total) + " done)";
    else if (step->done > 0)
      text += " (" + std::to_string(step->done) + " done)";
  }
  return text;
}

}  // namespace

double Budget::seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

const Budget* Budget::lateOne() const {
  if (limit_ > 0 && seconds() > limit_) return this;
  return outer_ ? outer_->lateOne() : nullptr;
}

void Budget::look() const {
  if (look_) look_();
  const Budget* late = lateOne();
  if (!late) return;
  const std::string doing = doingNow();
  throw Error(
      Fault::limit,
      "the time limit of " + toText(late->limit_) + " s is over" + (doing.empty() ? "" : " while " + doing),
      "a larger --time-limit gives it longer; 0 never stops");
}

std::pair<Budget::Step, double> Budget::outermost() const {
  const std::lock_guard lock(mutex_);
  if (!outermost_) return {};
  Step step = outermost_->step();
  step.share = outermost_->share();
  return {step, outermost_->since_};
}

std::string Budget::brokenOff() const {
  const std::lock_guard lock(mutex_);
  return inWords({broken_.begin(), broken_.begin() + brokenCount_});
}

std::int64_t looksAtBudget() { return looksOfThread; }

void lookAtBudget() {
  ++looksOfThread;
  budgetOfThread.untilLook = kChecksBetweenLooks;
  if (budgetOfThread.budget) budgetOfThread.budget->look();
}

Work::Work(const char* doing, std::int64_t total)
    : doing_(doing),
      total_(total),
      budget_(budgetOfThread.budget),
      outer_(budgetOfThread.work),
      since_(budget_ ? budget_->seconds() : 0),
      exceptions_(std::uncaught_exceptions()) {
  budgetOfThread.work = this;
  if (!budget_) return;
  const std::lock_guard lock(budget_->mutex_);
  if (outer_ && outer_->budget_ == budget_) outer_->inner_ = this;
  if (outer_) return;
  budget_->outermost_ = this;
  budget_->brokenCount_ = 0;
}

Work::~Work() {
  budgetOfThread.work = outer_;
  if (!budget_) return;
  const std::lock_guard lock(budget_->mutex_);
  if (budget_->outermost_ == this) budget_->outermost_ = nullptr;
  if (outer_ && outer_->inner_ == this) outer_->inner_ = nullptr;
  if (std::uncaught_exceptions() == exceptions_)
    budget_->brokenCount_ = 0;  // whatever was thrown inside was dealt with
  else if (budget_->brokenCount_ < Budget::kMostSteps)
    budget_->broken_[budget_->brokenCount_++] = step();
}

double Work::share() const {
  if (total_ <= 0) return 0;
  const double begun = inner_ ? inner_->share() : 0;
  return std::min(1.0, (static_cast<double>(done_) + begun) / static_cast<double>(total_));
}

std::string doingNow() {
  std::vector<Budget::Step> steps;
  for (const Work* work = budgetOfThread.work; work; work = work->outer_) steps.push_back(work->step());
  return inWords(steps);
}

}  // namespace trace
