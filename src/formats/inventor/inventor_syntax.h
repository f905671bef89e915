// The grammar that Open Inventor, VRML 1.0 and VRML97 share, apart from the meaning of nodes: text in, nodes
// with fields out.
//
// It knows no node and no field: what is followed by { is a node, everything else a field, whose value is all
// the numbers, texts, words and nodes that can belong to it. So a file with unknown nodes is read whole.
// A node that is used again is the same one. A PROTO is kept with the values it is given (textual
// instantiation). Time is linear in the text; nesting is limited.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "formats/tokens.h"

namespace trace::inventor {

struct Node;

struct Field {
  std::string_view name;
  Token token;
  std::vector<double> numbers;
  std::vector<std::string_view> words;  ///< words and texts, in order
  std::vector<const Node*> nodes;
  std::string_view is;  ///< the field of the PROTO around it that gives its value; else empty
};

struct Proto;

struct Node {
  std::string_view type, name;  ///< the name given by DEF
  Token token;
  std::vector<Field> fields;
  std::vector<const Node*> children;  ///< nodes that stand in it without a field's name
  const Proto* proto = nullptr;       ///< of a node whose type is one
};

struct Proto {
  std::string_view name;
  std::vector<Field> fields;  ///< with their defaults
  std::vector<const Node*> nodes;
};

/// A parsed file; refers to the bytes it was made from.
class Document {
 public:
  enum class Version { inventor, vrml1, vrml2 };

  /// Throws Error(Fault::scene).
  Document(std::string file, std::string_view bytes, Messages& messages);
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  Version version() const { return version_; }
  bool oldCrease() const { return oldCrease_; }  ///< the default creaseAngle is 0.5
  const std::vector<const Node*>& roots() const { return roots_; }
  std::size_t nodeCount() const { return nodes_.size(); }
  const std::string& file() const { return tokens_.file(); }
  Place place(const Token& token) const { return tokens_.place(token); }

 private:
  friend class Parser;

  Version version_;
  bool oldCrease_ = false;
  Tokens tokens_;
  std::vector<std::unique_ptr<Node>> nodes_;
  std::vector<std::unique_ptr<Proto>> protos_;
  std::vector<const Node*> roots_;
};

/// Does the file begin with the header of one of the text formats?
bool hasHeader(std::string_view bytes);

}  // namespace trace::inventor
