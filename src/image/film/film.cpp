#include "image/film/film.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/budget.h"

namespace trace {

void PixelSum::add(const Color& color, double weight) {
  const double n = taken_++, before = luminanceOf(mean());
  double light = 0;
  if (isFinite(color)) {
    colors_.add(color, weight);
    light = luminanceOf(color);
  }
  if (n == 0) return;  // one sample is not spread
  const double after = luminanceOf(mean());
  spread_ += static_cast<float>((light - after) * (light + after) + n * (before - after) * (before + after));
}

double PixelSum::variance() const {
  const double n = taken_;
  return std::max(0.0, double{spread_}) / std::max(1.0, n - 1) / n;
}

double PixelSum::error(double white) const {
  return std::sqrt(variance()) / std::max(white, luminanceOf(colors_.mean()));
}

std::vector<Wave> wavesOf(int samples, int first) {
  std::vector<Wave> waves;
  while (first < samples) {
    const int end = std::min(samples, first + longestWave(first));
    waves.push_back({first, end});
    first = end;
  }
  return waves;
}

Film::Film(int width, int height, int samples, std::span<const LayerKind> layers, double noise, int tileSize)
    : width_(width),
      height_(height),
      tileSize_(tileSize),
      columns_((width + tileSize - 1) / tileSize),
      rows_((height + tileSize - 1) / tileSize),
      noise_(noise),
      waves_(wavesOf(samples)),
      pixels_(width, height, tileSize),
      states_(std::make_unique<TileState[]>(static_cast<std::size_t>(tiles()))) {
  if (noise > 0) firstErrors_.resize(pixels_.size());
  for (const LayerKind& kind : layers) {
    Layer& layer = layers_.emplace_back(Layer{.kind = kind, .sums = {}});
    if (kind.keep == Keep::counts)
      layer.counts.resize(pixels_.size());
    else
      layer.sums = Picture(width, height);
    if (kind.keep == Keep::weighted) layer.below = Picture(width, height);
  }
}

Tile Film::tile(std::int64_t index) const {
  const int x = static_cast<int>(index % columns_) * tileSize_;
  const int y = static_cast<int>(index / columns_) * tileSize_;
  return {x, y, std::min(x + tileSize_, width_), std::min(y + tileSize_, height_)};
}

void Film::add(std::int64_t tile, std::size_t wave, TileSamples samples) {
  TileState& state = states_[static_cast<std::size_t>(tile)];
  const auto splats = lockSplats();
  const std::lock_guard lock(state.mutex);
  if (corners_) {  // their waves come in turn
    putCorners(tile, wave, std::move(samples));
    ++state.waves;
    return;
  }
  if (wave != state.waves) {
    state.early.emplace(wave, std::move(samples));
    return;
  }
  sum(waves_[state.waves++], samples);
  for (auto next = state.early.begin(); next != state.early.end() && next->first == state.waves;
       next = state.early.erase(next))
    sum(waves_[state.waves++], next->second);
}

void Film::sumSplats(const Wave& wave, const TileSamples& samples) {
  splats_->add(samples.splats, samples.paths);
  if (!firstSplats_) return;
  std::vector<Splat> ofFirst;
  std::copy_if(samples.splats.begin(), samples.splats.end(), std::back_inserter(ofFirst),
               [](const Splat& splat) { return isOfFirstHalf(splat.sample); });
  int count = 0;
  for (int k = wave.first; k < wave.end; ++k) count += isOfFirstHalf(k);
  firstSplats_->add(ofFirst, samples.paths / wave.count() * count);
}

void Film::sum(const Wave& wave, const TileSamples& samples) {
  if (splats_) sumSplats(wave, samples);
  const Tile& area = samples.area;
  const auto count = static_cast<std::size_t>(wave.count());
  std::size_t at = 0;
  for (int y = area.y0; y < area.y1; ++y)
    for (int x = area.x0; x < area.x1; ++x) {
      if (settled(x, y)) continue;
      pixels_.change(x, y, [&](PixelSum& pixel) {
        const bool isFirst = pixel.taken() < PixelSum::kFewest;
        for (std::size_t k = at; k < at + count; ++k)
          pixel.add(samples.colors[k], samples.weights.empty() ? 1 : samples.weights[k]);
        if (isFirst && noise_ > 0) firstErrors_[index(x, y)] = pixel.firstErrorFor(white_);
      });
      if (keepsHalves())
        for (std::size_t k = at; k < at + count; ++k)
          if (isOfFirstHalf(wave.first + static_cast<int>(k - at)) && isFinite(samples.colors[k]))
            first_[index(x, y)].add(samples.colors[k], samples.weights.empty() ? 1 : samples.weights[k]);
      for (std::size_t i = 0; i < layers_.size(); ++i)
        addToLayer(layers_[i], index(x, y), samples, i < samples.layers.size() ? &samples.layers[i] : nullptr,
                   at, at + count, wave.first == 0);
      at += count;
    }
  for (const PixelBeside& one : samples.beside) firstErrors_[index(one.x, one.y)] = one.firstError;
}

void Film::addToLayer(Layer& layer, std::size_t pixel, const TileSamples& samples,
                      const std::vector<Color>* values, std::size_t first, std::size_t end,
                      bool isFirstWave) {
  const auto value = [&](std::size_t k) { return values ? (*values)[k] : layer.kind.blank; };
  const auto addWeighted = [&](std::size_t k) {
    if (!isFinite(samples.colors[k])) return;
    const double weight = samples.weights.empty() ? 1 : samples.weights[k];
    layer.sums.pixels[pixel] += value(k) * weight;
    if (weight < 0) layer.below.pixels[pixel] += value(k) * weight;
  };
  const auto count = [&](std::size_t k) {
    const auto number = static_cast<std::uint32_t>(value(k).r);
    if (number == 0) return;
    std::vector<Count>& counts = layer.counts[pixel];
    const auto known =
        std::find_if(counts.begin(), counts.end(), [&](const Count& c) { return c.number == number; });
    known == counts.end() ? counts.push_back({number, 1}) : void(++known->count);
  };
  switch (layer.kind.keep) {
    case Keep::first:
      if (isFirstWave) layer.sums.pixels[pixel] = value(first);
      return;
    case Keep::mean:
    case Keep::sum:
      for (std::size_t k = first; k < end; ++k) layer.sums.pixels[pixel] += value(k);
      return;
    case Keep::weighted:
      for (std::size_t k = first; k < end; ++k) addWeighted(k);
      return;
    case Keep::counts:
      for (std::size_t k = first; k < end; ++k) count(k);
      return;
  }
}

bool Film::settled(int x, int y) const {
  if (!(noise_ > 0)) return false;
  const PixelSum pixel = pixels_.at(x, y);
  if (!pixel.settles(noise_, white_)) return false;
  float around = 0;
  for (int v = std::max(0, y - 1); v <= std::min(height_ - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(width_ - 1, x + 1); ++u)
      around = std::max(around, firstErrors_[index(u, v)]);
  return pixel.isSure(noise_, around);
}

bool Film::has(std::int64_t tile, std::size_t wave) const {
  const TileState& state = states_[static_cast<std::size_t>(tile)];
  const std::lock_guard lock(state.mutex);
  return wave < state.waves;
}

std::int64_t Film::ownTiles() const {
  std::int64_t own = 0;
  for (std::int64_t i = 0; i < tiles(); ++i) own += owns(i);
  return own;
}

std::int64_t Film::samplesDone() const {
  std::int64_t done = 0;
  for (std::int64_t i = 0; i < tiles(); ++i) {
    if (!owns(i)) continue;
    const TileState& state = states_[static_cast<std::size_t>(i)];
    const std::lock_guard lock(state.mutex);
    if (state.waves > 0) done += waves_[state.waves - 1].end;
  }
  return done;
}

double Film::shareDone() const {
  const int all = waves_.back().end;
  const double samples = static_cast<double>(samplesDone()) / (static_cast<double>(ownTiles()) * all);
  if (noiseTarget() == 0) return samples;
  constexpr double kLookedAt = 1 << 16;  // pixels: enough for a guess
  const double pixels = static_cast<double>(width_) * height_;
  const int step = std::max(1, static_cast<int>(std::sqrt(pixels / kLookedAt)));
  double done = 0, likely = 0, judged = 0, unknown = 0;
  for (std::int64_t i = 0; i < tiles(); ++i) {
    if (!owns(i)) continue;
    const TileState& state = states_[static_cast<std::size_t>(i)];
    const std::lock_guard lock(state.mutex);
    const bool isWhole = state.waves == waves_.size();
    const Tile area = tile(i);
    for (int y = area.y0; y < area.y1; y += step)
      for (int x = area.x0; x < area.x1; x += step) {
        const PixelSum pixel = pixels_.at(x, y);
        const int taken = pixel.taken();
        if (taken == 0 && state.waves > 0) continue;  // it is not rendered
        done += taken;
        if (taken < 2) {
          ++unknown;
          continue;
        }
        ++judged;
        const double times = pixel.error(white_) / noise_, fewest = PixelSum::kFewest;
        likely += isWhole ? taken : std::clamp<double>(std::max(fewest, taken * times * times), taken, all);
      }
  }
  if (judged == 0) return samples;
  return done / (likely * (1 + unknown / judged));
}

bool Film::complete() const {
  for (std::int64_t i = 0; i < tiles(); ++i) {
    if (!owns(i)) continue;
    const TileState& state = states_[static_cast<std::size_t>(i)];
    const std::lock_guard lock(state.mutex);
    if (state.waves < waves_.size()) return false;
  }
  return true;
}

template <class Use>
void Film::forEachDone(const Use& use) const {
  for (std::int64_t i = 0; i < tiles(); ++i) {
    const TileState& state = states_[static_cast<std::size_t>(i)];
    const std::lock_guard lock(state.mutex);
    if (state.waves == 0) continue;
    const Tile area = tile(i);
    for (int y = area.y0; y < area.y1; ++y) {
      checkBudget();
      for (int x = area.x0; x < area.x1; ++x) use(pixels_.at(x, y), x, y);
    }
  }
}

void Film::divide(const Subdivision& rules) {
  corners_ = std::make_unique<CornerSamples>(rules, tileSize_, columns_, static_cast<std::size_t>(tiles()));
  waves_.clear();
  for (int level = 0; level < corners_->levels(); ++level) waves_.push_back({level, level + 1});
}

void Film::putCorners(std::int64_t tile, std::size_t level, TileSamples samples) {
  CornerSamples::Level taken{samples.area, std::move(samples.starts), std::move(samples.corners), {}};
  taken.values.push_back(std::move(samples.colors));
  for (std::size_t i = 0; i < layers_.size(); ++i)
    taken.values.push_back(i < samples.layers.size()
                               ? std::move(samples.layers[i])
                               : std::vector<Color>(taken.corners.size(), layers_[i].kind.blank));
  corners_->put(static_cast<std::size_t>(tile), level, std::move(taken));
}

/// How often the pixels of a tile may be divided now: corners of theirs lie in the tiles on the right and
/// above.
template <class Waves>
std::size_t Film::levelsOf(const Tile& area, const Waves& waves) const {
  std::size_t levels = std::numeric_limits<std::size_t>::max();
  for (const int y : {area.y0, std::max(0, area.y0 - 1)})
    for (const int x : {area.x0, std::min(area.x1, width_ - 1)})
      levels = std::min(levels, waves(corners_->tileOf(x, y)));
  return levels;
}

template <class Use>
void Film::forEachDivided(const Use& use) const {
  std::vector<std::size_t> there(static_cast<std::size_t>(tiles()));
  for (std::size_t i = 0; i < there.size(); ++i) {
    const std::lock_guard lock(states_[i].mutex);
    there[i] = states_[i].waves;
  }
  for (std::size_t i = 0; i < there.size(); ++i) {
    if (there[i] == 0) continue;
    const Tile area = tile(static_cast<std::int64_t>(i));
    const std::size_t levels = levelsOf(area, [&](std::size_t tile) { return there[tile]; });
    for (int y = area.y0; y < area.y1; ++y)
      for (int x = area.x0; x < area.x1; ++x)
        if (checkBudget(), corners_->level(i, 0).has(x, y)) use(x, y, static_cast<int>(levels));
  }
}

Color Film::ofCorners(int x, int y, int levels) const {
  const auto colors = corners_->of(x, y);
  return levels > 0 ? meanOver(corners_->rules(), levels - 1, colors, colors) : colors(Corner{});
}

Color Film::ofSamples(int x, int y) const {
  if (!corners_) return pixels_.at(x, y).mean();
  const auto waves = [&](std::size_t tile) {
    const std::lock_guard lock(states_[tile].mutex);
    return static_cast<std::size_t>(states_[tile].waves);
  };
  const std::size_t own = corners_->tileOf(x, y);
  if (waves(own) == 0 || !corners_->level(own, 0).has(x, y)) return Color(0);
  return ofCorners(x, y, static_cast<int>(levelsOf(tile(static_cast<std::int64_t>(own)), waves)));
}

Color Film::ofSplats(int x, int y) const {
  const auto splats = lockSplats();
  return splats_ ? splats_->mean(x, y) : Color(0);
}

Picture Film::picture() const {
  Picture picture(width_, height_);
  copyDone(picture);
  return picture;
}

void Film::copyDone(Picture& onto) const {
  const auto splats = lockSplats();
  if (corners_) {
    forEachDivided([&](int x, int y, int levels) { onto.at(x, y) = ofCorners(x, y, levels); });
    return;
  }
  const bool anywhere = splats_ && splats_->paths() > 0;
  if (anywhere) std::fill(onto.pixels.begin(), onto.pixels.end(), Color(0));
  forEachDone([&](const PixelSum& pixel, int x, int y) { onto.at(x, y) = pixel.mean(); });
  if (!anywhere) return;
  for (int y = 0; y < height_; ++y) {
    checkBudget();
    for (int x = 0; x < width_; ++x) onto.at(x, y) += splats_->mean(x, y);
  }
}

std::vector<std::vector<Film::Share>> Film::shares(std::size_t number) const {
  std::vector<std::vector<Share>> all(pixels_.size());
  const auto sorted = [](std::vector<Share> shares) {
    std::sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) {
      return a.share != b.share ? a.share > b.share : a.number < b.number;
    });
    return shares;
  };
  if (corners_) {
    forEachDivided([&](int x, int y, int levels) {
      const auto value = corners_->of(x, y, number + 1);
      std::vector<Share>& shares = all[index(x, y)];
      const auto add = [&](Corner corner, double share) {
        const auto one = static_cast<std::uint32_t>(value(corner).r);
        if (one == 0) return;
        const auto known =
            std::find_if(shares.begin(), shares.end(), [&](const Share& s) { return s.number == one; });
        known == shares.end() ? shares.push_back({one, share}) : void(known->share += share);
      };
      if (levels > 0)
        forEachShare(corners_->rules(), levels - 1, corners_->of(x, y), add);
      else
        add(Corner{}, 1);
      shares = sorted(std::move(shares));
    });
    return all;
  }
  forEachDone([&](const PixelSum& pixel, int x, int y) {
    std::vector<Share> shares;
    for (const Count& c : layers_[number].counts[index(x, y)])
      shares.push_back({c.number, static_cast<double>(c.count) / pixel.taken()});
    all[index(x, y)] = sorted(std::move(shares));
  });
  return all;
}

