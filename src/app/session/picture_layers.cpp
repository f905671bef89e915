// Names of layers and channels are those that Nuke, Blender and tev know: docs/passes.md has the table.
#include "app/session/picture_layers.h"

#include <algorithm>
#include <array>
#include <new>
#include <utility>
#include <vector>

#include "base/budget.h"
#include "base/error.h"
#include "image/codecs/codec.h"
#include "image/codecs/exr_file.h"
#include "image/cryptomatte.h"
#include "render/picture/passes.h"

namespace trace {
namespace {

const PictureFormat* exrFormat() {
  static const PictureFormat* const format = pictureFormatNamed("picture.exr");
  return format;
}
const PictureFormat* pngFormat() {
  static const PictureFormat* const format = pictureFormatNamed("picture.png");
  return format;
}

/// The layer and its channels of a pass whose values are numbers; the values of the others are colours.
struct LayerNames {
  Pass pass;
  std::array<std::string_view, 3> channels;  ///< "" for none
};
constexpr std::array kLayerNames{
    LayerNames{Pass::depth, {"Z", "", ""}},
    LayerNames{Pass::normal, {"N.X", "N.Y", "N.Z"}},
    LayerNames{Pass::id, {"id.Y", "", ""}},
    LayerNames{Pass::uv, {"uv.U", "uv.V", ""}},
    LayerNames{Pass::position, {"P.X", "P.Y", "P.Z"}},
    LayerNames{Pass::samples, {"samples.Y", "", ""}},
    LayerNames{Pass::occlusion, {"occlusion.Y", "", ""}},
    LayerNames{Pass::motion, {"forward.u", "forward.v", ""}},
    LayerNames{Pass::variance, {"variance.Y", "", ""}},
};

std::vector<std::string> colorNames(const std::string& layer) {
  const std::string start = layer.empty() ? "" : layer + ".";
  return {start + "R", start + "G", start + "B"};
}

std::vector<std::string> channelsOf(const PassRow& pass) {
  std::vector<std::string> names;
  for (const LayerNames& row : kLayerNames)
    if (row.pass == pass.pass)
      for (const std::string_view channel : row.channels)
        if (!channel.empty()) names.emplace_back(channel);
  return names.empty() ? colorNames(std::string(pass.name)) : names;
}

/// A file for the part of the picture that is rendered.
ExrFile fileFor(const FinishedFilm& f, const Size& size, const Metadata& words) {
  const Size whole{f.film.width(), f.film.height()};
  const bool isWhole = size.width != whole.width || f.settings.region.whole();
  const Tile area = isWhole ? Tile{0, 0, size.width, size.height} : areaOf(f.settings.region, whole);
  return {size.width, size.height, area, {}, words, {}};
}

void addLight(ExrFile& file, const FinishedFilm& f, const PassRow& pass) {
  const LightLayers layers = lightLayersOf(f.settings, f.names.groups.size());
  const int first = pass.pass == Pass::direct ? layers.direct : layers.indirect;
  for (std::size_t group = 0; first >= 0 && group < f.names.groups.size(); ++group)
    addChannels(file, f.film.layer(static_cast<std::size_t>(first) + group),
                colorNames(std::string(pass.name) + "." + f.names.groups[group]));
}

void addMattes(ExrFile& file, const FinishedFilm& f, const PassRow& pass) {
  const bool objects = pass.pass == Pass::object;
  addCryptomatte(file, objects ? "CryptoObject" : "CryptoMaterial",
                 objects ? f.names.objects : f.names.materials,
                 f.film.shares(static_cast<std::size_t>(layerOf(f.settings, pass.name))));
}

bool isLight(const PassRow& pass) { return pass.pass == Pass::direct || pass.pass == Pass::indirect; }
bool isMatte(const PassRow& pass) { return pass.pass == Pass::object || pass.pass == Pass::material; }

Picture valuesOf(const PassRow& pass, const FinishedFilm& f) {
  return valuesOf(pass, f.film, f.settings, f.names, f.shown);
}

void addLayer(ExrFile& file, const FinishedFilm& f, const PassRow& pass) {
  if (isLight(pass)) return addLight(file, f, pass);
  if (isMatte(pass)) return addMattes(file, f, pass);
  addChannels(file, valuesOf(pass, f), channelsOf(pass));
}

/// A pass as a file of its own: its values are the colours.
std::string encodedPass(const PassRow& pass, const FinishedFilm& f, const Metadata& words) {
  const Picture values = valuesOf(pass, f);
  ExrFile file = fileFor(f, {values.width, values.height}, words);
  addChannels(file, isMatte(pass) ? pass.shown(values, f.settings) : values, colorNames(""));
  if (isLight(pass)) addLight(file, f, pass);
  if (isMatte(pass)) addMattes(file, f, pass);
  return encodeExr(file);
}

/// The alpha of each pixel, in all channels.
Picture alphaOf(const FinishedFilm& f) {
  const LightLayers layers = lightLayersOf(f.made, f.names.groups.size());
  if (layers.alpha >= 0 && static_cast<std::size_t>(layers.alpha) < f.film.layers())
    return f.film.layer(static_cast<std::size_t>(layers.alpha));
  Picture opaque(f.film.width(), f.film.height());
  std::fill(opaque.pixels.begin(), opaque.pixels.end(), Color(1));
  return opaque;
}

bool wantsLayers(const Settings& settings) { return settings.passFormat == PassFormat::layers; }

std::string encodedExr(const Picture& picture, const FinishedFilm& f, const Metadata& words) {
  ExrFile file = fileFor(f, {picture.width, picture.height}, words);
  addChannels(file, picture, colorNames(""));
  if (f.settings.alpha || wantsLayers(f.settings)) {
    const std::string alpha[] = {"A"};
    addChannels(file, alphaOf(f), alpha);
  }
  if (wantsLayers(f.settings))
    for (const PassRow* pass : passesOf(f.settings)) addLayer(file, f, *pass);
  return encodeExr(file);
}

/// Colours are not multiplied by alpha in PNG.
std::string encodedPng(const Picture& picture, const FinishedFilm& f, const Metadata& words) {
  const Picture alpha = alphaOf(f);
  Picture straight = picture;
  for (std::size_t i = 0; i < straight.pixels.size(); ++i)
    if (const double a = alpha.pixels[i].r; a > 0) straight.pixels[i] = straight.pixels[i] / a;
  const Bytes bytes = toBytes(developed(std::move(straight), developmentOf(f.settings)), f.settings.rounding);
  Raster raster(picture.width, picture.height, 4, 255);
  std::vector<std::uint8_t> samples;
  samples.reserve(raster.count());
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    samples.insert(samples.end(), bytes.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i),
                   bytes.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
    samples.push_back(toLevel(alpha.pixels[i].r, Rounding::nearest));
  }
  raster.samples = std::move(samples);
  return withPngText(encodePng(raster), words);
}

std::string encoded(const Output& output, const FinishedFilm& f, const Metadata& words) {
  const PictureFormat& format = pictureFormatFor(output.path);
  const Settings& settings = f.settings;
  Encoding encoding(settings.rounding, settings.jpegQuality);
  if (output.pass.empty()) {
    const Picture combined = isAnaglyph(settings.stereo) ? finished(f.shown, settings) : Picture();
    const Picture& picture = isAnaglyph(settings.stereo) ? combined : f.shown;
    if (&format == exrFormat()) return encodedExr(picture, f, words);
    if (&format == pngFormat() && settings.alpha && !isAnaglyph(settings.stereo))
      return encodedPng(picture, f, words);
    if (!format.keepsBright) encoding.development = developmentOf(settings);
    return encodePicture(format, picture, encoding, words);
  }
  const auto passes = passesOf(settings);
  const auto pass = std::find_if(passes.begin(), passes.end(),
                                 [&](const PassRow* row) { return row->name == output.pass; });
  if (&format == exrFormat()) return encodedPass(**pass, f, words);
  return encodePicture(format, (*pass)->shown(valuesOf(**pass, f), settings), encoding, words);
}

}  // namespace

