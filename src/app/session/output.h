// The files that a render writes: the picture, and one more for each pass.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "image/codecs/metadata.h"
#include "image/film/film.h"
#include "render/picture/pass_facts.h"
#include "render/picture/render.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace trace {

struct Output {
  std::string path;
  int layer = -1;  ///< number of the layer of the Film; -1 is the picture, or a pass that is made of it
  std::string_view pass;  ///< its name; "" is the picture
};

/// The picture at `path` first, then "NAME.PASS.exr" and the like beside it, in the order of the table of
/// passes, unless they are layers of the picture. Throws Error(Fault::usage) if it cannot hold these.
std::vector<Output> outputs(const std::string& path, const Settings& settings);

/// Whether a picture file of that name has room for words, such as how it was made.
bool keepsWords(const std::string& path);

/// Is the whole file there, of this size, rendered to its end, and were its words those of `metadata`?
/// Options that do not change pixels, such as --pass-name, do not count. Never of a format that keeps no
/// words.
bool isRendered(const Output& output, const Size& size, const Metadata& metadata);

/// Version and build of the program, name of the scene, and the settings that differ from the defaults:
/// all but those of the group Resources, which do not change the picture.
Metadata describe(const Scene& scene, const Settings& settings);

/// The picture that the file shows of a render: two eyes combined, if that is asked for.
Picture finished(Picture rendered, const Settings& settings);
Size finished(const Size& rendered, const Settings& settings);

/// Throws Error(Fault::usage) if the file is one of the inputs: what is read, or only named, is not written
/// over.
void checkIsNoInput(const std::string& path, const InputFiles& inputs);

/// The steps between a film and its file.
enum class LastSteps {
  all,
  plain,  ///< nothing that may take long: no noise taken out, no bloom, no passes; a fragment therefore
};

/// The files that one render writes, perhaps several times before it is done. A fragment, which is a film
/// with tiles to come, takes no place but that of another fragment: where anything else lies under the name,
/// it goes beside it, as NAME.partial.png. Its picture has the word Incomplete; a file of a format that keeps
/// no words is known for a fragment by its name alone.
class PictureFiles {
 public:
  /// `inputs` are the files that a fragment must not replace either.
  /// `names` are those that the film was made with.
  PictureFiles(std::string path, InputFiles inputs, PassNames names = {})
      : path_(std::move(path)), inputs_(std::move(inputs)), names_(std::move(names)) {}

  const std::string& path() const { return path_; }

  /// Writes the picture and its passes: what is done of the film so far, and `metadata`, to which the words
  /// Pass, of a pass, and Incomplete are added. A picture gets the tone of the settings unless its format
  /// keeps values above 1; passes are raw in OpenEXR only. Returns the picture's name: path(), or where a
  /// fragment went. The whole picture takes away the fragment that this wrote beside it, and those of earlier
  /// runs whose words say that they are fragments of the very same picture, all with any passes. Every step
  /// looks at the budget of the thread. Throws Error(Fault::io), Error(Fault::usage), and what the budget
  /// throws; written() then tells which of the files are there.
  std::string write(const Film& film, const Settings& settings, const Metadata& metadata,
                    LastSteps finish = LastSteps::all);

  /// The files that the last write() put in their places.
  const std::vector<std::string>& written() const { return written_; }

  /// By how much --denoise changed what was written last: levels of 255, on the average. Nothing if it did
  /// not.
  std::optional<double> denoiseChange() const { return change_; }

  /// The fragments that were taken away so.
  const std::vector<std::string>& removed() const { return removed_; }

 private:
  void removeFragments(const Settings& settings, const Metadata& metadata);
  bool isInput(const std::string& path) const;
  std::string placeOfFragment(const Settings& settings) const;
  bool isFree(const std::string& path, const Settings& settings) const;

  std::string path_;
  InputFiles inputs_;
  PassNames names_;
  std::string fragment_;  ///< where this has put one; "" before
  std::vector<std::string> removed_, written_;
  std::optional<double> change_;
};

}  // namespace trace