Picture Film::variances() const {
  Picture variances(width_, height_);
  forEachDone([&](const PixelSum& pixel, int x, int y) {
    if (pixel.taken() > 1) variances.at(x, y) = Color(pixel.variance());
  });
  return variances;
}

Picture Film::layer(std::size_t number) const {
  const Layer& layer = layers_[number];
  Picture picture(width_, height_);
  if (layer.kind.keep == Keep::counts) {
    const auto all = shares(number);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!all[i].empty()) picture.pixels[i] = Color(all[i].front().number);
    return picture;
  }
  std::fill(picture.pixels.begin(), picture.pixels.end(), layer.kind.blank);
  if (corners_) {
    forEachDivided([&](int x, int y, int levels) {
      const auto value = corners_->of(x, y, number + 1);
      Color& shown = picture.at(x, y);
      if (layer.kind.keep == Keep::sum) {
        shown = Color(static_cast<double>(corners_->countOf(x, y, static_cast<std::size_t>(levels))));
      } else if (levels > 0 && layer.kind.keep != Keep::first) {
        shown = meanOver(corners_->rules(), levels - 1, corners_->of(x, y), value);
      } else {
        shown = value(Corner{});
      }
    });
    return picture;
  }
  forEachDone([&](const PixelSum& pixel, int x, int y) {
    if (pixel.taken() == 0) return;
    const Color& sum = layer.sums.at(x, y);
    picture.at(x, y) = layer.kind.keep == Keep::mean       ? sum / pixel.taken()
                       : layer.kind.keep == Keep::weighted ? pixel.colors().meanOf(sum, layer.below.at(x, y))
                                                           : sum;
  });
  return picture;
}

