// A film in a file, as checkpoints (checkpoint.h) and parts of a picture (picture_part.h) are: a few lines of
// text that say of which picture it is, and then the bytes of Film::saved.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "image/codecs/metadata.h"
#include "image/film/film.h"
#include "scene/settings.h"

namespace trace {

/// The lines that say of which picture a film is: the program, the scene, all options that affect its
/// samples, and of a part of it which one.
std::string filmIdentity(const Metadata& metadata, const Settings& settings, const std::string& program,
                         const TileShare& share = {});

/// The lines before the film.
struct FilmHead {
  std::string identity;
  std::int64_t done = 0;   ///< samples of tiles
  std::string hash;        ///< hash of the film
  std::size_t length = 0;  ///< length of these lines, in bytes
};
/// Nothing of a file that holds no film. Files are not trusted: `identity` is any text.
std::optional<FilmHead> filmHead(const std::string& path);

/// The bytes of the file's film, which Film checks; nothing if they have another hash than the head says.
/// Throws Error(Fault::io).
std::optional<std::string> filmBytes(const std::string& path, const FilmHead& head);

/// Writes the film, whole or not at all. Throws Error(Fault::io).
void writeFilm(const std::string& path, const std::string& identity, const Film& film);

/// Adds a part of the picture with this identity to the film (Film::merge). Throws Error(Fault::io) with the
/// file if it is not that part, damaged, or unfinished; the film may then be blank.
void mergePart(Film& film, const std::string& path, const std::string& identity, const TileShare& share);

/// In what two pictures differ.
struct IdentityDifference {
  std::string what;      ///< for a person: "--depth differs"
  std::size_t size = 0;  ///< how far they are apart
};
/// From the picture of a file to the one that is wanted.
IdentityDifference differenceOf(const std::string& its, const std::string& ours);

}  // namespace trace
