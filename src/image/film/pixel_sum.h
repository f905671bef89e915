// The state of one pixel while its samples come in.
#pragma once

#include <cmath>
#include <memory>

#include "math/color.h"

namespace trace {

/// The mean of samples that may count differently, and below 0: the sum of weight times colour by that of the
/// weights, so that a plain surface stays plain. Where those below 0 nearly undo the others, at random, they
/// do not count.
class WeightedMean {
 public:
  WeightedMean() = default;
  WeightedMean(const WeightedMean& other)
      : sum_(other.sum_),
        weights_(other.weights_),
        above_(other.above_ ? std::make_unique<Above>(*other.above_) : nullptr) {}
  WeightedMean(WeightedMean&&) = default;
  WeightedMean& operator=(WeightedMean other) {
    sum_ = other.sum_;
    weights_ = other.weights_;
    above_ = std::move(other.above_);
    return *this;
  }
  ~WeightedMean() = default;

  void add(const Color& color, double weight) {
    if (weight < 0 && !above_) above_ = std::make_unique<Above>(above());
    sum_ += color * weight;
    weights_ += weight;
    if (above_ && weight > 0) {
      above_->sum += color * weight;
      above_->weights += weight;
    }
  }
  Color mean() const {
    if (usesAll()) return weights_ != 0 ? sum_ / weights_ : Color(0);
    return above_->sum / above_->weights;
  }
  /// The mean of another value of the same samples: of the sum of weight times value, and the part of it with
  /// weights below 0. Values that sum to the colour have means that sum to mean().
  Color meanOf(const Color& sum, const Color& below) const {
    if (usesAll()) return weights_ != 0 ? sum / weights_ : Color(0);
    return (sum + below * -1) / above_->weights;
  }
  /// Without those that are among them.
  WeightedMean without(const WeightedMean& part) const {
    WeightedMean rest;
    rest.sum_ = sum_ + part.sum_ * -1;
    rest.weights_ = weights_ - part.weights_;
    const Above all = above(), left = part.above();
    if (above_ || part.above_)
      rest.above_ = std::make_unique<Above>(Above{all.sum + left.sum * -1, all.weights - left.weights});
    return rest;
  }
  /// The weight of a sample in it, one of `count`: 1 if all count alike.
  double counts(double weight, double count) const {
    if (usesAll()) return weights_ != 0 ? weight * count / weights_ : 0;
    return weight > 0 ? weight * count / above_->weights : 0;
  }

 private:
  friend class FilmState;
  friend class FilmPixels;
  /// Those of weights above 0.
  struct Above {
    Color sum;
    double weights;
  };
  Above above() const { return above_ ? *above_ : Above{sum_, weights_}; }
  bool usesAll() const { return !above_ || above_->weights == 0 || weights_ > 0.25 * above_->weights; }

  Color sum_;
  double weights_ = 0;
  std::unique_ptr<Above> above_{};  ///< null as long as these are all
};

/// The state of a pixel: its colour so far, and how much that may be off.
class PixelSum {
 public:
  /// One that is not finite is counted, and that is all.
  void add(const Color& color, double weight);

  int taken() const { return taken_; }  ///< samples
  Color mean() const { return colors_.mean(); }
  const WeightedMean& colors() const { return colors_; }

  /// Before so many samples nothing is known of the error.
  static constexpr int kFewest = 16;
  /// The standard error of the mean's luminance, as if the samples were independent: more than the true one
  /// where they are spread evenly. Relative to the luminance that shows as white or, above it, of the mean.
  double error(double white = 1) const;
  /// The variance of the mean's luminance, likewise.
  double variance() const;
  /// Whether more samples are not needed for such an error; never for 0.
  bool settles(double noise, double white = 1) const {
    return noise > 0 && taken_ >= kFewest && error(white) <= noise;
  }

  /// From so many samples on a pixel is judged by what it has seen itself, and no longer by those around it.
  static constexpr int kSure = 64;
  /// After the first wave that made it known, error() for the pixels around; 0 before.
  float firstErrorFor(double white) const {
    return taken_ >= kFewest ? static_cast<float>(error(white)) : 0.0f;
  }
  /// For a pixel that settles: whether that is no accident. A few samples that agree may all have missed an
  /// edge that a pixel around it has met, of the greatest firstErrorFor().
  bool isSure(double noise, double around) const {
    return taken_ >= kSure || around * std::sqrt(static_cast<double>(kFewest) / taken_) <= noise;
  }

 private:
  friend class FilmState;
  friend class FilmPixels;
  WeightedMean colors_;
  int taken_ = 0;
  /// The sum of the samples' squared luminance, less that of as many samples of the mean's. The difference
  /// itself is kept, since a float holds it as exactly as an error has to be known.
  float spread_ = 0;
};

}  // namespace trace
