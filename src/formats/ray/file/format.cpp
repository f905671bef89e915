// The meaning of .ray scene files: the tree of ray_syntax.h turned into a Scene, by loops over the lists of
// shapes and lights and their fields. A new shape or light needs nothing here.
//
// Source: the skeletons of the courses (docs/ray-format.md). Where they refuse although the
// intention is clear, this reader accepts: named materials, materials inside groups, missing semicolons,
// unknown fields. What Trace does not render yet is kept as text and reported once per kind. What a block
// says is read in the file of its kind, ray_camera.cpp and the like.
#include "formats/ray/file/format.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "base/files/read_scope.h"
#include "formats/ray/file/part.h"
#include "formats/ray/file/students.h"
#include "formats/ray/language/language.h"
#include "formats/ray/read/background.h"
#include "formats/ray/read/camera.h"
#include "formats/ray/read/light.h"
#include "formats/ray/read/material.h"
#include "formats/ray/read/objects.h"
#include "formats/ray/read/settings.h"
#include "formats/ray/syntax/findings.h"
#include "formats/ray/syntax/keys.h"
#include "formats/ray/syntax/notes.h"
#include "formats/ray/syntax/syntax.h"
#include "formats/text_front.h"
#include "formats/textures.h"
#include "formats/words.h"
#include "scene/options.h"

namespace trace {
namespace rayfile {

void settle(Syntax& syntax, SceneTime& time, InputFiles& inputs) {
  const bool theirs = syntax.hasKeys() || speaksStudents(syntax);
  expand(syntax, time, inputs, !theirs);
  if (theirs || syntax.usesLanguage()) translateStudents(syntax);
  try {
    settleKeys(syntax, time);
  } catch (const Error&) {
    syntax.throwMistakes();  // which come first
    throw;
  }
}

namespace {

constexpr double kNewestVersion = 1.1;

/// Does the text begin with the word, as a whole?
bool beginsWith(std::string_view text, std::string_view word) {
  const std::string_view rest = text.substr(std::min(word.size(), text.size()));
  return sameWord(text.substr(0, word.size()), word) &&
         (rest.empty() || std::string_view(" \t\r\n").find(rest[0]) != rest.npos);
}

// --- the reader -----------------------------------------------------------------------------------------

class Reader {
 public:
  Reader(const Syntax& syntax, Scene& scene, Messages& messages, SceneTime& time, Notes* notes)
      : syntax_(syntax),
        scene_(scene),
        messages_(messages),
        findings_(syntax, scene, messages, notes),
        materials_(findings_),
        objects_(findings_, materials_, time),
        time_(time) {}

  void read() {
    readAll();
    scene_.unusedMaterials = materials_.unused();
    if (Notes* notes = findings_.notes()) notes->last = materials_.current;
    findings_.finish();
    warnOfEmptiness();
    messages_.throwIfFailed();
    if (!syntax_.isOfKind()) return;
    const std::optional<KindStart> start =
        time_.changesScene() && kindDefaultsFollow(scene_, findings_.given()) ? startOf(syntax_, end())
                                                                              : std::nullopt;
    addKindDefaults(scene_, findings_.given(), syntax_.shortPlace((*syntax_.root().begin()).offset()),
                    start ? &*start : nullptr);
  }
  /// Statements for a scene that has others.
  PartGiven readPart() {
    readItems();
    findings_.finish();
    messages_.throwIfFailed();
    return {std::move(findings_.given()), hasCamera_, hasBackground_};
  }
  const TextureReader& textures() { return materials_.textures(); }

 private:
  // --- the file ---

  /// The end of the time that the scene shows: its last key, or the moment that it chooses; without both some
  /// seconds.
  Real end() const {
    constexpr Real kUnknown = 2;
    const Real known = std::max(time_.last(), resolve({scene_.choices}).time);
    return known > 0 ? known : kUnknown;
  }

  /// The scene at its start, and what it shows until its end. Nothing if it cannot be read there.
  static std::optional<KindStart> startOf(const Syntax& syntax, Real end) {
    std::optional<KindStart> start;
    Box3 seen;
    for (const Real moment : {0.0, end / 2, end}) {
      Scene scene;
      scene.file = syntax.file();
      Messages known;  // they are those of the scene itself
      try {
        Syntax again(syntax.file(), syntax.source());
        SceneTime at(moment);
        settle(again, at, scene.inputs);
        Reader reader(again, scene, known, at, nullptr);
        reader.readAll();
        known.throwIfFailed();
        seen.extend(boundsOfInterest(scene));
        if (!start) start = KindStart{std::move(scene), std::move(reader.findings_.given()), {}};
      } catch (const Error& error) {
        if (error.fault() == Fault::limit) throw;
        return std::nullopt;
      }
    }
    start->seen = seen;
    return start;
  }

  void readAll() {
    readItems();
    objects_.finish();
  }

  void readItems() {
    findings_.take(syntax_.mistakes());
    for (const Syntax::Remark& remark : syntax_.remarks())
      messages_.warn(syntax_.place(remark.offset), remark.what, remark.hint);
    const Item root = syntax_.root();
    scene_.objects.reserve(root.count());
    auto item = root.begin();
    for (readHeader(item, root.end()); item != root.end(); ++item) topLevel(*item);
  }

