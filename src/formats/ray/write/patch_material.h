// Materials in the text of a .ray file, changed where they are said: a block that several objects share is
// changed once; a block that inherits from it keeps what it had.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "formats/ray/syntax/notes.h"
#include "formats/ray/write/edits.h"

namespace trace::rayfile {

class MaterialEdits {
 public:
  /// `wanted`: what each of the scene's materials is to become.
  MaterialEdits(TextEdits& edits, const Notes& notes, std::vector<std::optional<Material>> wanted);

  /// The object of this call, which has the material `was` of that index, is to have this one.
  void want(const Item& call, std::uint32_t has, const Material& was, const Material& material);
  /// Takes that part of the text out.
  void drop(std::size_t begin, std::size_t end) { dropped_.emplace_back(begin, end); }
  /// Changes the text. Then text() may be asked.
  void run();

  /// The value of `material = ` for something at the end of the file. `whole`: nothing is inherited.
  std::string text(const Material& material, bool whole);
  /// The value of `material = `, whatever is around it.
  std::string fullText(const Material& material) const { return blockText({}, material, true); }

 private:
  using Fields = std::vector<std::string>;
  struct Addition {
    Item call;
    Material material;
  };

  bool isDropped(std::size_t offset) const;
  bool isKnown(const Material& material) const;
  void define(const Material& material);
  void use(const Notes::Use& use);
  void add(const Addition& addition);
  void changeBlock(const Item& block, const Material& from, const Material& was, const Material& wanted);
  /// A field that the block gives.
  template <class Value>
  void changeValue(const Item& item, const Material& was, const Value& from, const Material& wanted,
                   const Value& to, std::string_view field);
  Material followed(const Item& block, const Material& from, const Material& was) const;
  const Material& now(const NotedMaterial& material) const;
  Fields missing(const Item* block, const Material& from, const Material& wanted, bool all) const;
  std::string blockText(const Material& from, const Material& wanted, bool whole) const;

  TextEdits& edits_;
  const Notes& notes_;
  std::vector<std::optional<Material>> wanted_;
  std::map<std::size_t, Material> instead_;    ///< by the offset of a use
  std::map<std::size_t, Addition> additions_;  ///< by the offset of the call
  std::vector<std::pair<std::size_t, std::size_t>> dropped_;
  std::vector<Material> now_;  ///< what the blocks say when all is changed
  std::map<std::string, Material> named_;
  std::set<std::size_t> seen_;
  bool hasModels_ = false;  ///< some material is not Phong's, so that what stands around may not be
};

}  // namespace trace::rayfile
