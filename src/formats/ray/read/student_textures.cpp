#include "formats/ray/read/student_textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "formats/ray/read/fields.h"
#include "math/elementary.h"
#include "shading/textures/marble.h"

namespace trace::rayfile {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kSynonyms{{{"checkerboard", "checker"},
                                                                                  {"bricks", "brick"},
                                                                                  {"perlin", "noise"},
                                                                                  {"worley", "cells"},
                                                                                  {"voronoi", "cells"},
                                                                                  {"dots", "spots"}}};

struct StudentMarble {
  static constexpr std::string_view kKeyword = "marble";
  Color color{1};
  Real lightness = 0.5, contrast = 1, frequency = 1;
  Vec3 scale{1, 1, 1};
  int depth = 4;

  static constexpr auto fields() {
    return Fields{Field{"color", &StudentMarble::color, "", 0, kNoLimit, ""},
                  Field{"lightness", &StudentMarble::lightness, "", 0, 1, ""},
                  Field{"contrast", &StudentMarble::contrast, "", -kNoLimit, kNoLimit, ""},
                  Field{"frequency", &StudentMarble::frequency, "", -kNoLimit, kNoLimit, ""},
                  Field{"scale", &StudentMarble::scale, "", -kNoLimit, kNoLimit, ""},
                  Field{"depth", &StudentMarble::depth, "", 1, FractalSum::kMostOctaves, ""}};
  }
};

Marble asMarble(const StudentMarble& said) {
  Marble marble;
  marble.sum = SumKind::fractal;
  marble.octaves = std::clamp(said.depth, 1, FractalSum::kMostOctaves);
  marble.grain = said.scale;
  marble.frequency = said.frequency / (2 * kPi);
  Real squares = 0;  // a fractal sum is made as strong as one octave
  for (int i = 0; i < marble.octaves; ++i) squares += math::pow(0.25, i);
  marble.turbulence = marble.frequency * said.contrast * std::sqrt(squares);
  const Real dark = 2 * said.lightness - 1;
  marble.a = said.color;
  marble.b = said.color * max(dark, 0);
  if (dark < 0)  // what is below black is black
    marble.ramp = {{0, said.color.r, said.color.g, said.color.b}, {1 / (1 - dark), 0, 0, 0}};
  return marble;
}

}  // namespace

std::string_view textureKeyword(std::string_view word) {
  for (const auto& [theirs, ours] : kSynonyms)
    if (word == theirs) return ours;
  return word;
}

bool readStudentMarble(Findings& findings, const Item& block, TextureNode& to) {
  bool isOne = false;
  for (const Item field : block)
    for (const std::string_view word : {"color", "lightness", "contrast", "depth"})
      isOne |= field.keyed() && canonical(field.key()) == word;
  if (!isOne) return false;
  StudentMarble said;
  RepeatedFields repeats(findings, StudentMarble::kKeyword);
  for (const Item field : block) {
    if (!isField(findings, field, StudentMarble::kKeyword)) continue;
    repeats.note(field);
    if (field.key() == "name")
      rayfile::read(findings, field.key(), field.value(), to.name);
    else if (assignField(findings, said, field))
      checkRange(findings, said, field);
    else
      findings.unknownField(StudentMarble::kKeyword, field, keywords<StudentMarble>({"name"}));
  }
  to.model = asMarble(said);
  // Their layers begin with a sine, which is brightest a quarter of a layer on.
  if (said.frequency != 0) to.placement.translate = {0.5 * kPi / said.frequency, 0, 0};
  return true;
}

}  // namespace trace::rayfile
