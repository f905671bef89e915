#include "formats/inventor/syntax/inventor_syntax.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/files/named_file.h"
#include "base/files/read_scope.h"
#include "base/nesting.h"
#include "formats/inventor/syntax/inventor_binary.h"
#include "formats/text_front.h"
#include "formats/warnings.h"
#include "formats/words.h"

namespace trace::inventor {
namespace {

constexpr TokenRules kInventorTokens{
    .marks = "[]{}()|~=", .comment = '#', .commasAreBlank = true, .stringEscapes = true};

TokenRules inventorTokens(bool hasPlaces) {
  TokenRules rules = kInventorTokens;
  rules.hasPlaces = hasPlaces;
  return rules;
}

Document::Version versionOf(const std::string& file, std::string_view line) {
  const auto begins = [&](std::string_view text) { return sameWord(line.substr(0, text.size()), text); };
  if (begins("#Inventor") && hasWord(line, "ascii")) return Document::Version::inventor;
  if (begins("#VRML V1.0")) return Document::Version::vrml1;
  if (begins("#VRML V2.0") || begins("#X3D")) return Document::Version::vrml2;
  throw Error(Fault::scene, SourcePlace{file, 1, 1, std::string(line)},
              "expected #Inventor V2.1 ascii or binary, #VRML V1.0 ascii or #VRML V2.0 utf8");
}

std::string_view firstLine(std::string_view bytes) {
  bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  return bytes.substr(0, std::min<std::size_t>(bytes.find_first_of("\r\n"), 100));
}

}  // namespace

/// Recursive descent over the tokens.
class Parser {
 public:
  Parser(Document& document, Messages& messages)
      : document_(document), tokens_(document.tokens_), messages_(messages) {}

  void file() {
    while (!tokens_.atEnd()) {
      if (statement()) continue;
      if (const Node* node = this->node()) document_.roots_.push_back(node);
    }
    warnings_.report(messages_);
  }

 private:
  // --- statements that are no nodes ---

  bool statement() {
    if (const Token start = tokens_.peek(); tokens_.skipWord("ROUTE")) {  // a.b TO c.d
      warnUnmoved(start);
      for (int i = 0; i < 3 && tokens_.peek().is(Token::Kind::word); ++i) tokens_.next();
      return true;
    }
    if (tokens_.skipWord("PROTO")) {
      proto();
      return true;
    }
    if (tokens_.skipWord("EXTERNPROTO")) {
      externProto();
      return true;
    }
    return false;
  }

  /// A PROTO of another file, which the first of its names that can be read tells: "shapes.wrl#Ball", or
  /// "shapes.wrl" for the first PROTO there.
  void externProto() {
    const Token name = tokens_.word("EXTERNPROTO");
    skipBrackets('[', ']');
    std::vector<std::string> urls;
    const bool several = tokens_.skipMark('[');
    while (tokens_.peek().is(Token::Kind::string)) urls.emplace_back(tokens_.next().text);
    if (several) tokens_.mark(']', "EXTERNPROTO");
    std::string why = "it names no file";
    for (const std::string& url : urls) {
      const std::size_t mark = url.find('#');
      const std::string file = url.substr(0, mark), proto = mark == url.npos ? "" : url.substr(mark + 1);
      try {
        if (const Proto* found = protoOf(file, proto)) {
          protoByName_[name.text] = found;
          return;
        }
        why = file + " has none of that name";
      } catch (const ReadDenied& denied) {
        denied.at(tokens_.place(name));
      } catch (const Error& error) {
        if (error.fault() == Fault::limit) throw;
        why = error.messages().front().what;
      }
    }
    warn(name, "EXTERNPROTO " + std::string(name.text.substr(0, 40)) + ": its nodes are left out: " + why);
  }

  const Proto* protoOf(const std::string& file, const std::string& proto);

  void proto() {
    const Token name = tokens_.word("PROTO");
    auto made = std::make_unique<Proto>();
    made->name = name.text;
    tokens_.mark('[', "PROTO");
    while (!tokens_.skipMark(']')) {
      const Token access = tokens_.word("PROTO");  // field, exposedField, eventIn, eventOut
      tokens_.word("PROTO");                       // type
      Field field;
      field.token = tokens_.word("PROTO");
      field.name = field.token.text;
      const bool hasValue = access.text == "field" || access.text == "exposedField" ||
                            access.text == "initializeOnly" || access.text == "inputOutput";
      if (hasValue) value(field);
      made->fields.push_back(std::move(field));
    }
    tokens_.mark('{', "PROTO");
    Node holder;
    if (++depth_ > kMostNesting) tokens_.fail(name, "expected fewer levels of nodes");
    body(holder, name);
    --depth_;
    made->nodes = std::move(holder.children);
    protoByName_[name.text] = made.get();
    document_.protos_.push_back(std::move(made));
  }

