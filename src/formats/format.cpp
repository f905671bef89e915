#include "formats/format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/budget.h"
#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "formats/composer/composer_format.h"
#include "formats/inventor/inventor_format.h"
#include "formats/mesh/gltf/gltf_format.h"
#include "formats/mesh/mesh_writers.h"
#include "formats/mesh/obj_format.h"
#include "formats/mesh/off_format.h"
#include "formats/mesh/ply_format.h"
#include "formats/mesh/stl_format.h"
#include "formats/pov/pov_format.h"
#include "formats/ray/file/format.h"
#include "formats/ray/write/patch.h"
#include "formats/ray/write/writer.h"
#include "formats/text_front.h"
#include "formats/textures.h"
#include "formats/ubc/ubc_format.h"
#include "scene/groups.h"

namespace trace {
namespace {

using Suffixes = std::array<std::string_view, 1>;
constexpr std::array<std::string_view, 2> kScene{".ray", ".tr"};
constexpr Suffixes kRay{".ray"}, kOut{".out"}, kPly{".ply"}, kObj{".obj"}, kOff{".off"}, kStl{".stl"},
    kPov{".pov"};
constexpr std::array<std::string_view, 2> kGltf{".gltf", ".glb"}, kInventor{".wrl", ".iv"};

constexpr std::array kFormats{
    SceneFormat{.name = "ray",
                .suffixes = kScene,
                .help = "scenes that begin with SBT-raytracer 1.0 or Trace 1",
                .recognises = recognisesRay,
                .readAt = readRay,
                .write = writeRay,
                .keepsGroups = true,
                .rewrite = rewriteRay},
    SceneFormat{.name = "composer",
                .suffixes = kOut,
                .help = "Composer format 2.1, text and binary",
                .recognises = recognisesComposer,
                .read = readComposer,
                .write = writeComposer},
    SceneFormat{.name = "inventor",
                .suffixes = kInventor,
                .help = "Open Inventor 2.x, text and binary, VRML 1.0 and VRML97",
                .recognises = recognisesInventor,
                .read = readInventor,
                .write = writeInventor},
    SceneFormat{.name = "pov",
                .suffixes = kPov,
                .help = "scenes of POV-Ray 3.7, as far as Trace has what they use",
                .recognises = recognisesPov,
                .mayBe = mayBePov,
                .readAt = readPov},
    SceneFormat{.name = "ubc",
                .suffixes = kRay,
                .help = "scenes of British Columbia and Montreal, of commands such as Dimensions 640 480",
                .recognises = recognisesUbc,
                .read = readUbc},
    SceneFormat{.name = "ply",
                .suffixes = kPly,
                .help = "PLY meshes, text and binary",
                .recognises = recognisesPly,
                .readModel = readPly,
                .write = writePly},
    SceneFormat{.name = "off",
                .suffixes = kOff,
                .help = "OFF meshes, text",
                .recognises = recognisesOff,
                .mayBe = mayBeOff,
                .readModel = readOff},
    SceneFormat{.name = "stl",
                .suffixes = kStl,
                .help = "STL triangles, text and binary",
                .recognises = recognisesStl,
                .mayBe = mayBeStl,
                .readModel = readStl},
    SceneFormat{.name = "obj",
                .suffixes = kObj,
                .help = "Wavefront OBJ meshes with MTL materials",
                .recognises = recognisesObj,
                .mayBe = mayBeObj,
                .readModel = readObj,
                .write = writeObj},
    SceneFormat{.name = "gltf",
                .suffixes = kGltf,
                .help = "glTF 2.0 scenes, text and binary",
                .recognises = recognisesGltf,
                .readModelAt = readGltf},
};

/// The appearance of bytes that are no scene.
std::string kindOf(std::string_view bytes) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kBeginnings{{
      {"\x89PNG", "a PNG picture"},
      {"\xff\xd8\xff", "a JPEG picture"},
      {"BM", "a BMP picture"},
      {"GIF8", "a GIF picture"},
      {"\x76\x2f\x31\x01", "an OpenEXR picture"},
      {"#?RADIANCE", "a Radiance picture"},
      {"%PDF", "a PDF document"},
      {"PK\x03\x04", "a zip archive"},
      {"\x7f"
       "ELF",
       "a program"},
  }};
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "a WebP picture";
  for (const auto& [beginning, kind] : kBeginnings)
    if (bytes.starts_with(beginning)) return std::string(kind);
  if (bytes.find('\0') < 4096) return "binary data";
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return bytes.empty() ? "an empty file" : "only white space";
  if (bytes[first] == '{' || bytes[first] == '[') return "what looks like JSON";
  if (bytes[first] == '<') return "what looks like XML or HTML";
  return "other text";
}

/// `12 bytes`, `34 kB`, `56 MB`.
std::string sizeText(std::size_t bytes) {
  constexpr std::size_t kKilo = 1000, kFew = 10;
  if (bytes < kFew * kKilo) return std::to_string(bytes) + " bytes";
  if (bytes < kFew * kKilo * kKilo) return std::to_string(bytes / kKilo) + " kB";
  return std::to_string(bytes / (kKilo * kKilo)) + " MB";
}

std::string lowerSuffix(const std::filesystem::path& path) {
  std::string suffix = path.extension().generic_string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return suffix;
}

/// The suffix in lower case, of what is compressed the one before ".gz".
std::string suffixOf(const std::string& file) {
  const std::string suffix = lowerSuffix(file);
  return suffix == ".gz" ? lowerSuffix(std::filesystem::path(file).stem()) : suffix;
}

bool hasSuffix(const SceneFormat& format, const std::string& suffix) {
  return std::find(format.suffixes.begin(), format.suffixes.end(), suffix) != format.suffixes.end();
}

/// A scene that somebody began to write without its first line.
Error lacksFirstLine(const std::string& file, std::string_view bytes) {
  constexpr std::size_t kLongest = 40;
  std::string line(bytes.substr(0, bytes.find_first_of("\r\n")));
  const std::string found = line.empty()              ? "an empty line"
                            : line.size() <= kLongest ? "\"" + line + "\""
                                                      : "\"" + line.substr(0, kLongest - 3) + "\"...";
  return {Fault::scene, SourcePlace{file, 1, 1, std::move(line)},
          "expected Trace 1 on the first line, found " + found,
          "every .ray file begins with the line Trace 1, or SBT-raytracer 1.1 as the courses have it"};
}

/// The row for a file.
struct FoundFormat {
  const SceneFormat& row;
  std::string byName{};  ///< "named .stl, but ", if only the name tells
};

/// The row that fits, of those that `wanted` accepts. Throws Error(Fault::scene).
template <class Wanted>
FoundFormat formatOf(const std::string& file, std::string_view bytes, const char* expected, Wanted&& wanted) {
  const std::string suffix = suffixOf(file), named = "named " + suffix + ", but ";
  std::string known;
  bool isNamed = false;
  for (const SceneFormat& format : sceneFormats()) {
    if (!wanted(format)) continue;
    if (format.recognises(bytes)) return {format};
    isNamed = isNamed || hasSuffix(format, suffix);
    known += (known.empty() ? "" : ", ") + std::string(format.name);
  }
  for (const SceneFormat& format : sceneFormats())
    if (wanted(format) && format.mayBe && hasSuffix(format, suffix) && format.mayBe(bytes))
      return {format, named};
  const std::string found = isNamed && bytes.empty() ? named + "it is "
                            : isNamed                ? named + "holds "
                                                     : "expected " + std::string(expected) + ", found ";
  const std::string kind = kindOf(bytes);
  const bool isText = kind == "an empty file" || kind == "only white space" || kind == "other text";
  const bool lacksHeader = isText && isNamed && suffix == ".ray";
  if (lacksHeader && kind == "other text") throw lacksFirstLine(file, bytes);
  throw Error(Fault::scene, SourcePlace{file, 0, 0, {}}, found + kind,
              lacksHeader
                  ? "the first line of a .ray file is Trace 1, or SBT-raytracer 1.1 as the courses have it"
                  : "formats Trace reads: " + known);
}

/// read(); if only the name told the format, errors say so.
template <class Read>
auto asNamed(const FoundFormat& format, Read&& read) {
  if (format.byName.empty()) return read();
  try {
    return read();
  } catch (const ReadDenied&) {
    throw;
  } catch (const Error& error) {
    if (error.fault() != Fault::scene) throw;
    Message message = error.messages().front();
    message.what = format.byName + "not valid as " + std::string(format.row.name) + ": " + message.what;
    throw Error(error.fault(), {message});
  }
}

/// Calls use(text) for what stands between quotation marks, which may be the name of a file.
template <class Use>
void forEachQuoted(std::string_view text, Use&& use) {
  constexpr std::size_t kLongestName = 4096;
  for (std::size_t open = text.find('"'); open != std::string_view::npos;) {
    const std::size_t close = text.find('"', open + 1);
    if (close == std::string_view::npos) return;
    const std::string_view inside = text.substr(open + 1, close - open - 1);
    if (!inside.empty() && inside.size() <= kLongestName) use(inside);
    open = text.find('"', close + 1);
  }
}

/// The task of this thread, and the one inside of it that an exception broke off.
std::string workBrokenOff() {
  const std::string outer = doingNow();
  const std::string inner = budgetOfThread.budget ? budgetOfThread.budget->brokenOff() : "";
  return outer + (outer.empty() || inner.empty() ? "" : ", ") + inner;
}

/// The result of read(); lack of memory becomes an Error that names the file and its size.
template <class Read>
auto withinMemory(const std::string& file, std::string_view bytes, Read&& read) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {  // thrown by a vector or string
  }
  const std::string doing = workBrokenOff();
  throw Error(Fault::limit, SourcePlace{.file = file},
              "out of memory while " + (doing.empty() ? "reading the scene" : doing) + ", from a file of " +
                  sizeText(bytes.size()),
              "--max-memory N allows N MiB; a smaller mesh, fewer levels of `subdivide`, or fewer copies "
              "need less");
}

