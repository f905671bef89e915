// The numbers of one sample of a pixel: where it lies in the picture, and every choice on its way.
//
// Each number is a function of (seed, pixel, sample, branch, dimension) and of nothing else, so that a
// picture has the same bits for any number of threads, and a pixel that is explained is the one that was
// rendered.
#pragma once

#include <cstdint>

#include "math/noise.h"
#include "render/render.h"

namespace trace {

class SampleRules;

/// THE table of generators: rules by which samples are spread. A new one is a row in sampler.cpp.
struct GeneratorRow {
  std::string_view name;
  std::string_view help;
  /// Where in the picture sample k of the pixel lies, from 0 to 1, (0, 0) at the bottom left. Row y = 0 is
  /// the top.
  Vec2 (*film)(const SampleRules& rules, int x, int y, int k);
  /// Number `dimension` of a branch, from 0 up to 1; the key is a hash of seed, pixel, sample and branch.
  Real (*number)(std::uint64_t key, std::uint32_t dimension);
};
std::span<const GeneratorRow> generators();

/// What the samplers of a picture share.
class SampleRules {
 public:
  SampleRules(const Settings& settings, const Size& size);

  int samples() const { return grid_ * grid_; }  ///< of each pixel
  const GeneratorRow& generator() const { return *generator_; }
  std::uint64_t seed() const { return 0; }

  /// The place of a cell of the grid of a pixel, in the picture, from 0 to 1 (generator "grid").
  Vec2 cell(int x, int y, int k) const;

 private:
  Real place(int pixel, int cell, int pixels) const;

  const GeneratorRow* generator_;
  Size size_;
  int grid_;                  ///< a pixel's samples lie on a grid of so many columns and rows
  bool toBorder_;             ///< the outermost rays go through the border of the picture
  std::vector<Real> places_;  ///< if they do not: of the cells of the grid within a pixel
};

class Sampler {
 public:
  /// Of sample 0 <= k < rules.samples(); the rules must outlive it.
  Sampler(const SampleRules& rules, int x, int y, int k) : rules_(&rules), x_(x), y_(y), k_(k) {
    const auto bits = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
    key_ = mixBits(mixBits(rules.seed() ^ (bits(x) << 32 | bits(y))) ^ bits(k));
  }

  /// Where in the picture the sample lies, from 0 to 1, (0, 0) at the bottom left.
  Vec2 film() const { return rules_->generator().film(*rules_, x_, y_, k_); }

  /// The number of the sample in its pixel.
  int sample() const { return k_; }

  /// The next number, from 0 up to 1; the next two.
  Real next() { return rules_->generator().number(key_, dimension_++); }
  Vec2 next2() {
    const Real first = next();
    return {first, next()};
  }

  /// Numbers of its own for the n-th ray that is sent from here, whatever has been drawn here and elsewhere:
  /// a changed depth, light or extra changes only its own rays.
  Sampler branch(std::uint32_t n) const {
    Sampler sampler(*this);
    sampler.key_ = mixBits(key_ + 1 + n);
    sampler.dimension_ = 0;
    return sampler;
  }

 private:
  const SampleRules* rules_;
  int x_, y_, k_;
  std::uint64_t key_;
  std::uint32_t dimension_ = 0;
};

}  // namespace trace
