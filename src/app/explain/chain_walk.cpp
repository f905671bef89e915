#include "app/explain/chain_walk.h"

#include <algorithm>
#include <cstdio>

#include "app/explain/ray_view.h"
#include "math/elementary.h"
#include "render/samples/pixel.h"
#include "scene/integrators.h"

namespace trace {
namespace {

constexpr std::int64_t kMostFollowed = 60000;  // that are followed to find one at a pixel

}  // namespace

int ChainWalk::before(int index) const {
  for (int i = index - 1; i >= 0; --i)
    if (moves[static_cast<std::size_t>(i)].made) return i;
  return -1;
}

std::string ChainWalk::missed() const {
  const ChainMove& came = moves[static_cast<std::size_t>(nearest)];
  if (came.x == x && came.y == y) return "";
  const auto pixel = [](int px, int py) { return std::to_string(px) + ", " + std::to_string(py); };
  return "No chain followed here came to " + pixel(x, y) + "; this one came to " + pixel(came.x, came.y) +
         ". ";
}

std::string ChainWalk::summary() const {
  std::vector<std::string> parts;
  for (std::size_t kind = 0; kind < kMoveKinds; ++kind) {
    int offered = 0, made = 0;
    for (const ChainMove& m : moves)
      if (m.number >= 0 && m.kind == static_cast<MoveKind>(kind)) ++offered, made += m.made;
    if (offered == 0) continue;
    parts.push_back(std::to_string(made) + " of " + std::to_string(offered) +
                    (parts.empty() ? " moves " : " ") + std::string(kMoveLooks[kind].of));
  }
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? "" : i + 1 < parts.size() ? ", " : " and ") + parts[i];
  return text + " were made";
}

std::string sentence(const ChainMove& move) {
  char text[240];
  if (move.number < 0)
    std::snprintf(text, sizeof text, "starts at pixel %d, %d, contributes %s there, light %.4g", move.x,
                  move.y, channels(move.brings).c_str(), move.light);
  else
    std::snprintf(text, sizeof text,
                  "%s, to pixel %d, %d, contributes %s there: light %.4g after %.4g, acceptance %.3g: %s",
                  look(move.kind).name.data(), move.x, move.y, channels(move.brings).c_str(), move.light,
                  move.before, move.chance, move.made ? "made" : "not made");
  return text;
}

ChainWalker::ChainWalker(std::shared_ptr<const Session> session, const Cancelled& cancelled)
    : session_(std::move(session)),
      chains_(session_->moments(), session_->settings(), session_->size(), job_, [this, &cancelled] {
        if (cancelled && cancelled()) job_.cancel = true;
      }) {}

std::int64_t ChainWalker::movesOf(std::int64_t tile) const {
  const Tile part = session_->film().tile(tile), &area = chains_.area();
  const int width = std::min(part.x1, area.x1) - std::max(part.x0, area.x0),
            height = std::min(part.y1, area.y1) - std::max(part.y0, area.y0);
  const Wave wave = wavesOf(samplesOf(session_->settings())).front();
  return std::int64_t{std::max(0, width)} * std::max(0, height) * wave.count();
}

ChainWalk ChainWalker::near(int x, int y, const Cancelled& cancelled) const {
  ChainWalk best;
  double least = kInfinity;
  std::int64_t followed = 0;
  PixelTracer tracer = chains_.tracer();
  for (std::int64_t tile = 0; tile < session_->film().tiles() && least > 0 && followed < kMostFollowed;
       ++tile) {
    if (cancelled && cancelled()) break;
    const std::int64_t moves = movesOf(tile);
    if (moves == 0) continue;
    ChainWalk walk{x, y, tile};
    double distance = kInfinity;
    chains_.chain(tracer, Metropolis::numberOf(tile, 0), moves,
                  [&](const ChainMove& move, const OfferedSample&) {
                    const double from = math::hypot(move.x - x, move.y - y);
                    if (move.made && move.light > 0 && from < distance) {
                      distance = from;
                      walk.nearest = static_cast<int>(walk.moves.size());
                    }
                    walk.moves.push_back(move);
                  });
    followed += moves;
    if (distance < least) {
      least = distance;
      best = std::move(walk);
    }
  }
  return best;
}

TracedPixel ChainWalker::offered(const ChainWalk& walk, int index) const {
  const ChainMove& wanted = walk.moves[static_cast<std::size_t>(index)];
  Explanation explanation;
  RayTree& tree = explanation.tree;
  PixelTracer plain = chains_.tracer();
  PixelTracer recording(session_->moments(), chains_.settings(), session_->size(), &tree);
  chains_.chain(plain, Metropolis::numberOf(walk.tile, 0), wanted.number + 1,
                [&](const ChainMove& move, const OfferedSample& show) {
                  if (move.number != wanted.number) return;
                  const Splat seen = show(recording);
                  explanation.samples = {tree.nodes.front().radiance};
                  explanation.weights = {1};
                  explanation.pixel = explanation.samples.front();
                  tree.x = seen.x;
                  tree.y = seen.y;
                });
  weigh(tree, 1);
  return arrangedPixel(session_, std::move(explanation));
}

void ChainInspector::want(const std::shared_ptr<const Session>& session, int x, int y, int index) {
  const bool chains = session && hasTrait(session->settings(), Trait::byChains);
  const auto wanted = chains ? session : nullptr;
  if (wanted == session_ && x == x_ && y == y_ && index == index_) return;
  session_ = wanted;
  x_ = x;
  y_ = y;
  index_ = index;
  if (!wanted) {
    shown_ = {};
    if (!task_.pending()) return;
  }
  task_.start([session = session_, x, y, index, old = shown_](const Cancelled& cancelled) {
    Shown now{session, x, y, index, nullptr, nullptr, nullptr, nullptr};
    if (!session) return now;
    try {
      now.walker = old.session == session && old.walker
                       ? old.walker
                       : std::make_shared<const ChainWalker>(session, cancelled);
      const bool same = old.session == session && old.x == x && old.y == y && old.walk;
      now.walk = same ? old.walk : std::make_shared<const ChainWalk>(now.walker->near(x, y, cancelled));
      if (cancelled() || now.walk->moves.empty()) return now;
      const int last = static_cast<int>(now.walk->moves.size()) - 1;
      now.index = index < 0 ? now.walk->nearest : std::min(index, last);
      now.offered = std::make_shared<const TracedPixel>(now.walker->offered(*now.walk, now.index));
      if (const int before = now.walk->before(now.index); before >= 0)
        now.before = std::make_shared<const TracedPixel>(now.walker->offered(*now.walk, before));
    } catch (const std::exception&) {  // the render says what is wrong
      now.walk.reset();
    }
    return now;
  });
}

bool ChainInspector::update() {
  std::optional<Shown> answer = task_.take();
  if (!answer || answer->session != session_) return false;
  shown_ = std::move(*answer);
  return true;
}

}  // namespace trace
