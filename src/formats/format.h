// THE table of scene formats, and reading and writing any of them. A format is recognised by its content, and
// where that leaves it open by the file's name; what is written follows from the name.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "formats/model.h"
#include "formats/scene_time.h"
#include "scene/scene.h"

namespace trace {

/// A file to be written.
struct NamedBytes {
  struct Contents {
    std::size_t objects = 0, triangles = 0;
  };

  std::string file, bytes;
  std::optional<Contents>
      holds{};           ///< where that is not what the scene holds, as when shapes become triangles
  std::string spared{};  ///< the file of the usual name, which belongs to something else and stays
};

struct WriteOptions {
  int digits = 0;      ///< significant digits of numbers in text; 0: as many as read back the same
  bool ascii = false;  ///< text, where a format has both
  int steps = 0;       ///< steps of shapes that become triangles; 0: 64, or fewer for slow ones
};

/// A file that was read, and the scene that it says.
struct SceneText {
  std::string file;
  std::shared_ptr<const std::string> bytes;
  Real time = 0;
  std::shared_ptr<const Scene> scene;
  std::optional<Vec3> lookAt{};  ///< the point that the text says the camera looks at, if it is said so
};

/// An edited scene as files, the scene's own first.
struct Rewritten {
  std::vector<NamedBytes> files;
  bool keepsAll = true;  ///< that a person wrote into the text: comments, nesting, keys of an animation
};

/// A row of the table. A format has `read` or `readAt`, or, if it holds meshes that other scenes may name,
/// `readModel` or `readModelAt`.
struct SceneFormat {
  std::string_view name;
  std::span<const std::string_view> suffixes;  ///< lower case with the dot, the usual one first
  std::string_view help;                       ///< one sentence, no full stop
  bool (*recognises)(std::string_view bytes);
  /// Whether a file with its suffix that no format recognises can be one; null where none can.
  bool (*mayBe)(std::string_view bytes) = nullptr;
  /// Repairs what it can with warnings. Throws Error(Fault::scene) for the rest.
  Scene (*read)(const std::string& file, std::string_view bytes, Messages& messages) = nullptr;
  /// The same at a moment, if the format knows time.
  Scene (*readAt)(const std::string& file, std::string_view bytes, Messages& messages,
                  SceneTime& time) = nullptr;
  Model (*readModel)(const std::string& file, std::string_view bytes, Messages& messages) = nullptr;
  Model (*readModelAt)(const std::string& file, std::string_view bytes, Messages& messages,
                       SceneTime& time) = nullptr;
  /// The scene as `file`, and what belongs beside it, as pictures. Warns of what the format cannot hold;
  /// throws Error(Fault::scene) if nothing is left.
  std::vector<NamedBytes> (*write)(const Scene& scene, const std::string& file, const WriteOptions& options,
                                   Messages& messages) = nullptr;
  bool keepsGroups = false;  ///< `write` takes groups and their placements; else they have to be copied()
  /// The scene, which was read as `read` of this format and edited, with as little of the text changed as
  /// possible.
  Rewritten (*rewrite)(const SceneText& read, const Scene& edited, const std::string& file,
                       Messages& messages) = nullptr;
};

std::span<const SceneFormat> sceneFormats();

/// The scene at `time`, in seconds. Throws Error(Fault::io) when the file cannot be read, Error(Fault::scene)
/// when no format fits or the content is wrong.
Scene readScene(const std::string& file, Messages& messages, Real time = 0);
Scene readScene(const std::string& file, std::string_view bytes, Messages& messages, Real time = 0);
/// The same; `time` then knows whether the scene changes with it.
Scene readScene(const std::string& file, std::string_view bytes, Messages& messages, SceneTime& time);

/// Whether the scene in the bytes may be another one at another moment: it is read to find out. False if it
/// cannot be read.
bool changesWithTime(const std::string& file, std::string_view bytes);

/// The meshes in the bytes of a file of a format with `readModel`, as they are at the time. Throws as
/// readScene().
Model readModel(const std::string& file, std::string_view bytes, Messages& messages, SceneTime& time);
/// At the time 0.
Model readModel(const std::string& file, std::string_view bytes, Messages& messages);

/// The row that writes files of that name, by its suffix in any case. Throws Error(Fault::usage).
const SceneFormat& writableFormatFor(const std::string& file);

/// The scene as `file`, by the row for its name: as the text that was read, if that is of the same format,
/// with the edits.
Rewritten writeEdited(const SceneText& read, const Scene& edited, const std::string& file,
                      Messages& messages);

}  // namespace trace
