// The checkpoint that an unfinished render leaves next to its picture so that the next run continues where it
// ended: NAME.png.checkpoint, or with -2, -3, ... where others lie.
//
// A few lines of text say of which picture it is, and a Film (Film::saved) follows. It is written whole or
// not at all. A checkpoint of another picture is never replaced, nor is one that holds more.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "app/session/version.h"
#include "image/codecs/metadata.h"
#include "image/film/film.h"
#include "scene/settings.h"

namespace trace {

class Checkpoint {
 public:
  /// For the picture of that file, which has these words (Session::metadata()). Whatever changes a sample
  /// counts, and so do the number of samples, unless more can be added to them, and the program
  /// (programText()). Of a part of the picture, that of another one is of another picture.
  Checkpoint(const std::string& picture, const Metadata& metadata, const Settings& settings,
             const std::string& program = programText(), const TileShare& share = {});

  /// Fills the film from the first file that fits, if there is one. Files are not trusted: whatever stands in
  /// them does no harm.
  bool load(Film& film);
  /// Why a file that lies there did not fit, of several the one that comes nearest, for a person:
  /// "out.png.checkpoint: it is of another picture"; "" if there was none.
  const std::string& whyNot() const { return whyNot_; }
  /// load() has found files of this picture that are damaged: save() leaves them alone, remove() does not.
  bool damaged() const { return !damaged_.empty(); }

  /// Where it is written; "" before load() has found one, or save() has written.
  const std::string& path() const { return path_; }
  /// Writes what is there of the film, unless the file holds as much. Throws Error(Fault::io).
  void save(const Film& film);
  /// Whether a file of this picture lies there.
  bool exists() const;
  /// Files that lie there and are of other pictures, or damaged.
  std::vector<std::string> others() const;
  /// Removes those of this picture that hold no more than the film.
  void remove(const Film& film);

 private:
  /// The checkpoints next to the picture, by their number.
  std::vector<std::string> all() const;
  bool isOurs(const std::string& path) const;

  std::string picture_, identity_;
  std::set<std::string> damaged_;
  std::string path_;
  std::string whyNot_;
};

}  // namespace trace
