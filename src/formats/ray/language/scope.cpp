#include "formats/ray/language/scope.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/budget.h"
#include "base/files/file.h"
#include "base/text.h"
#include "formats/ray/language/language.h"
#include "formats/ray/read/objects.h"
#include "formats/ray/read/placement.h"
#include "formats/text_front.h"
#include "math/noise.h"

namespace trace::rayfile {
namespace {

constexpr std::array<std::string_view, 8> kStatementWords{"let", "define", "for",     "in",
                                                          "if",  "else",   "include", "group"};
constexpr std::array<std::string_view, 5> kConstants{"pi", "tau", "time", "true", "false"};

bool isSameInSmallLetters(std::string_view a, std::string_view b) {
  const auto small = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return small(x) == small(y); });
}

bool holdsTree(const Value& value) {
  return value.tree() || (value.list() && std::any_of(value.list()->begin(), value.list()->end(), holdsTree));
}

}  // namespace

Names::Names(Syntax& syntax, InputFiles& inputs) : syntax_(syntax), inputs_(inputs) {
  for (const std::string_view word : knownWords()) objects_.insert(word);
  reserved_.insert(kStatementWords.begin(), kStatementWords.end());
  reserved_.insert(kConstants.begin(), kConstants.end());
}

Names::~Names() {
  for (const Scoped& scope : rings_)
    for (Binding& binding : scope->bindings) binding.value.reset();
}

void Names::noteRing(const Scoped& scope, const Value& value) {
  if (holdsTree(value)) rings_.push_back(scope);
}

void Names::step(std::uint32_t index) {
  checkBudget();
  if (++steps_ > kMostSteps) {
    throw Error(Fault::limit, syntax_.place(node(index).offset),
                "expected a scene of at most " + std::to_string(kMostSteps) + " steps, found more", chain());
  }
}

void Names::declare(std::uint32_t block, Scope& scope) {
  for (std::uint32_t child = block + 1; child < after(block); child = after(child)) {
    if (kind(child) == Kind::let || kind(child) == Kind::define) {
      try {
        add(child, scope);
      } catch (const Failure& failure) {
        syntax_.note(failure.mistake);
      }
    }
    if (kind(child) == Kind::include) include(child, scope);
  }
}

void Names::add(std::uint32_t statement, Scope& scope) {
  const std::uint32_t name = statement + 1;
  const std::string_view text = at(name).text();
  const bool takes = kind(statement) == Kind::define || kind(statement + 2) == Kind::tuple;
  checkName(name, takes && after(statement + 2) < after(statement) ? Named::call : Named::value);
  for (const Binding& other : scope.bindings)
    if (other.name == text)
      fail(name, "expected a new name, found \"" + std::string(text) + "\" again",
           "it is defined at " + placeText(syntax_.place(node(other.node).offset)) +
               "; nothing is assigned twice");
  scope.bindings.push_back({text, statement});
}

void Names::checkName(std::uint32_t name, Named what) const {
  const std::string_view text = at(name).text();
  if (reserved_.contains(text) || (what == Named::call && objects_.contains(text)))
    fail(name, "expected a new name, found \"" + std::string(text) + "\", which has a meaning already");
}

void Names::include(std::uint32_t statement, Scope& scope) {
  const std::uint32_t word = statement + 1;
  const std::string name(at(word).text());
  const std::string from = syntax_.place(node(word).offset).file;
  const std::string path = besideFile(from, name);
  if (!included_.insert(path).second) return;
  std::string text;
  try {
    text = readBeside(from, name, inputs_);
  } catch (const Error& error) {
    throw Error(error.fault(), syntax_.place(node(word).offset), "include: " + error.messages().front().what,
                error.messages().front().hint);
  }
  const TextFront front(path, text);
  const std::uint32_t root = syntax_.include(path, std::string(front.text()));
  roots_.emplace(statement, root);
  declare(root, scope);
}

Names::Found Names::find(std::string_view name, const Scoped& from) const {
  if (name.empty()) return {};
  const Scope* skipped = nullptr;
  for (const Scoped* scope = &from; *scope; scope = &(*scope)->parent) {
    if ((*scope)->hides == name) skipped = (*scope)->parent.get();
    for (Binding& binding : (*scope)->bindings)
      if (binding.name == name && !binding.isActive && scope->get() != skipped) return {&binding, *scope};
  }
  return {};
}

std::string Names::nameHint(std::string_view text, Scoped scope) const {
  std::vector<std::string_view> names;
  for (; scope; scope = scope->parent)
    for (const Binding& binding : scope->bindings) {
      if (binding.name == text && binding.isActive) return "the value of a name cannot use the name";
      if (binding.name != text) names.push_back(binding.name);
    }
  if (text.size() > 1) names.insert(names.end(), kConstants.begin(), kConstants.end());
  std::string hint = didYouMean(text, names);
  for (const std::string_view name : names)  // also of one letter, which is like every other
    if (hint.empty() && isSameInSmallLetters(name, text))
      hint = "did you mean \"" + std::string(name) + "\"?";
  return hint.empty() ? "let " + std::string(text) + " = 1 makes one" : hint;
}