  void skipBrackets(char open, char close) {
    const Token start = tokens_.peek();
    if (!tokens_.skipMark(open)) return;
    for (int depth = 1; depth > 0;) {
      const Token token = tokens_.next();
      if (token.is(Token::Kind::end)) tokens_.fail(start, "this bracket is never closed");
      depth += token.isMark(open) ? 1 : token.isMark(close) ? -1 : 0;
    }
  }

  // --- nodes ---

  /// Nothing for NULL, and, after a warning, for a name that is not defined.
  const Node* node() {
    if (tokens_.skipWord("NULL")) return nullptr;
    if (tokens_.skipWord("USE")) {
      const Token name = tokens_.next();
      const auto found = named_.find(name.text);
      if (found != named_.end()) return found->second;
      warn(name, "USE " + std::string(name.text.substr(0, 40)) + ": expected a name that DEF gave before");
      return nullptr;
    }
    std::string_view name;
    if (tokens_.skipWord("DEF")) name = tokens_.next().text;
    const Token type = tokens_.word("node");
    if (!tokens_.skipMark('{')) tokens_.expected("node " + std::string(type.text.substr(0, 40)), "\"{\"");
    if (++depth_ > kMostNesting)
      tokens_.fail(type, "expected at most " + std::to_string(kMostNesting) + " levels of nodes, found more");
    auto made = std::make_unique<Node>();
    made->type = type.text;
    made->name = name;
    made->token = type;
    if (const auto found = protoByName_.find(type.text); found != protoByName_.end())
      made->proto = found->second;
    body(*made, type);
    --depth_;
    const Node* result = made.get();
    document_.nodes_.push_back(std::move(made));
    // Known only from here on: a node cannot hold itself.
    if (!name.empty()) named_[name] = result;
    return result;
  }

  /// Up to the closing bracket.
  void body(Node& node, const Token& owner) {
    while (!tokens_.skipMark('}')) {
      if (tokens_.atEnd()) tokens_.fail(owner, "this node is never closed with \"}\"");
      if (statement()) continue;
      if (!tokens_.peek().is(Token::Kind::word))
        tokens_.expected(owner.text.substr(0, 40), "a field or a node");
      if (startsNode()) {
        if (const Node* child = this->node()) node.children.push_back(child);
      } else {
        field(node);
      }
    }
  }

  bool startsNode() {
    const Token& token = tokens_.peek();
    return token.isWord("DEF") || token.isWord("USE") ||
           (token.is(Token::Kind::word) && tokens_.markFollows('{'));
  }

  void field(Node& node) {
    Field field;
    field.token = tokens_.next();
    field.name = field.token.text;
    // Scripts declare fields: `field SFBool on TRUE`, `eventIn SFTime start`.
    if (node.type == "Script" &&
        (field.name == "field" || field.name == "eventIn" || field.name == "eventOut")) {
      tokens_.word("Script");
      field.token = tokens_.word("Script");
      const bool hasValue = field.name == "field";
      field.name = field.token.text;
      if (!hasValue) return;
    }
    if (value(field)) node.fields.push_back(std::move(field));
  }

  /// All that can belong to one value: a list in brackets, or numbers, or texts, or one word, or one node.
  /// False if a mark behind it says that it does not count.
  bool value(Field& field) {
    // `value ~` has no value, only the mark that it does not count: a word after it is the next field.
    if (tokens_.skipMark('~')) {
      const Token& next = tokens_.peek();
      const bool hasValue = next.is(Token::Kind::number) || next.is(Token::Kind::string) ||
                            next.isMark('[') || next.isMark('(');
      if (!hasValue) {
        if (tokens_.skipMark('=')) connection(field);
        return false;
      }
    }
    if (tokens_.skipWord("IS")) {
      field.is = tokens_.word("IS").text;
    } else if (tokens_.skipMark('[')) {
      const Token start = field.token;
      while (!tokens_.skipMark(']')) {
        if (tokens_.atEnd()) tokens_.fail(start, "the list of this field is never closed with \"]\"");
        item(field);
      }
    } else if (tokens_.skipMark('(')) {  // bits: (SIDES | TOP)
      while (!tokens_.skipMark(')'))
        if (!tokens_.skipMark('|')) field.words.push_back(tokens_.word(field.name).text);
    } else if (tokens_.peek().is(Token::Kind::number)) {
      while (tokens_.peek().is(Token::Kind::number)) field.numbers.push_back(tokens_.next().number);
    } else if (tokens_.peek().is(Token::Kind::string)) {
      while (tokens_.peek().is(Token::Kind::string)) field.words.push_back(tokens_.next().text);
    } else if (tokens_.peek().is(Token::Kind::word)) {
      item(field);
    } else if (!tokens_.peek().isMark('}') && !tokens_.peek().isMark('=')) {
      tokens_.expected(field.name.substr(0, 40), "a value");
    }
    const bool counts = !tokens_.skipMark('~');
    if (tokens_.skipMark('=')) connection(field);
    return counts;
  }

