// The levels of a MipMap and how they are made.
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "base/budget.h"
#include "base/match.h"
#include "image/maps/mipmap.h"
#include "image/srgb.h"

namespace trace {
namespace {

/// Which samples of a row of n the next smaller row of m = max(1, n / 2) takes, with weights that sum to n.
struct Share {
  int first = 0, count = 1;
  double weight[3] = {1, 0, 0};

  Share(int i, int n) {
    const int m = std::max(1, n / 2);
    if (n == 1) return;
    first = 2 * i;
    if (n % 2 == 0) {
      count = 2;
      weight[0] = weight[1] = m;
    } else {  // 1 / m of a texel is n / m wide: parts of the first and the last, all of the middle one
      count = 3;
      weight[0] = m - i;
      weight[1] = m;
      weight[2] = i + 1;
    }
  }
};

std::size_t index(int row, int width, int channels) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
}

/// The means; value(sample, channel) is what counts, keep(mean) what is stored.
template <class Out, class In, class Value, class Keep>
std::vector<Out> means(const MipMap::Level& from, const std::vector<In>& samples, const Value& value,
                       const Keep& keep) {
  const int width = std::max(1, from.width / 2), height = std::max(1, from.height / 2), c = from.channels;
  std::vector<Out> result(index(height, width, c));
  std::vector<double> sums(index(1, width, c));
  std::vector<Share> columns;
  for (int x = 0; x < width; ++x) columns.emplace_back(x, from.width);
  for (int y = 0; y < height; ++y) {
    checkBudget();
    const Share rows(y, from.height);
    std::fill(sums.begin(), sums.end(), 0.0);
    for (int j = 0; j < rows.count; ++j) {
      const In* row = samples.data() + index(rows.first + j, from.width, c);
      double* sum = sums.data();
      for (const Share& share : columns) {
        const In* first = row + index(share.first, 1, c);
        for (int k = 0; k < c; ++k, ++sum) {
          double across = 0;
          for (int i = 0; i < share.count; ++i) across += share.weight[i] * value(first[i * c + k], k);
          // Weighed by whole numbers and divided by their sum, so that the mean of equal ones is the same.
          *sum += rows.weight[j] * (across / from.width);
        }
      }
    }
    Out* out = result.data() + index(y, width, c);
    for (double sum : sums) *out++ = keep(sum / from.height);
  }
  return result;
}

}  // namespace

MipMap::Level MipMap::halved(const Level& level, const std::vector<double>& linear) {
  Level next{std::max(1, level.width / 2),
             std::max(1, level.height / 2),
             level.channels,
             level.hasAlpha,
             level.colorMost,
             level.alphaMost,
             {}};
  const auto asFloat = [](double mean) { return static_cast<float>(mean); };
  match(level.samples, [&]<class In>(const std::vector<In>& samples) {
    if constexpr (std::is_floating_point_v<In>) {
      const auto plain = [](In sample, int) { return double(sample); };
      next.samples = means<float>(level, samples, plain, asFloat);
    } else if (!linear.empty()) {
      const int alpha = level.hasAlpha ? level.channels - 1 : level.channels;
      next.colorMost = 1;
      next.samples = means<float>(
          level, samples, [&](In sample, int k) { return k == alpha ? double(sample) : linear[sample]; },
          asFloat);
    } else {  // 16 bits, so that rounding at every level does not show
      const double finest = std::numeric_limits<std::uint16_t>::max();
      const double finer = std::max(1.0, std::floor(finest / level.colorMost));
      next.colorMost *= finer;
      next.alphaMost *= finer;
      next.samples = means<std::uint16_t>(
          level, samples, [=](In sample, int) { return sample * finer; },
          [=](double mean) { return static_cast<std::uint16_t>(std::min(mean + 0.5, finest)); });
    }
  });
  return next;
}

MipMap::MipMap(Raster raster)
    : base_{raster.width, raster.height, raster.channels,          raster.hasAlpha(),
            raster.most,  raster.most,   std::move(raster.samples)} {
  // A float that is no number becomes 0, and colours multiplied by alpha are divided by it again.
  auto* values = std::get_if<std::vector<float>>(&base_.samples);
  if (!values) return;
  for (float& value : *values)
    if (!std::isfinite(value)) value = 0;
  if (!raster.premultiplied || !hasAlpha()) return;
  const auto stride = static_cast<std::size_t>(base_.channels);
  for (std::size_t i = 0; i < values->size(); i += stride) {
    const float alpha = (*values)[i + stride - 1];
    for (std::size_t k = 0; alpha > 0 && k + 1 < stride; ++k)
      (*values)[i + k] = std::min((*values)[i + k] / alpha, std::numeric_limits<float>::max());
  }
}

namespace {

Raster rasterOf(const Picture& picture) {
  Raster raster(picture.width, picture.height, 3, 1);
  std::vector<float> samples;
  samples.reserve(raster.count());
  for (const Color& c : picture.pixels)
    for (double channel : {c.r, c.g, c.b}) samples.push_back(static_cast<float>(channel));
  raster.samples = std::move(samples);
  return raster;
}

}  // namespace

MipMap::MipMap(const Picture& picture) : MipMap(rasterOf(picture)) {}

std::shared_ptr<const MipMap> MipMap::decode(std::string_view bytes, const std::string& name,
                                             const PictureLimits& limits) {
  return std::make_shared<const MipMap>(decodeRaster(bytes, name, limits));
}

std::vector<double> MipMap::makeLinear() const {
  std::vector<double> table;
  match(base_.samples,
        Overloaded{[](const std::vector<float>&) {},
                   [&]<class T>(const std::vector<T>&) {
                     const std::size_t count = std::size_t{std::numeric_limits<T>::max()} + 1;
                     for (std::size_t i = 0; i < count; ++i)
                       table.push_back(static_cast<float>(linearOfSrgb(double(i) / base_.colorMost)));
                   }});
  return table;
}

MipMap::Levels MipMap::makePyramid(bool srgb) const {
  const std::vector<double> asTheyAre;
  std::vector<Level> levels;
  const Level* last = &base_;
  Level first;
  if (srgb && std::holds_alternative<std::vector<float>>(base_.samples)) {
    first = base_;
    auto& values = std::get<std::vector<float>>(first.samples);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!hasAlpha() ||
          i % static_cast<std::size_t>(base_.channels) + 1 != static_cast<std::size_t>(base_.channels))
        values[i] = static_cast<float>(linearOfSrgb(values[i]));
    last = &first;
  }
  while (last->width > 1 || last->height > 1) {
    levels.push_back(halved(*last, srgb && last == &base_ ? linear() : asTheyAre));
    last = &levels.back();
  }
  return levels;
}

int MipMap::levels() const {
  int count = 1;
  for (int size = std::max(width(), height()); size > 1; size /= 2) ++count;
  return count;
}

std::size_t MipMap::bytes() const {
  const auto bytesOf = [](const Level& level) {
    return match(level.samples, [](const auto& samples) { return samples.size() * sizeof(samples[0]); });
  };
  std::size_t sum = bytesOf(base_) + linear_.value.size() * sizeof(double);
  for (const Lazy<Levels>& pyramid : pyramids_)
    for (const Level& level : pyramid.value) sum += bytesOf(level);
  return sum;
}

}  // namespace trace