void Names::refuseDash(std::uint32_t index, const Scoped& scope) const {
  const std::string_view text = wordAt(index);
  const std::size_t dash = text.find('-');
  if (dash == text.npos || !find(text.substr(0, dash), scope).binding) return;
  fail(index, "no value is called \"" + std::string(text) + "\"",
       "write \"" + std::string(text.substr(0, dash)) + " - " + std::string(text.substr(dash + 1)) +
           "\": names may have dashes in them");
}

std::shared_ptr<Scope> Names::inside(std::uint32_t block, const Scoped& scope) const {
  return std::make_shared<Scope>(Scope{scope, seedAt(block, *scope), block});
}

std::uint64_t Names::seedAt(std::uint32_t index, const Scope& scope) const {
  auto [known, isNew] = ordinals_.try_emplace({scope.block, index}, 0);
  if (isNew) {
    const std::string_view name = nameAt(index);
    for (std::uint32_t i = scope.block; i < index; ++i)
      known->second += kind(i) == kind(index) && nameAt(i) == name;
  }
  std::uint64_t seed = mixBits(scope.seed ^ static_cast<std::uint64_t>(kind(index)));
  for (const char c : nameAt(index)) seed = mixBits(seed ^ static_cast<unsigned char>(c));
  return mixBits(seed ^ known->second);
}

std::string_view Names::nameAt(std::uint32_t index) const {
  return kind(index) == Kind::call ? at(index + 1).text() : std::string_view();
}

Names::FrameScope::FrameScope(Names& names, std::uint32_t at, std::string what)
    : names_(names), index_(names.frames_.size()) {
  if (names_.calls_ >= kMostCalls) names_.tooDeep(at);
  ++names_.calls_;
  names_.frames_.push_back(
      {static_cast<std::uint32_t>(names_.result_.size()), 0, names_.node(at).offset, std::move(what)});
  names_.active_.push_back(this);
}

Names::FrameScope::FrameScope(Names& names, std::uint32_t at, std::string_view function, const Scope& own)
    : FrameScope(names, at, std::string()) {
  function_ = function;
  own_ = &own;
  parameters_ = own.bindings.size();
}

std::string Names::FrameScope::what() const {
  return own_ ? callText(function_, *own_, parameters_) : names_.frames_[index_].what;
}

Names::FrameScope::~FrameScope() {
  --names_.calls_;
  names_.active_.pop_back();
  Syntax::Frame& frame = names_.frames_[index_];
  frame.end = static_cast<std::uint32_t>(names_.result_.size());
  if (frame.end == frame.first && index_ + 1 == names_.frames_.size())
    names_.frames_.pop_back();
  else if (own_)
    frame.what = what();
}

std::string Names::callText(std::string_view name, const Scope& own, std::size_t parameters) {
  std::string text = std::string(name) + "(";
  for (std::size_t i = 0; i < parameters; ++i)
    text += (i == 0 ? "" : ", ") + std::string(own.bindings[i].name) + " = " +
            trace::rayfile::shown(*own.bindings[i].value);
  return text + ")";
}

std::string Names::whatOf(std::size_t frame) const {
  const auto active = std::find_if(active_.begin(), active_.end(),
                                   [&](const FrameScope* scope) { return scope->index() == frame; });
  return active == active_.end() ? frames_[frame].what : (*active)->what();
}

std::string Names::chain() const {
  constexpr std::size_t kMostFrames = 8;
  std::string text;
  std::size_t shown = 0;
  for (auto active = active_.rbegin(); active != active_.rend() && shown < kMostFrames; ++shown) {
    const FrameScope& innermost = **active;
    const Syntax::Frame& frame = frames_[innermost.index()];
    std::size_t same = 0;
    while (active != active_.rend() && frames_[(*active)->index()].offset == frame.offset) ++active, ++same;
    text +=
        (text.empty() ? "in " : ", in ") + innermost.what() + " at " + placeText(syntax_.place(frame.offset));
    if (same > 1) text += " and " + std::to_string(same - 1) + " more there";
  }
  return text;
}

void Names::fail(std::uint32_t index, std::string what, std::string hint) const {
  const std::string where = chain();
  if (!where.empty()) hint += (hint.empty() ? "" : "; ") + where;
  throw Failure{{node(index).offset, std::move(what), std::move(hint)}};
}

void Names::tooDeep(std::uint32_t index, int most, const std::string& levels) const {
  try {
    fail(index, "expected at most " + std::to_string(most) + " " + levels + ", found more",
         "a recursion needs a condition that ends it");
  } catch (Failure& failure) {
    failure.deep = true;
    throw;
  }
}
void Names::tooDeep(std::uint32_t index) const {
  tooDeep(index, kMostCalls, "calls and loops within one another");
}

}  // namespace trace::rayfile