  void item(Field& field) {
    const Token& token = tokens_.peek();
    if (token.is(Token::Kind::number)) {
      field.numbers.push_back(tokens_.next().number);
    } else if (token.is(Token::Kind::string)) {
      field.words.push_back(tokens_.next().text);
    } else if (startsNode() || token.isWord("NULL")) {
      if (const Node* node = this->node()) field.nodes.push_back(node);
    } else if (token.is(Token::Kind::word)) {
      if (!statement()) field.words.push_back(tokens_.next().text);
    } else {
      tokens_.expected(field.name.substr(0, 40), "a value");
    }
  }

  /// `= Engine { } . output`: what moves the field. It keeps its value.
  void connection(const Field& field) {
    warnUnmoved(field.token);
    if (startsNode())
      node();
    else if (tokens_.peek().is(Token::Kind::word))
      tokens_.next();
    if (tokens_.skipWord(".") ||
        (tokens_.peek().is(Token::Kind::word) && tokens_.peek().text.starts_with('.')))
      if (tokens_.peek().is(Token::Kind::word)) tokens_.next();
  }

  void warnUnmoved(const Token& at) {
    if (!warnings_.again("unmoved"))
      warnings_.warn(tokens_.place(at), "routes and engines are not run: nothing moves or reacts", {},
                     "unmoved");
  }
  void warn(const Token& at, std::string what) {
    if (!warnings_.again(what)) warnings_.warn(tokens_.place(at), std::move(what));
  }

  Document& document_;
  Tokens& tokens_;
  Messages& messages_;
  std::map<std::string_view, const Node*> named_;
  std::map<std::string_view, const Proto*> protoByName_;
  WarningsByKind warnings_;
  int depth_ = 0;
};

struct ProtoFile {
  ProtoFile(const std::string& file, std::string text, Messages& messages, ProtoFiles* others)
      : bytes(std::move(text)), document(file, bytes, messages, others) {}

  const std::string bytes;
  const Document document;
};

const Proto* Parser::protoOf(const std::string& file, const std::string& proto) {
  const std::string path = namedFile(document_.file(), file).path;
  const auto [known, fresh] = document_.protoFiles_->try_emplace(path);
  if (fresh) {
    std::string text = readTextBeside(document_.file(), file, document_.inputs_, messages_);
    if (!hasHeader(text)) throw Error(Fault::scene, SourcePlace{.file = path}, path + " is no VRML file");
    // The map may grow meanwhile, and its elements stay where they are.
    known->second =
        std::make_shared<const ProtoFile>(path, std::move(text), messages_, document_.protoFiles_);
    document_.inputs_.note(known->second->document.inputs());
  }
  if (!known->second) throw Error(Fault::scene, path + " holds itself");
  for (const std::unique_ptr<Proto>& one : known->second->document.protos_)
    if (proto.empty() || one->name == proto) return one.get();
  return nullptr;
}

SourcePlace Document::place(const Token& token) const {
  const auto holds = [&](const Document& document) { return document.tokens_.holds(token); };
  if (!holds(*this))
    for (const auto& [path, file] : *protoFiles_)
      if (file && holds(file->document)) return file->document.tokens_.place(token);
  return tokens_.place(token);
}

Document::Document(std::string file, std::string_view bytes, Messages& messages, ProtoFiles* protoFiles)
    : made_(isBinary(bytes) ? textOfBinary(file, bytes) : ""),
      text_(made_.empty() ? bytes : std::string_view(made_)),
      version_(versionOf(file, firstLine(text_))),
      size_(text_.size()),
      tokens_(std::move(file), text_, inventorTokens(made_.empty())),
      ownFiles_(protoFiles ? nullptr : std::make_unique<ProtoFiles>()),
      protoFiles_(protoFiles ? protoFiles : ownFiles_.get()) {
  protoFiles_->try_emplace(tokens_.file());  // it cannot bring itself
  oldCrease_ = version_ == Version::vrml1 || firstLine(bytes).starts_with("#Inventor V1");
  Parser(*this, messages).file();
}

bool hasHeader(std::string_view bytes) {
  const std::string_view line = firstLine(bytes);
  for (std::string_view word : {"#Inventor", "#VRML", "#X3D"})
    if (sameWord(line.substr(0, word.size()), word)) return true;
  return false;
}

}  // namespace trace::inventor
