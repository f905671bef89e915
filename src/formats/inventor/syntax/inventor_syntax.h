// The grammar that Open Inventor, VRML 1.0 and VRML97 share, apart from the meaning of nodes: text in, nodes
// with fields out.
//
// It knows no node and no field: what is followed by { is a node, everything else a field, whose value is all
// the numbers, texts, words and nodes that can belong to it. So a file with unknown nodes is read whole.
// A node that is used again is the same one. A PROTO is kept with the values it is given (textual
// instantiation). Time is linear in the text; nesting is limited.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "formats/tokens.h"
#include "scene/input_files.h"

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
  const Proto* proto = nullptr;       ///< proto of a node whose type is one
};

struct Proto {
  std::string_view name;
  std::vector<Field> fields;  ///< with their defaults
  std::vector<const Node*> nodes;
};

/// A file of PROTOs that others name by EXTERNPROTO, with its text.
struct ProtoFile;
/// Those that a scene uses, by path, each read once; null while it is read, or if it cannot be.
using ProtoFiles = std::map<std::string, std::shared_ptr<const ProtoFile>>;

/// A parsed file; refers to the bytes it was made from, if these are text. A binary file is read as the text
/// that it stands for, and places are the file as a whole.
class Document {
 public:
  enum class Version { inventor, vrml1, vrml2 };

  /// Throws Error(Fault::scene), and ReadDenied for a file of PROTOs that may not be read.
  Document(std::string file, std::string_view bytes, Messages& messages, ProtoFiles* protoFiles = nullptr);
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  Version version() const { return version_; }
  bool oldCrease() const { return oldCrease_; }  ///< the default creaseAngle is 0.5
  const std::vector<const Node*>& roots() const { return roots_; }
  std::size_t nodeCount() const { return nodes_.size(); }
  std::size_t size() const { return size_; }  ///< length of its text, in bytes
  const std::string& file() const { return tokens_.file(); }
  /// The place of a token of this file, or of one whose PROTOs it uses.
  SourcePlace place(const Token& token) const;
  /// The files whose PROTOs it names.
  const InputFiles& inputs() const { return inputs_; }

 private:
  friend class Parser;

  std::string made_;  ///< the text of a binary file
  std::string_view text_;
  Version version_;
  std::size_t size_;
  bool oldCrease_ = false;
  Tokens tokens_;
  std::vector<std::unique_ptr<Node>> nodes_;
  std::vector<std::unique_ptr<Proto>> protos_;
  std::vector<const Node*> roots_;
  std::unique_ptr<ProtoFiles> ownFiles_;  ///< own files of the scene's own file
  ProtoFiles* protoFiles_;
  InputFiles inputs_;
};

/// Does the file begin with the header of one of the formats?
bool hasHeader(std::string_view bytes);

}  // namespace trace::inventor
