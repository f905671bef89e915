#include "render/chains/chain.h"

#include <algorithm>
#include <cmath>

#include "render/chains/record.h"

namespace trace::veach {

/// A path where a chain is, and how often it has been there, on the average over what chance could do.
struct Chains::Stop {
  Path path{};
  Real visits = 0;
};

Chains::Chains(std::span<const Moment> moments, const Settings& settings, const Size& size, const Tile& area)
    : settings_(settings), area_(area), rules_(settings, size) {
  for (const Moment& moment : moments) stages_.emplace_back(*moment.world, settings, area, size);
}

Paths Chains::paths(PixelTracer& tracer, std::size_t moment) const {
  return {stages_[moment], tracer.tracer(moment)};
}

std::size_t Chains::momentBy(Numbers& numbers) const {
  if (stages_.size() == 1) return 0;
  const auto moments = static_cast<Real>(stages_.size());
  return std::min(static_cast<std::size_t>(numbers.next() * moments), stages_.size() - 1);
}

/// A path that is made from nothing.
Path Chains::start(PixelTracer& tracer, Numbers& numbers) const {
  const std::size_t moment = momentBy(numbers);
  const Paths paths = this->paths(tracer, moment);
  Path path = Moves(paths, rules_, numbers, settings_.moveSize).anywhere();
  path.moment = moment;
  return path;
}

Real Chains::brightness(PixelTracer& tracer, std::uint64_t seed, std::uint32_t sample) const {
  Numbers even(seed, sample);
  const std::size_t moment = momentBy(even);
  const Paths seen = paths(tracer, moment);
  const Real fromCamera = Moves(seen, rules_, even, settings_.moveSize).fromCamera();
  Numbers numbers(mixBits(mixBits(seed) ^ mixBits(sample)));
  Path path = start(tracer, numbers);
  if (!(path.brightness > 0)) return fromCamera;
  const Paths there = paths(tracer, path.moment);
  return fromCamera + Moves(there, rules_, numbers, settings_.moveSize).anywhereShare(path);
}

Real Chains::light(PixelTracer& tracer, std::uint64_t seed) const {
  Numbers numbers(seed);
  Path path = start(tracer, numbers);
  if (!(path.brightness > 0)) return 0;
  const Paths paths = this->paths(tracer, path.moment);
  const Real density = Moves(paths, rules_, numbers, settings_.moveSize).anywhereDensity(path);
  return density > 0 ? path.brightness / density : 0;
}

/// The mutations that can change the path: the same of both that a perturbation leads from and to.
std::vector<MoveKind> Chains::mutationsOf(const Moves& moves, const Path& path) const {
  std::vector<MoveKind> kinds;
  const auto add = [&](Mutation mutation, MoveKind kind, bool can) {
    if (can && settings_.mutations.has(mutation)) kinds.push_back(kind);
  };
  add(Mutation::bidirectional, MoveKind::bidirectional, true);
  add(Mutation::lens, MoveKind::lens, moves.hasLens(path));
  add(Mutation::caustic, MoveKind::caustic, moves.hasCaustic(path));
  add(Mutation::multiChain, MoveKind::multiChain, moves.hasMultiChain(path));
  return kinds;
}

Offer Chains::offer(PixelTracer& tracer, Path& here, Numbers& numbers, MoveKind& kind) const {
  kind = MoveKind::anywhere;
  const Paths paths = this->paths(tracer, here.moment);
  Moves moves(paths, rules_, numbers, settings_.moveSize);
  const std::vector<MoveKind> kinds = mutationsOf(moves, here);
  if (numbers.next() < anywhereChance(kinds)) {
    Offer offer{start(tracer, numbers)};
    if (!(offer.path.brightness > 0)) return offer;
    const Paths there = this->paths(tracer, offer.path.moment);
    const Real density = Moves(there, rules_, numbers, settings_.moveSize).anywhereDensity(offer.path);
    const Real before = here.brightness / moves.anywhereDensity(here);
    if (density > 0)
      offer.ratio = offer.path.brightness / (density * before) *
                    anywhereChance(mutationsOf(moves, offer.path)) / anywhereChance(kinds);
    return offer;
  }
  const auto count = static_cast<Real>(kinds.size());
  kind = kinds[std::min(static_cast<std::size_t>(numbers.next() * count), kinds.size() - 1)];
  switch (kind) {
    case MoveKind::lens: return moves.lens(here);
    case MoveKind::caustic: return moves.caustic(here);
    case MoveKind::multiChain: return moves.multiChain(here);
    case MoveKind::bidirectional:
    case MoveKind::nearby:
    case MoveKind::anywhere: break;
  }
  Offer offer = moves.bidirectional(here);
  if (offer.path.brightness > 0)
    offer.ratio *= count / static_cast<Real>(mutationsOf(moves, offer.path).size());
  return offer;
}

/// Where nothing else can change the path, it is replaced.
Real Chains::anywhereChance(const std::vector<MoveKind>& kinds) const {
  return kinds.empty() ? 1 : settings_.moveAnywhere;
}

/// The pixel that the path goes through, or the one beside it in the picture.
Splat Chains::pixelOf(const Path& path) const {
  const Size& size = rules_.size();
  const auto pixel = [](Real at, int pixels, int first, int end) {
    return std::clamp(static_cast<int>(std::floor(at * pixels)), first, std::max(first, end - 1));
  };
  return {pixel(path.film.x, size.width, area_.x0, area_.x1),
          size.height - 1 - pixel(path.film.y, size.height, size.height - area_.y1, size.height - area_.y0),
          path.f};
}

void Chains::leave(const Stop& at, Real mean, std::vector<Splat>& splats) const {
  if (!(at.visits > 0)) return;
  const Color value = at.path.f * (mean * at.visits / at.path.brightness);
  rules_.spread(at.path.film, [&](int x, int y, Real share) {
    if (x >= area_.x0 && x < area_.x1 && y >= area_.y0 && y < area_.y1)
      splats.push_back({x, y, value * share});
  });
}

std::vector<Splat> Chains::chain(PixelTracer& tracer, std::uint64_t start, std::uint64_t seed,
                                 std::int64_t moves, Real mean, const ChainWatch& watch) const {
  std::vector<Splat> splats;
  Numbers first(start), numbers(seed);
  Stop here{this->start(tracer, first)};
  const auto tell = [&](ChainMove move, const Path& path) {
    const Path& shown = path.nodes.empty() ? here.path : path;
    const Splat pixel = pixelOf(shown);
    move.x = pixel.x;
    move.y = pixel.y;
    if (path.brightness > 0 || move.number < 0)  // without the camera's part, as its rays bring it
      move.brings = shown.f / shown.nodes.front().factor.r;
    move.light = path.brightness;
    watch(move, [&](PixelTracer& other) {
      record(shown, other.tracer(shown.moment));
      return pixel;
    });
  };
  if (watch) tell({.number = -1, .kind = MoveKind::anywhere}, here.path);
  for (std::int64_t n = 0; n < moves; ++n) {
    MoveKind kind;
    Offer offer = this->offer(tracer, here.path, numbers, kind);
    const Real accepts = offer.path.brightness > 0 ? std::min(1.0, offer.ratio) : 0;
    const bool goes = numbers.next() < accepts;
    if (watch)
      tell({.number = n, .kind = kind, .before = here.path.brightness, .chance = accepts, .made = goes},
           offer.path);
    Stop there{std::move(offer.path), accepts};
    here.visits += 1 - accepts;
    if (goes) std::swap(here, there);
    leave(there, mean, splats);
    tracer.tracer(here.path.moment).statistics().count(kind, goes);
  }
  leave(here, mean, splats);
  return splats;
}

}  // namespace trace::veach