std::string encodedOutput(const Output& output, const FinishedFilm& finished, const Metadata& words) {
  const std::string name(pictureFormatFor(output.path).name);
  checkEncodable(pictureFormatFor(output.path), finished.shown.width, finished.shown.height);
  try {
    return encoded(output, finished, words);
  } catch (const std::bad_alloc&) {
    throw Error(Fault::limit, "not enough memory to write this picture as " + name);
  } catch (const Error&) {  // the time is over
    throw;
  } catch (const std::exception& e) {
    throw Error(Fault::io, "cannot write a picture as " + name + ": " + e.what());
  }
}

void checkHoldsLayers(const std::string& path, const Settings& settings) {
  if (!wantsLayers(settings)) return;
  if (&pictureFormatFor(path) != exrFormat())
    throw Error(Fault::usage,
                "--pass-format layers: expected a picture whose name ends in .exr, found \"" + path + "\"",
                "-o picture.exr; other formats hold no layers");
  if (isAnaglyph(settings.stereo))
    throw Error(Fault::usage, "--pass-format layers: a picture of two eyes in one place has no layers",
                "--stereo side-by-side has");
}

bool storesAlpha(const std::string& path) {
  const PictureFormat* format = &pictureFormatFor(path);
  return format == exrFormat() || format == pngFormat();
}

}  // namespace trace
