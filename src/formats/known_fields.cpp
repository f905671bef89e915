// The table of known formats, and docs/formats.md, which is made of it.
#include "formats/known_fields.h"

#include <algorithm>
#include <array>

#include "formats/format.h"
#include "image/codecs/codec.h"

namespace trace {
namespace {

std::string codeOf(std::string_view field) {
  return field.find('`') == field.npos ? "`" + std::string(field) + "`" : std::string(field);
}

std::string_view fateName(KnownField::Fate fate) {
  switch (fate) {
    case KnownField::Fate::shown: return "shown";
    case KnownField::Fate::reported: return "reported";
    case KnownField::Fate::refused: return "refused";
    case KnownField::Fate::idle: return "not needed";
  }
  return {};
}

/// Rows that follow each other and say the same are one.
std::string fieldTable(std::span<const KnownField> fields) {
  std::string text = "| field | is | as, or why |\n|---|---|---|\n";
  for (std::size_t i = 0; i < fields.size();) {
    const KnownField& first = fields[i];
    std::string names;
    for (; i < fields.size() && fields[i].fate == first.fate && fields[i].becomes == first.becomes; ++i)
      names += (names.empty() ? "" : " ") + codeOf(fields[i].field);
    text += "| " + names + " | " + std::string(fateName(first.fate)) + " | " + std::string(first.becomes) +
            " |\n";
  }
  return text;
}

std::string suffixesOf(const SceneFormat& format) {
  std::string list;
  for (std::string_view suffix : format.suffixes) list += (list.empty() ? "" : ", ") + std::string(suffix);
  return list;
}

constexpr std::string_view kPageHead = R"(# Scene, mesh and picture formats

This page is made by `./dev docs` from the program's table of fields. A test reads a file with each field, and one without.

Every field of another program's format is one of four:

* **shown**: the picture depends on it.
* **reported**: it is left out, with one warning. The warning counts all of its kind, and names the line of one in most text formats.
* **refused**: a file that needs it is not read, and the error says so. A refused texture becomes a checker, with a warning.
* **not needed**: it does not affect a still picture. Nothing is reported.

Words, nodes and properties without a table entry are reported as unknown. Parts of pictures and fields of VRML's groups without an
entry are skipped.

Trace recognises a file by its content. If the content is ambiguous, as for an OFF file without its first word, the suffix
decides. An output file has the format of its suffix. `ray info FILE` reports the contents of a file.

)";

constexpr std::string_view kPageCommon = R"(
`.ray` scenes have a page of their own, [ray-format.md](ray-format.md), and so have the [course formats](course-formats.md).
[mesh-files.md](mesh-files.md) says how a mesh file is rendered, what a glTF material becomes, and what is written.

## All text formats

They may begin with a byte order mark, be UTF-16 or UTF-32, be compressed with gzip, and have blanks before their first word. That
word may be in capitals. Lines may end in a carriage return alone. The file may end in the DOS end of file (0x1A) or zeros. Lines and
columns of messages are those that an editor shows.

Names of other files are looked up as written, and then as other systems write them: in quotation marks, with
backslashes, with `%20` for a blank, with the folder of another machine. A file whose name differs in the case of its letters is
taken with a warning. Only files below the scene's folder may be read ([security.md](security.md)).
)";

}  // namespace

std::span<const KnownFormat> knownFormats() {
  static const std::array kAll{
      KnownFormat{
          "obj", "OBJ",
          "An object for each group or object and material. A material file that is not there is a warning. "
          "A bad number costs only the faces that use it. Colours of points multiply the material's.",
          knownObjFields()},
      KnownFormat{
          "obj", "MTL, the materials of OBJ",
          "A material becomes [Phong](shading.md), or [principled](materials.md#principled) if it "
          "has one of `Pr Pm Ps Pc aniso`. Keywords may be in upper or lower case. Options of a map may "
          "stand before or after its name.",
          knownMtlFields()},
      KnownFormat{"ply", "PLY",
                  "Text and binary, of both byte orders, with elements in any order and numbers of any type. "
                  "Whole-number colours count to 255 or 65535, others to 1.",
                  knownPlyFields()},
      KnownFormat{"stl", "STL",
                  "Text and binary. A binary file called `.stl` may have more bytes than its facets take.",
                  knownStlFields()},
      KnownFormat{"off", "OFF", "Text. A file called `.off` may lack its first word.", knownOffFields()},
      KnownFormat{
          "gltf", "glTF 2.0",
          "Text and binary. A file of version 1.0 is read as one of 2.0, without its techniques, shaders, "
          "skins and "
          "lights. A value out of its range is a warning. Invalid JSON is an error with line and column.",
          knownGltfFields()},
      KnownFormat{
          "gltf", "Extensions of glTF",
          "[mesh-files.md](mesh-files.md#materials-of-gltf) says what a material with extensions becomes.",
          knownGltfExtensionFields()},
      KnownFormat{"inventor", "Open Inventor and VRML 1.0",
                  "Text, also compressed with gzip. Lights shine on everything, not only on what follows "
                  "them. [course-formats.md](course-formats.md#open-inventor-vrml-10-vrml97) has more.",
                  knownInventorFields()},
      KnownFormat{"inventor", "VRML97", "Text, also compressed with gzip.", knownVrml97Fields()},
      KnownFormat{"PNG", "PNG",
                  "All bit depths and colour types are read. Colours are taken as they are, and decoded as "
                  "sRGB where a scene says so. So a gamma or a "
                  "profile of another kind is reported.",
                  knownPngFields()},
      KnownFormat{"JPEG", "JPEG", "Grey, colour and CMYK of 8 bits.", knownJpegFields()},
      KnownFormat{"BMP", "BMP", "All headers of Windows and OS/2.", knownBmpFields()},
      KnownFormat{"TGA", "TGA", "Version 1 and 2.", knownTgaFields()},
      KnownFormat{"HDR", "Radiance HDR", "Brightness and colours are those that were measured.",
                  knownHdrFields()},
      KnownFormat{"EXR", "OpenEXR", "All compressions that OpenEXR reads.", knownExrFields()},
      KnownFormat{"PPM", "PBM, PGM, PPM and PAM",
                  "Netpbm's formats, whatever the suffix. Written is P6 with a maximum of 255.",
                  knownPpmFields()},
      KnownFormat{"PFM", "PFM", "Floats, of both byte orders.", knownPfmFields()},
      KnownFormat{"WebP", "WebP", "Read, not written.", knownWebpFields()},
  };
  return kAll;
}

std::string formatsMarkdown() {
  std::string text(kPageHead);
  text += "| scene format | suffixes | what it is | |\n|---|---|---|---|\n";
  for (const SceneFormat& format : sceneFormats())
    text += "| `" + std::string(format.name) + "` | " + suffixesOf(format) + " | " +
            std::string(format.help) + " | " + (format.write ? "read and written" : "read") + " |\n";
  text += "\n| picture format | suffixes | what it is |\n|---|---|---|\n";
  for (const PictureFormat& format : pictureFormats()) {
    std::string list;
    for (std::string_view suffix : format.suffixes) list += (list.empty() ? "" : ", ") + std::string(suffix);
    text += "| " + std::string(format.name) + " | " + list + " | " + std::string(format.help) + " |\n";
  }
  text += kPageCommon;
  for (const KnownFormat& format : knownFormats())
    text += "\n## " + std::string(format.title) + "\n\n" + std::string(format.text) + "\n\n" +
            fieldTable(format.fields);
  return text;
}

}  // namespace trace
