#include "app/session/denoising.h"

#include <algorithm>
#include <cmath>

#include "base/budget.h"
#include "image/development/denoise.h"
#include "render/picture/passes.h"

namespace trace {

std::optional<Picture> denoised(const Film& film, const Settings& settings) {
  const Work work("taking noise out");
  Job job;
  return denoised(film, settings, job);
}

std::optional<Picture> denoised(const Film& film, const Settings& settings, Job& job) {
  if (!settings.denoise || !film.keepsHalves()) return {};
  const Halves halves = film.halves();
  bool any = false;
  for (const double share : halves.share) any = any || share > 0;
  if (!any) return {};
  const auto layer = [&](std::string_view name) {
    return film.layer(static_cast<std::size_t>(layerOf(settings, name)));
  };
  Picture result = withoutNoise(
      halves, {layer("guide albedo"), layer("guide normal"), layer("guide nearness")}, settings.threads, job);
  if (job.cancel) return {};
  const Picture plain = film.picture();
  for (std::size_t i = 0; i < result.pixels.size(); ++i)
    if (halves.share[i] == 0) result.pixels[i] = plain.pixels[i];
  return result;
}

Picture pictureOfFilm(const Film& film, const Settings& settings) {
  std::optional<Picture> without = denoised(film, settings);
  return without ? std::move(*without) : film.picture();
}

Picture change(const Picture& before, const Picture& after) {
  Picture picture(after.width, after.height);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    checkBudget();
    picture.pixels[i] = after.pixels[i] + before.pixels[i] * -1;
  }
  return picture;
}

double meanChange(const Picture& change) {
  double sum = 0;
  for (const Color& c : change.pixels) {
    checkBudget();
    sum += std::abs(luminanceOf(c));
  }
  return change.pixels.empty() ? 0 : 255 * sum / static_cast<double>(change.pixels.size());
}

double shownChange(const Picture& before, const Picture& after, const Development& development) {
  const auto level = [&](const Color& linear) {
    const Color shown = developed(linear, development);
    return luminanceOf(
        {std::clamp(shown.r, 0.0, 1.0), std::clamp(shown.g, 0.0, 1.0), std::clamp(shown.b, 0.0, 1.0)});
  };
  double sum = 0;
  for (std::size_t i = 0; i < before.pixels.size(); ++i) {
    checkBudget();
    sum += std::abs(level(after.pixels[i]) - level(before.pixels[i]));
  }
  return before.pixels.empty() ? 0 : 255 * sum / static_cast<double>(before.pixels.size());
}

}  // namespace trace
