// The contents of the files of a render: colours with alpha, and passes as files of their own or as layers.
#pragma once

#include <string>

#include "app/session/output.h"
#include "image/codecs/metadata.h"
#include "image/film/film.h"
#include "image/picture.h"
#include "render/picture/pass_facts.h"
#include "scene/settings.h"

namespace trace {

/// A film as it is written.
struct FinishedFilm {
  const Film& film;
  const Picture& shown;  ///< its picture, perhaps without noise
  const Settings& settings;
  const Settings& made;  ///< settings that the film was made for: it may have passes that are not written
  const PassNames& names;
};

/// The bytes of the file. Throws Error as encodePicture().
std::string encodedOutput(const Output& output, const FinishedFilm& finished, const Metadata& words);

/// Throws Error(Fault::usage) if a picture of that name cannot hold the layers that the settings ask for.
void checkHoldsLayers(const std::string& path, const Settings& settings);

/// Whether a picture file of that name stores alpha.
bool storesAlpha(const std::string& path);

}  // namespace trace
