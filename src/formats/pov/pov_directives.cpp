// The tokens of a scene after its directives: conditions, loops, names, macros and included files.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/budget.h"
#include "base/files/file.h"
#include "base/files/named_file.h"
#include "base/files/read_scope.h"
#include "formats/pov/pov_reader.h"
#include "formats/text_front.h"

namespace trace::pov {
namespace {

/// Debian's package povray-includes.
constexpr const char* kLibrary[]{"/usr/share/povray-3.7/include", "/usr/share/povray/include",
                                 "/usr/share/fonts/truetype/povray"};

bool opensBlock(std::string_view d) {
  return d == "if" || d == "ifdef" || d == "ifndef" || d == "while" || d == "for" || d == "switch" ||
         d == "macro";
}

}  // namespace

Reader::Reader(const std::string& file, std::string_view text, InputFiles& inputs, SceneTime& time,
               Messages& messages)
    : file_(file), inputs_(inputs), time_(time), messages_(messages) {
  sources_.push_back(std::make_unique<Source>(file, std::string(text)));
  const Source& source = *sources_.back();
  frames_.push_back({&source, 0, source.tokens.size() - 1, 0, 0, false});
  scopes_.emplace_back();
  defaultPigment_ = std::make_shared<PigmentNode>();
  defaultFinish_ = std::make_shared<FinishNode>();
  auto plain = std::make_shared<TextureNode>();
  plain->layers.push_back({defaultPigment_, nullptr, defaultFinish_, {}, {}, {}});
  world_.defaultTexture = plain;
}

World Reader::read() {
  while (!peek().is(Token::Kind::end)) statement();
  if (!blocks_.empty())
    fail(blocks_.back().directive, "#" + std::string(blocks_.back().directive.text) + " without an #end",
         "each #if, #while, #for, #switch and #macro has its #end");
  return std::move(world_);
}

// --- tokens ---

SourcePlace Reader::place(const Token& at) const {
  return at.source ? at.source->place(at.offset) : SourcePlace{.file = file_};
}

void Reader::fail(const Token& at, const std::string& what, const std::string& hint) {
  std::string chain;
  int shown = 0;
  for (std::size_t i = frames_.size(); i-- > 1 && shown < 3;) {
    const Frame& outer = frames_[i - 1];
    if (outer.at == 0) continue;
    const SourcePlace from = place(outer.source->tokens[outer.at - 1]);
    chain += (chain.empty() ? "" : ", ") +
             std::string(frames_[i].macro ? "in a macro called at " : "included at ") + from.file.str() +
             ":" + std::to_string(from.line);
    ++shown;
  }
  throw Error(Fault::scene, place(at), what + (chain.empty() ? "" : " (" + chain + ")"), hint);
}

void Reader::expected(std::string_view what, const std::string& hint) {
  const Token at = peek();
  fail(at, "expected " + std::string(what) + ", found " + describe(at), hint);
}

void Reader::leaveOut(const Token& at, const std::string& what, const std::string& hint) {
  if (left_) {  // a part of a texture: told where it is used
    left_->emplace_back(what + " is left out", place(at));
    return;
  }
  if (!warnings_.again(what + " is left out")) warnings_.warn(place(at), what + " is left out", hint);
}

void Reader::spend(const Token& at) {
  checkBudget();
  if (++steps_ > kMostSteps)
    throw Error(Fault::limit, place(at),
                "the scene's loops and macros take more than " + std::to_string(kMostSteps / 1'000'000) +
                    " million steps",
                "make the loops shorter");
}

const Token& Reader::peek() {
  if (!hasAhead_) fetch();
  return ahead_;
}

Token Reader::next() {
  if (!hasAhead_) fetch();
  hasAhead_ = false;
  stop_.begun = true;
  if (ahead_.is(Token::Kind::mark)) {
    const char c = ahead_.text[0];
    if (c == '{' || c == '(' || c == '[') ++nest_;
    if (c == '}' || c == ')' || c == ']') --nest_;
  }
  return ahead_;
}

void Reader::fetch() {
  while (!hasAhead_) {
    Frame& frame = frames_.back();
    if (frame.at >= frame.end) {
      if (blocks_.size() > frame.blocks)
        fail(blocks_.back().directive, "#" + std::string(blocks_.back().directive.text) + " without an #end",
             "each #if, #while, #for and #switch has its #end");
      if (frames_.size() == 1) {
        ahead_ = frame.source->tokens.back();
        hasAhead_ = true;
        return;
      }
      scopes_.resize(frame.scopes);
      frames_.pop_back();
      continue;
    }
    const Token& token = frame.source->tokens[frame.at];
    spend(token);
    if (token.is(Token::Kind::directive)) {
      if (stop_.active && stop_.begun && stop_.frames == frames_.size() && stop_.nest == nest_) {
        ahead_ = token;
        hasAhead_ = true;
        return;
      }
      ++frame.at;
      const Token at = token;
      directive(at);
      continue;
    }
    ++frame.at;
    if (token.is(Token::Kind::name)) {
      if (Slot* slot = find(token.text))
        if (const auto* macro = (*slot)->as<Ref<Macro>>()) {
          const Ref<Macro> called = *macro;
          const Token at = token;
          callMacro(called, at);
          continue;
        }
    }
    ahead_ = token;
    hasAhead_ = true;
  }
}

Token Reader::raw() {
  if (hasAhead_) {
    hasAhead_ = false;
    return ahead_;
  }
  Frame& frame = frames_.back();
  if (frame.at >= frame.end) return frame.source->tokens[frame.end];
  spend(frame.source->tokens[frame.at]);
  return frame.source->tokens[frame.at++];
}

const Token& Reader::rawPeek() const {
  if (hasAhead_) return ahead_;
  const Frame& frame = frames_.back();
  return frame.source->tokens[std::min(frame.at, frame.source->tokens.size() - 1)];
}

void Reader::skipSemicolon() {
  if (hasAhead_ ? ahead_.isMark(";") : frames_.back().at < frames_.back().end && rawPeek().isMark(";")) raw();
}

bool Reader::takesMark(std::string_view mark) {
  if (!peek().isMark(mark)) return false;
  next();
  return true;
}

bool Reader::takesName(std::string_view name) {
  if (!peek().isName(name)) return false;
  next();
  return true;
}

void Reader::expectMark(std::string_view mark, std::string_view after) {
  if (!takesMark(mark)) expected("\"" + std::string(mark) + "\" " + std::string(after));
}

Slot* Reader::find(std::string_view name) {
  const std::string key(name);
  // A macro sees its own names, those of the file that is read, and the global ones.
  for (std::size_t i = scopes_.size(); i-- > 0;) {
    const auto found = scopes_[i].find(key);
    if (found != scopes_[i].end()) return &found->second;
  }
  return nullptr;
}

/// Runs body() with the directives behind its end left for later.
template <class Body>
auto Reader::untilDirective(Body&& body) {
  const Stop before = stop_;
  stop_ = {true, nest_, frames_.size(), false};
  struct Restore {
    Reader& reader;
    Stop from;
    ~Restore() {
      reader.stop_ = from;
      if (reader.hasAhead_ && reader.ahead_.is(Token::Kind::directive)) reader.hasAhead_ = false;
    }
  } restore{*this, before};
  return body();
}

// --- conditions and loops ---

Numbers Reader::condition() {
  return untilDirective([&] {
    if (!takesMark("(")) expected("\"(\" and a condition");
    const Numbers value = expression(true);
    expectMark(")", "after the condition");
    constexpr std::string_view kOperators = "&|*/=>!";  // < begins a vector
    const Token& after = rawPeek();
    if (after.is(Token::Kind::mark) && kOperators.find(after.text[0]) != std::string_view::npos)
      return binary(0, value, true);
    return value;
  });
}

void Reader::directive(const Token& at) {
  const std::string_view d = at.text;
  if (d == "declare" || d == "local") return declare(d == "local");
  if (d == "if" || d == "ifdef" || d == "ifndef") return branch(at);
  if (d == "else" || d == "elseif") return elseBranch(at);
  if (d == "end") return endBlock(at);
  if (d == "while") return loop(at);
  if (d == "for") return countLoop(at);
  if (d == "switch") return choose(at);
  if (d == "case" || d == "range") {  // reached from the case before: it continues
    untilDirective([&] {
      expectMark("(", "after #" + std::string(d));
      expression(true);
      if (d == "range") comma(), expression(true);
      expectMark(")", "after the value");
      return 0;
    });
    return;
  }
  if (d == "break") return breakOut(at);
  if (d == "macro") return defineMacro(at);
  if (d == "include") return include(at);
  if (d == "default") return setDefault();
  if (d == "undef") {
    const Token name = raw();
    for (std::size_t i = scopes_.size(); i-- > 0;)
      if (scopes_[i].erase(std::string(name.text))) break;
    return skipSemicolon();
  }
  if (d == "version") {
    world_.version = untilDirective([&] { return number(); });
    return skipSemicolon();
  }
  if (d == "debug" || d == "render" || d == "statistics" || d == "warning") {
    const std::string said = untilDirective([&] { return text(); });
    if (d == "debug" || d == "warning") say(at, said);
    return skipSemicolon();
  }
  if (d == "error") {
    const std::string said = untilDirective([&] { return text(); });
    fail(at, "the scene ends itself by #error: " + said.substr(0, 200));
  }
  if (d == "fopen") {
    const Token name = raw();
    untilDirective([&] { return text(); });
    const Token how = raw();
    if (how.text == "read")
      fail(at, "#fopen " + std::string(name.text) + " reads a file of data, which Trace does not");
    if (!warnings_.again("fopen"))
      warnings_.warn(place(at), "#fopen and #write write a file, which Trace does not",
                     "the picture is the same", "fopen");
    return;
  }
  if (d == "fclose") {
    raw();
    return;
  }
  if (d == "write") {
    int depth = 0;
    do {
      const Token t = raw();
      depth += t.isMark("(") ? 1 : t.isMark(")") ? -1 : 0;
      if (t.is(Token::Kind::end)) fail(at, "#write without its closing bracket");
    } while (depth > 0);
    return skipSemicolon();
  }
  if (d.empty()) return warnings_.warn(place(at), "a # without a directive is left out", {}, "#");
  if (d == "read") fail(at, "#read reads a file of data, which Trace does not");
  fail(at, "#" + std::string(d) + " is no directive",
       "the directives are #declare, #local, #macro, #if, #while, #for, #switch, #include, #default ...");
}

void Reader::branch(const Token& at) {
  bool holds = false;
  if (at.text == "if") {
    holds = condition()[0] != 0;
  } else {
    const Token open = raw();
    if (!open.isMark("(")) fail(open, "expected \"(\" and a name, found " + describe(open));
    ++nest_;
    const Token name = raw();
    holds = isDefined(name);
    expectMark(")", "after the name");
    if (at.text == "ifndef") holds = !holds;
  }
  blocks_.push_back({.kind = Block::Kind::condition, .taken = holds, .directive = at});
  if (!holds) skipBlock(true, false, at);
}

bool Reader::isDefined(const Token& name) {
  Slot* slot = find(name.text);
  if (!slot) return false;
  Slot element = *slot;
  while (rawPeek().isMark("[")) {
    expectMark("[", "");
    const int i = whole();
    expectMark("]", "after the index");
    const auto* array = element ? element->as<std::shared_ptr<Array>>() : nullptr;
    if (!array) return false;
    const Array& a = **array;
    if (i < 0 || static_cast<std::size_t>(i) >= a.elements.size()) return false;
    element = a.elements[static_cast<std::size_t>(i)];
  }
  return element && !element->none();
}

/// Skips to the #else or #elseif of the block, or over its #end, which then is handled.
void Reader::skipBlock(bool stopsAtElse, bool stopsAtCase, const Token& from) {
  Frame& frame = frames_.back();
  int depth = 0;
  while (frame.at < frame.end) {
    const Token& t = frame.source->tokens[frame.at];
    spend(t);
    ++frame.at;
    if (!t.is(Token::Kind::directive)) continue;
    if (opensBlock(t.text)) ++depth;
    if (t.text == "end" && depth-- == 0) return endBlock(t);
    if (depth > 0) continue;
    if (stopsAtElse && (t.text == "else" || t.text == "elseif")) {
      if (t.text == "else") return;
      Block& block = blocks_.back();
      const bool holds = condition()[0] != 0;
      block.taken = holds;
      if (holds) return;
    }
    if (stopsAtCase && (t.text == "case" || t.text == "range" || t.text == "else")) {
      --frame.at;
      return;
    }
  }
  fail(from, "#" + std::string(from.text) + " without an #end");
}

void Reader::elseBranch(const Token& at) {
  if (blocks_.size() <= frames_.back().blocks)
    fail(at, "#" + std::string(at.text) + " without an #if before it");
  if (blocks_.back().kind == Block::Kind::choice) return;  // the case before continues here
  skipBlock(false, false, blocks_.back().directive);
}

void Reader::endBlock(const Token& at) {
  if (blocks_.size() <= frames_.back().blocks)
    fail(at, "#end without an #if, #while, #for or #switch before it");
  Block& block = blocks_.back();
  Frame& frame = frames_.back();
  if (block.kind == Block::Kind::loop && !block.taken) {
    const std::size_t after = frame.at;
    frame.at = block.start;
    if (condition()[0] != 0) return;
    frame.at = after;
  }
  if (block.kind == Block::Kind::count && !block.taken) {
    const auto* now = block.counter->as<Numbers>();
    const Real t = (now ? (*now)[0] : 0) + block.step;
    *block.counter = Value{Numbers(t)};
    const Real slack = std::abs(block.step) * 1e-6;
    if (block.step > 0 ? t <= block.last + slack : t >= block.last - slack) {
      frame.at = block.start;
      return;
    }
  }
  blocks_.pop_back();
}

void Reader::loop(const Token& at) {
  const std::size_t start = frames_.back().at;
  const bool holds = condition()[0] != 0;
  blocks_.push_back({.kind = Block::Kind::loop, .start = start, .taken = !holds, .directive = at});
  if (!holds) skipBlock(false, false, at);
}

void Reader::countLoop(const Token& at) {
  Block block{.kind = Block::Kind::count, .directive = at};
  const Token open = raw();
  if (!open.isMark("(")) fail(open, "expected \"(NAME, first, last)\", found " + describe(open));
  ++nest_;
  const Token name = raw();
  if (!name.is(Token::Kind::name)) fail(name, "expected the name of a counter, found " + describe(name));
  Slot& slot = scopes_.back()[std::string(name.text)];
  block.counter = slot = std::make_shared<Value>();
  comma();
  const Real first = number(true);
  comma();
  block.last = number(true);
  if (takesMark(",")) block.step = number(true);
  expectMark(")", "after the loop's numbers");
  if (block.step == 0) fail(at, "a #for with steps of 0 never ends");
  *block.counter = Value{Numbers(first)};
  block.start = frames_.back().at;
  const bool runs = block.step > 0 ? first <= block.last : first >= block.last;
  block.taken = !runs;
  blocks_.push_back(block);
  if (!runs) skipBlock(false, false, at);
}

void Reader::choose(const Token& at) {
  Block block{.kind = Block::Kind::choice, .chosen = condition()[0], .directive = at};
  blocks_.push_back(block);
  seekCase(blocks_.back(), at);
}

/// Goes to the first case that fits; true if there is one.
bool Reader::seekCase(Block& block, const Token& from) {
  const Real chosen = block.chosen;
  const std::size_t level = blocks_.size();
  for (;;) {
    skipBlock(false, true, from);
    if (blocks_.size() < level) return false;  // it ended
    const Token at = frames_.back().source->tokens[frames_.back().at++];
    if (at.text == "else") return true;
    const bool fits = untilDirective([&] {
      expectMark("(", "after #" + std::string(at.text));
      const Real a = number(true);
      Real b = a;
      if (at.text == "range") comma(), b = number(true);
      expectMark(")", "after the value");
      return at.text == "range" ? chosen >= a && chosen <= b : std::abs(chosen - a) < 1e-10;
    });
    if (fits) return true;
  }
}

void Reader::breakOut(const Token& at) {
  std::size_t i = blocks_.size();
  while (i > frames_.back().blocks && blocks_[i - 1].kind == Block::Kind::condition) --i;
  if (i == frames_.back().blocks) {  // it ends a macro
    if (!frames_.back().macro) fail(at, "#break outside of a loop, a #switch and a macro");
    blocks_.resize(frames_.back().blocks);
    frames_.back().at = frames_.back().end;
    return;
  }
  // Skips to the end of the block, over the conditions in it.
  std::size_t ends = blocks_.size() - i + 1;
  Block& block = blocks_[i - 1];
  block.taken = true;
  while (ends-- > 0) skipBlock(false, false, at);
}

// --- names ---

Slot Reader::elementSlot(Slot slot, const Token& name) {
  while (rawPeek().isMark("[")) {
    expectMark("[", "");
    const int i = whole();
    expectMark("]", "after the index");
    const auto* array = slot ? slot->as<std::shared_ptr<Array>>() : nullptr;
    if (!array) fail(name, "\"" + std::string(name.text) + "\" has no such dimension");
    Array& a = **array;
    if (i < 0 || static_cast<std::size_t>(i) >= a.elements.size())
      fail(name,
           "index " + std::to_string(i) + " of \"" + std::string(name.text) + "\", which has " +
               std::to_string(a.elements.size()) + " elements",
           "the first index is 0");
    Slot& element = a.elements[static_cast<std::size_t>(i)];
    if (!element) element = std::make_shared<Value>();
    slot = element;
  }
  return slot;
}

void Reader::declare(bool local) {
  const std::size_t scope = local ? scopes_.size() - 1 : 0;  // a macro in the value has one of its own
  Token name = raw();
  while (name.isName("deprecated") || name.isName("once") || name.is(Token::Kind::string)) name = raw();
  if (!name.is(Token::Kind::name)) fail(name, "expected a name, found " + describe(name));
  const std::string key(name.text);
  Slot slot;
  if (local) {
    const auto found = scopes_[scope].find(key);
    if (found != scopes_[scope].end()) slot = found->second;
  } else if (Slot* known = find(key)) {
    slot = *known;
  }
  const bool element = rawPeek().isMark("[");
  if (element) {
    if (!slot)
      if (Slot* known = find(key)) slot = *known;
    if (!slot) fail(name, "\"" + key + "\" is not declared", "declare it first as an array[N]");
    slot = elementSlot(slot, name);
  }
  const Token equals = raw();
  if (!equals.isMark("=")) fail(equals, "expected \"=\" after the name, found " + describe(equals));
  Value value = untilDirective([&] { return anyValue(); });
  skipSemicolon();
  if (element) {
    *slot = std::move(value);
  } else if (slot && !slot->as<Ref<Macro>>()) {
    *slot = std::move(value);
  } else {
    scopes_[scope][key] = std::make_shared<Value>(std::move(value));
  }
}

void Reader::defineMacro(const Token& at) {
  const Token name = raw();
  if (!name.is(Token::Kind::name)) fail(name, "expected the name of the macro, found " + describe(name));
  auto macro = std::make_shared<Macro>();
  macro->name = std::string(name.text);
  const Token open = raw();
  if (!open.isMark("(")) fail(open, "expected \"(\" after the macro's name, found " + describe(open));
  for (Token t = raw(); !t.isMark(")"); t = raw()) {
    if (t.isMark(",") || t.isName("optional")) continue;
    if (!t.is(Token::Kind::name)) fail(t, "expected the name of a parameter, found " + describe(t));
    macro->parameters.emplace_back(t.text);
  }
  Frame& frame = frames_.back();
  macro->source = frame.source;
  macro->begin = frame.at;
  int depth = 0;
  for (;; ++frame.at) {
    if (frame.at >= frame.end) fail(at, "#macro " + macro->name + " without an #end");
    const Token& t = frame.source->tokens[frame.at];
    if (!t.is(Token::Kind::directive)) continue;
    if (opensBlock(t.text)) ++depth;
    if (t.text == "end" && depth-- == 0) break;
  }
  macro->end = frame.at++;
  scopes_.front()[macro->name] = std::make_shared<Value>(Value{Ref<Macro>(macro)});
}

void Reader::callMacro(const Ref<Macro>& macro, const Token& at) {
  if (frames_.size() >= kMostFrames)
    throw Error(Fault::limit, place(at),
                "macros and files within each other more than " + std::to_string(kMostFrames) +
                    " deep: " + macro->name + " is called again",
                "a recursion needs an #if that ends it");
  Scope own;
  const Stop before = stop_;
  stop_ = {};
  expectMark("(", "after the macro's name");
  std::size_t given = 0;
  while (!peek().isMark(")")) {
    Slot slot;
    const Token& t = peek();
    if (t.is(Token::Kind::name) && !frames_.empty()) {
      // A name alone is shared with the macro.
      Slot* known = find(t.text);
      const Frame& frame = frames_.back();
      if (known && frame.at < frame.end) {
        const Token& behind = frame.source->tokens[frame.at];
        if (behind.isMark(",") || behind.isMark(")")) {
          slot = *known;
          next();
        }
      }
    }
    if (!slot) {
      if (peek().isMark(",")) {
        slot = nullptr;
      } else {
        slot = std::make_shared<Value>(anyValue());
      }
    }
    if (given < macro->parameters.size() && slot) own[macro->parameters[given]] = slot;
    ++given;
    if (!takesMark(",") && given >= macro->parameters.size()) break;  // commas may lack
  }
  if (!peek().isMark(")")) expected("\",\" or \")\" after an argument of " + macro->name);
  next();
  stop_ = before;
  if (given > macro->parameters.size())
    fail(at, macro->name + " has " + std::to_string(macro->parameters.size()) + " parameters, found " +
                 std::to_string(given) + " arguments");
  const std::size_t scopes = scopes_.size();
  scopes_.push_back(std::move(own));
  frames_.push_back({macro->source, macro->begin, macro->end, blocks_.size(), scopes, true});
}

void Reader::include(const Token& at) {
  const std::string name = untilDirective([&] { return text(); });
  if (frames_.size() >= kMostFrames)
    throw Error(Fault::limit, place(at),
                "files within each other more than " + std::to_string(kMostFrames) + " deep: " + name,
                "a file that includes itself needs an #ifndef around its text");
  const Source* source = nullptr;
  const auto found = known_.find(name);
  if (found != known_.end()) {
    source = found->second;
  } else {
    std::string bytes, path;
    const std::string& from = frames_.back().source->file;
    std::string beside = namesFile(from, name) ? from : namesFile(file_, name) ? file_ : std::string();
    if (!beside.empty()) {
      try {
        bytes = readTextBeside(beside, name, inputs_, messages_);
        path = namedFile(beside, name).path;
      } catch (const ReadDenied& denied) {
        denied.at(place(at));
      }
    } else {
      // Only a plain name, which cannot lead out of the folder.
      const bool plain = name.find_first_of("/\\") == std::string::npos && name != "..";
      for (const char* folder : kLibrary) {
        const std::string candidate = std::string(folder) + "/" + name;
        if (!plain || !path.empty() || !isOrdinaryFile(candidate)) continue;
        const ReadScope library(std::vector<std::string>{folder});
        checkMayRead(candidate);
        const std::string packed = readFile(candidate);
        const TextFront front(candidate, packed, messages_);
        bytes = std::string(front.text());
        path = candidate;
        inputs_.noteRead(candidate, packed);
      }
      if (path.empty())
        fail(at, "\"" + name + "\" is neither beside the file nor in the folder of POV-Ray's include files",
             "Debian's package povray-includes has the usual ones");
    }
    sources_.push_back(std::make_unique<Source>(path, std::move(bytes)));
    source = sources_.back().get();
    known_.emplace(name, source);
  }
  skipSemicolon();
  const std::size_t scopes = scopes_.size();
  scopes_.emplace_back();
  frames_.push_back({source, 0, source->tokens.size() - 1, blocks_.size(), scopes, false});
}

/// The bytes of a picture or font: beside the file that names it, or in the library.
std::string Reader::readNamed(const Token& at, const std::string& name) {
  const std::string& from = at.source->file;
  for (const std::string& beside : {from, file_})
    if (namesFile(beside, name)) try {
        return readBeside(beside, name, inputs_);
      } catch (const ReadDenied& denied) {
        denied.at(place(at));
      }
  if (name.find_first_of("/\\") == std::string::npos && name != "..")
    for (const char* folder : kLibrary) {
      const std::string candidate = std::string(folder) + "/" + name;
      if (!isOrdinaryFile(candidate)) continue;
      const ReadScope library(std::vector<std::string>(std::begin(kLibrary), std::end(kLibrary)));
      checkMayRead(candidate);
      std::string bytes = readFile(candidate);
      inputs_.noteRead(candidate, bytes);
      return bytes;
    }
  throw Error(Fault::io, place(at),
              "\"" + name + "\" is neither beside the file nor in the library of POV-Ray");
}

/// Each line of what a scene says of itself, until it says too much.
void Reader::say(const Token& at, const std::string& text) {
  constexpr std::size_t kMostLines = 20, kLongest = 200;
  const std::string by = at.text == "warning" ? "the scene warns: " : "#debug: ";
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string line = by + text.substr(start, std::min(end - start, kLongest));
    start = end + 1;
    if (line == by || warnings_.again(line)) continue;
    if (at.text == "debug" && debugLines_++ >= kMostLines) return;
    warnings_.warn(place(at), line);
  }
}