/// By a row that reads models.
Model modelBy(const SceneFormat& row, const std::string& file, std::string_view text, Messages& messages,
              SceneTime& time) {
  return row.readModelAt ? row.readModelAt(file, text, messages, time) : row.readModel(file, text, messages);
}

/// The bounds of a model that moves, at some moments from its first key to its last: one camera sees all of
/// it.
Box3 boundsOverTime(const SceneFormat& row, const std::string& file, std::string_view text,
                    const std::pair<Real, Real>& keys) {
  constexpr int kMoments = 5;
  Box3 all;
  for (int i = 0; i < kMoments; ++i) {
    Messages told;  // messages of the model before
    SceneTime moment(keys.first + (keys.second - keys.first) * i / (kMoments - 1));
    all.extend(bounds(sceneOf(modelBy(row, file, text, told, moment), file, row.name)));
  }
  return all;
}

}  // namespace

std::span<const SceneFormat> sceneFormats() { return kFormats; }

Scene readScene(const std::string& file, Messages& messages, Real time) {
  return readScene(file, readFile(file), messages, time);
}

Scene readScene(const std::string& file, std::string_view bytes, Messages& messages, Real time) {
  SceneTime moment(time);
  return readScene(file, bytes, messages, moment);
}

bool changesWithTime(const std::string& file, std::string_view bytes) {
  Messages unheard;
  SceneTime time;
  try {
    readScene(file, bytes, unheard, time);
  } catch (const Error& error) {
    if (error.fault() == Fault::limit) throw;
    return false;
  }
  return time.changesScene();
}