Picture Film::sampleCounts() const {
  Picture counts(width_, height_);
  if (corners_)
    forEachDivided([&](int x, int y, int levels) {
      counts.at(x, y) = Color(static_cast<double>(corners_->countOf(x, y, static_cast<std::size_t>(levels))));
    });
  else
    forEachDone([&](const PixelSum& pixel, int x, int y) { counts.at(x, y) = Color(pixel.taken()); });
  return counts;
}

Picture Film::errors() const {
  Picture errors(width_, height_);
  forEachDone([&](const PixelSum& pixel, int x, int y) {
    if (pixel.taken() > 1) errors.at(x, y) = Color(pixel.error(white_));
  });
  return errors;
}

Convergence Film::convergence() const {
  Convergence so;
  double pixels = 0, judged = 0;
  if (corners_) {
    for (const Color& count : sampleCounts().pixels) {
      so.samples += count.r;
      pixels += count.r > 0;
    }
  } else {
    forEachDone([&](const PixelSum& pixel, int, int) {
      if (pixel.taken() == 0) return;
      ++pixels;
      so.samples += pixel.taken();
      if (pixel.taken() < 2) return;
      ++judged;
      so.error += pixel.error(white_);
    });
  }
  so.judged = judged > 0 && !takesSplats();
  if (pixels > 0) so.samples /= pixels;
  if (judged > 0) so.error /= judged;
  return so;
}

Halves Film::halves() const {
  Halves halves{Picture(width_, height_), Picture(width_, height_), std::vector<double>(pixels_.size()),
                std::vector<double>(pixels_.size())};
  const auto splats = lockSplats();
  forEachDone([&](const PixelSum& pixel, int x, int y) {
    const WeightedMean& first = first_[index(x, y)];
    halves.first.at(x, y) = first.mean();
    halves.second.at(x, y) = pixel.colors().without(first).mean();
    const int taken = pixel.taken(), inFirst = taken / 8 * 4 + std::min(taken % 8, 4);
    if (inFirst == taken) return;
    const double share = static_cast<double>(inFirst) / taken;
    halves.variance[index(x, y)] = pixel.variance();
    halves.share[index(x, y)] = share;
    if (!firstSplats_) return;
    // Splats of one path fall on many pixels: what the halves of a pixel have of them tells their variance.
    const Color a = firstSplats_->mean(x, y), b = splats_->meanWithout(*firstSplats_, x, y);
    halves.first.at(x, y) += a;
    halves.second.at(x, y) += b;
    const double apart = luminanceOf(a) - luminanceOf(b);
    halves.variance[index(x, y)] += apart * apart * share * (1 - share);
  });
  return halves;
}

}  // namespace trace
