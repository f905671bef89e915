#include "scene/surroundings.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "base/budget.h"
#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "image/codecs/codec.h"
#include "image/codecs/picture_name.h"
#include "scene/scene.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

/// A picture that stands for missing surroundings.
Picture missingPicture(int width, int height) {
  Picture checker(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) checker.at(x, y) = (x + y) % 2 ? Color(0) : Color(1, 0, 1);
  return checker;
}

class Reader {
 public:
  Reader(InputFiles& inputs, const PictureLimits& limits, Messages& messages)
      : inputs_(inputs), limits_(limits), messages_(messages) {}

  /// `name` may choose a layer.
  Picture picture(const std::string& name) {
    const std::string path = pictureName(name).file;
    std::string bytes;
    try {
      bytes = readBeside("", path);  // as a scene's files are: nothing that may have no end
    } catch (const Error&) {
      inputs_.noteNamed(path);
      throw;
    }
    inputs_.noteRead(path, bytes);
    Picture read = decodePicture(bytes, name, limits_);
    if (const std::string remark = pictureRemark(bytes, name); !remark.empty())
      messages_.warn(SourcePlace{.file = path}, remark);
    return read;
  }

  EnvironmentMap environment(const std::string& path, EnvironmentKind kind) {
    checkMayRead(pictureName(path).file);
    std::error_code ignored;
    const bool folder = fs::is_directory(path, ignored);
    if (folder || (kind != EnvironmentKind::latLong && kind != EnvironmentKind::angular)) {
      const std::string in = folder ? path : fs::path(path).parent_path().generic_string();
      std::array<std::string, 6> faces = facesIn(in.empty() ? "." : in, folder ? "" : path);
      const bool all = std::none_of(faces.begin(), faces.end(), [](const auto& f) { return f.empty(); });
      if (folder && !all) refuse(path, faces);
      if (all) {
        std::array<Picture, 6> pictures;
        for (std::size_t i = 0; i < 6; ++i) pictures[i] = picture(faces[i]);
        return checked(path, [&] { return EnvironmentMap(std::move(pictures)); });
      }
    }
    Picture read = picture(path);
    if (kind == EnvironmentKind::automatic) kind = kindByShape(read.width, read.height);
    return checked(path, [&] { return EnvironmentMap(std::move(read), kind); });
  }

 private:
  /// The files of the six faces, by their names; "" for one that is not there. With `like`, one of them, only
  /// those of its cube.
  static std::array<std::string, 6> facesIn(const std::string& folder, const std::string& like) {
    std::array<std::string, 6> faces;
    const FaceName one = faceByName(like);
    if (!like.empty() && one.face < 0) return faces;
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error))
      names.push_back(i->path().filename().generic_string());
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) {
      const FaceName is = faceByName(name);
      if (is.face < 0 || !isPicture(name) || (!like.empty() && is.rest != one.rest)) continue;
      std::string& file = faces[static_cast<std::size_t>(is.face)];
      if (file.empty()) file = (fs::path(folder) / name).generic_string();
    }
    return faces;
  }

  static bool isPicture(const std::string& name) { return pictureFormatNamed(name) != nullptr; }

  [[noreturn]] static void refuse(const std::string& folder, const std::array<std::string, 6>& faces) {
    std::string missing;
    for (std::size_t i = 0; i < 6; ++i)
      if (faces[i].empty())
        missing += (missing.empty() ? "" : ", ") + std::string(EnvironmentMap::kFaceNames[i]);
    throw Error(
        Fault::io, folder + ": expected six pictures of the faces of a cube, found none for: " + missing,
        "names of faces end in posx, negx, posy, negy, posz, negz, or in right, left, top, bottom, front, "
        "back");
  }

  template <class Make>
  static EnvironmentMap checked(const std::string& path, Make make) {
    try {
      return make();
    } catch (const std::invalid_argument& reason) {
      throw Error(Fault::io, path + ": " + reason.what(),
                  "--environment-kind says which kind of picture it is: lat-long, angular or cube");
    }
  }

  InputFiles& inputs_;
  const PictureLimits& limits_;
  Messages& messages_;
};