Scene readScene(const std::string& file, std::string_view bytes, Messages& messages, SceneTime& time) {
  const ReadScope scope = ReadScope::ofScene(file);
  Scene scene = withinMemory(file, bytes, [&] {
    const TextFront front(file, bytes, messages);
    const std::string_view text = front.text();
    const FoundFormat format = formatOf(file, text, "a scene", [](const SceneFormat&) { return true; });
    return asNamed(format, [&] {
      if (format.row.readAt) return format.row.readAt(file, text, messages, time);
      if (format.row.read) return format.row.read(file, text, messages);
      Model model = modelBy(format.row, file, text, messages, time);
      if (model.keys && !model.camera) model.framed = boundsOverTime(format.row, file, text, *model.keys);
      return sceneOf(std::move(model), file, format.row.name);
    });
  });
  InputFiles inputs;
  inputs.noteRead(file, bytes);
  inputs.note(scene.inputs);
  const auto named = [&](std::string_view name) {
    if (!name.starts_with("data:")) inputs.noteNamed(besideFile(file, std::string(name)));
  };
  for (const Unrendered& node : scene.unrendered) forEachQuoted(node.text, named);
  scene.inputs = std::move(inputs);
  loadTextures(scene, messages);
  return scene;
}

Model readModel(const std::string& file, std::string_view bytes, Messages& messages, SceneTime& time) {
  const ReadScope scope = ReadScope::ofScene(file);
  return withinMemory(file, bytes, [&] {
    const TextFront front(file, bytes, messages);
    const FoundFormat format = formatOf(file, front.text(), "a mesh", [](const SceneFormat& row) {
      return row.readModel || row.readModelAt;
    });
    return asNamed(format, [&] { return modelBy(format.row, file, front.text(), messages, time); });
  });
}

Model readModel(const std::string& file, std::string_view bytes, Messages& messages) {
  SceneTime time;
  return readModel(file, bytes, messages, time);
}

const SceneFormat& writableFormatFor(const std::string& file) {
  const std::string suffix = lowerSuffix(file);
  std::string known;
  for (const SceneFormat& format : sceneFormats()) {
    if (!format.write) continue;
    for (std::string_view own : format.suffixes) {
      if (own == suffix) return format;
      known += (known.empty() ? "" : ", ") + std::string(own);
    }
  }
  throw Error(Fault::usage, "\"" + file + "\": expected a name that ends in one of " + known);
}

Rewritten writeEdited(const SceneText& read, const Scene& edited, const std::string& file,
                      Messages& messages) {
  const SceneFormat& format = writableFormatFor(file);
  if (format.rewrite && read.scene && read.scene->format == format.name) {
    const TextFront front(read.file, *read.bytes);
    if (!front.wasEncoded() && !front.wasCut()) return format.rewrite(read, edited, file, messages);
    SceneText plain = read;
    plain.bytes = std::make_shared<const std::string>(front.text());
    return format.rewrite(plain, edited, file, messages);
  }
  return {format.write(
      format.keepsGroups ? edited : copied(edited, "a file of the format " + std::string(format.name)), file,
      {}, messages)};
}

}  // namespace trace