  /// Leaves `item` after the header.
  void readHeader(Item::Iterator& item, const Item::Iterator& end) {
    if (syntax_.isOfKind()) return readKind(item, end);
    if (item == end || !(*item).is(Kind::word) || !sameWord((*item).text(), kCourses))
      throw Error(Fault::scene, syntax_.place(item == end ? 0 : (*item).offset()),
                  "expected SBT-raytracer 1.0 or Trace 1");
    const Item magic = *item;
    if (++item == end || !(*item).is(Kind::number))
      throw Error(Fault::scene, syntax_.place(magic.offset()),
                  "expected a version after SBT-raytracer, as in 1.0");
    if (!((*item).number() > 0 && (*item).number() <= kNewestVersion))
      throw Error(Fault::scene, syntax_.place((*item).offset()),
                  "expected version 1.1 or older of the format, found " + describe(*item));
    ++item;
  }

  void readKind(Item::Iterator& item, const Item::Iterator& end) {
    const Item kind = *item;
    if (++item == end || !(*item).is(Kind::number) || (*item).number() != 1)
      throw Error(Fault::scene, syntax_.place(item == end ? kind.offset() : (*item).offset()),
                  "expected 1 after Trace" + (item == end ? "" : ", found " + describe(*item)),
                  "a scene begins with the line: Trace 1");
    ++item;
  }

  void topLevel(const Item& item) {
    if (item.is(Kind::entry)) return topLevelEntry(item);
    if (item.is(Kind::call)) {
      if (item.key() == Material::kKeyword) return objects_.namedMaterial(item);
      if (item.key() == Camera::kKeyword) return camera(item);
      if (item.key() == kSettings) return readSettings(findings_, item);
      if (item.key() == Background::kKeyword) return background(item);
      if (readLight(findings_, item)) return;
    }
    objects_.object(item, {});
  }

  void topLevelEntry(const Item& item) {
    if (item.key() == kTexture) return materials_.textures().define(item.value());
    if (item.key() != Material::kKeyword) {
      if (findings_.isOfKind() && didYouMean(item.key(), knownWords()).empty())
        return findings_.error(item, "\"" + std::string(item.key()) + "\" is not known",
                               "let " + std::string(item.key()) + " = ... gives a name its value, once");
      return findings_.notRendered(item.key(), item, knownWords());
    }
    findings_.sureSignOf2005();
    materials_.current = materials_.read(item.value(), materials_.current);
  }

  void warnOfEmptiness() {
    if (scene_.objects.empty() && scene_.uses.empty() && findings_.errors() == 0)
      messages_.warn(SourcePlace{scene_.file, 0, 0, {}}, "no object: the picture will be empty");
  }

  void camera(const Item& call) {
    const std::optional<Item> block = blockOf(findings_, call);
    if (!block) return;
    if (std::exchange(hasCamera_, true)) findings_.warn(call, "there are several cameras; the last counts");
    scene_.camera = readCamera(findings_, *block);
  }

  void background(const Item& call) {
    const std::optional<Item> block = blockOf(findings_, call);
    if (!block) return;
    hasBackground_ = true;
    scene_.background = readBackground(findings_, *block);
  }

  const Syntax& syntax_;
  Scene& scene_;
  Messages& messages_;
  Findings findings_;
  Materials materials_;
  ObjectReader objects_;
  const SceneTime& time_;
  bool hasCamera_ = false, hasBackground_ = false;
};

}  // namespace

Scene readNoted(Syntax& syntax, Messages& messages, Real time, Notes& notes) {
  Scene scene;
  scene.file = syntax.file();
  scene.format = "ray";
  SceneTime moment(time);
  settle(syntax, moment, scene.inputs);
  Reader(syntax, scene, messages, moment, &notes).read();
  return scene;
}

PartGiven readPart(const std::string& file, std::string_view statements, Scene& scene, Messages& messages) {
  const std::string text = std::string(kKind) + " 1\n" + std::string(statements);
  Syntax syntax(file, text);
  SceneTime moment(0);
  settle(syntax, moment, scene.inputs);
  return Reader(syntax, scene, messages, moment, nullptr).readPart();
}

}  // namespace rayfile

bool recognisesRay(std::string_view bytes) {
  const std::string_view text = rayfile::skipBlanks(bytes);
  return sameWord(text.substr(0, rayfile::kCourses.size()), rayfile::kCourses) ||
         rayfile::beginsWith(text, rayfile::kKind);
}

Scene readRay(const std::string& file, std::string_view bytes, Messages& messages, Real time) {
  SceneTime moment(time);
  return readRay(file, bytes, messages, moment);
}

Scene readRay(const std::string& file, std::string_view bytes, Messages& messages, SceneTime& time) {
  Scene scene;
  scene.file = file;
  scene.format = "ray";
  rayfile::Syntax syntax(file, bytes);
  rayfile::settle(syntax, time, scene.inputs);
  rayfile::Reader(syntax, scene, messages, time, nullptr).read();
  return scene;
}

std::vector<Texture> readNamedTextures(const std::string& file, std::string_view bytes, Messages& messages,
                                       Real time) {
  const ReadScope scope = ReadScope::ofScene(file);
  const TextFront front(file, bytes, messages);
  Scene scene;
  scene.file = file;
  rayfile::Syntax syntax(file, front.text());
  SceneTime moment(time);
  rayfile::settle(syntax, moment, scene.inputs);
  rayfile::Reader reader(syntax, scene, messages, moment, nullptr);
  reader.read();
  Scene shown;  // objects of one material for each texture
  shown.file = file;
  for (const auto& [name, texture] : reader.textures().named())
    shown.materials.push_back({.name = name, .model = {}, .textures = {{"diffuse", texture}}});
  loadTextures(shown, messages);
  std::vector<Texture> textures;
  for (const Material& material : shown.materials) textures.push_back(material.textures.front().texture);
  return textures;
}

}  // namespace trace