void Reader::setDefault() {
  expectMark("{", "after #default");
  while (!peek().isMark("}")) {
    const Token t = peek();
    if (t.isName("texture")) {
      next();
      world_.defaultTexture = texture();
      const TextureNode::Layer& first = world_.defaultTexture->layers.front();
      if (first.pigment) defaultPigment_ = first.pigment;
      if (first.normal) defaultNormal_ = first.normal;
      if (first.finish) defaultFinish_ = first.finish;
      continue;
    }
    if (t.isName("pigment")) {
      next();
      defaultPigment_ = pigment();
    } else if (t.isName("normal")) {
      next();
      defaultNormal_ = normal();
    } else if (t.isName("finish")) {
      next();
      defaultFinish_ = finish();
    } else if (t.isName("camera")) {
      next();
      world_.camera = camera();
      continue;
    } else {
      expected("texture, pigment, normal or finish");
    }
    auto changed = std::make_shared<TextureNode>(*world_.defaultTexture);
    changed->layers.front().pigment = defaultPigment_;
    changed->layers.front().normal = defaultNormal_;
    changed->layers.front().finish = defaultFinish_;
    world_.defaultTexture = changed;
  }
  // Not next(): the directive is over, and what follows is for the scene.
  next();
}

}  // namespace trace::pov