/// make() of the file that the option names, or what stands for it.
template <class Make, class Instead>
auto madeOr(const Scene& scene, const Option& option, const Settings& settings, Messages& messages, Make make,
            Instead instead) {
  const bool byScene = option.get(resolve({scene.choices})) == option.get(settings);
  try {
    if (!byScene) return make();
    const ReadScope scope = ReadScope::ofScene(scene.file);
    return make();
  } catch (const Error& error) {
    if (error.fault() == Fault::limit) throw;
    Message message = error.messages().front();
    message.what = std::string(option.name) + ": " + message.what;
    if (!byScene) {
      message.what = "--" + message.what;
      if (message.hint.empty())
        message.hint = "name a picture file; --" + std::string(option.name) + " none leaves it out";
      throw Error(Fault::io, {message});
    }
    SourcePlace place{.file = scene.file};
    for (const Choice& choice : scene.choices)
      if (choice.option == option.name) place = choice.place;
    if (dynamic_cast<const ReadDenied*>(&error)) {
      message.place = place;
      throw ReadDenied(error.fault(), {message});
    }
    messages.warn(place, message.what, "a checker of magenta and black shows instead");
    return instead();
  }
}

}  // namespace

void readSurroundings(Scene& scene, const Settings& settings, const PictureLimits& limits, Messages& messages,
                      const Surroundings* before) {
  Surroundings& now = scene.surroundings;
  if (before && !now.backdrop && !now.environment && !now.aperture) now = *before;
  Reader reader(now.files, limits, messages);
  if (now.backdropFile != settings.backdrop) {
    now.backdrop = nullptr;
    now.backdropFile = settings.backdrop;
    if (const std::string& file = settings.backdrop.path; !file.empty()) {
      const Work work("reading the backdrop");
      now.backdrop = std::make_shared<const Picture>(madeOr(
          scene, findOption("backdrop"), settings, messages, [&] { return reader.picture(file); },
          [] { return missingPicture(16, 12); }));
    }
  }
  if (now.apertureFile != settings.aperturePicture) {
    now.aperture = nullptr;
    now.apertureFile = settings.aperturePicture;
    if (const std::string& file = settings.aperturePicture.path; !file.empty()) {
      const Work work("reading the lens opening");
      now.aperture = std::make_shared<const Aperture>(madeOr(
          scene, findOption("aperture-picture"), settings, messages,
          [&] {
            Picture picture = reader.picture(file);
            if (std::all_of(picture.pixels.begin(), picture.pixels.end(), isBlack))
              messages.warn(SourcePlace{.file = file},
                            "aperture-picture: the picture is black everywhere: all of it counts as open",
                            "white is open, and black is closed");
            return picture;
          },
          [] { return missingPicture(8, 8); }));
    }
  }
  const bool sameMap = now.environmentFile == settings.environment && now.kind == settings.environmentKind;
  if (!sameMap) {
    now.environment = now.sharpEnvironment = nullptr;
    now.environmentFile = settings.environment;
    now.kind = settings.environmentKind;
    if (const std::string& file = settings.environment.path; !file.empty()) {
      const Work work("reading the environment");
      now.sharpEnvironment = std::make_shared<const EnvironmentMap>(madeOr(
          scene, findOption("environment"), settings, messages,
          [&] { return reader.environment(file, settings.environmentKind); },
          [] { return EnvironmentMap(missingPicture(36, 18), EnvironmentKind::latLong); }));
    }
  }
  if (!sameMap || now.blur != settings.environmentBlur) {
    now.blur = settings.environmentBlur;
    now.environment = now.sharpEnvironment;
    if (now.sharpEnvironment && now.blur > 0) {
      const Work work("blurring the environment");
      now.environment =
          std::make_shared<const EnvironmentMap>(now.sharpEnvironment->blurred(now.blur, settings.threads));
    }
  }
  scene.inputs.note(now.files);
}

}  // namespace trace
