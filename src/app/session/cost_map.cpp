#include "app/session/cost_map.h"

#include <algorithm>
#include <utility>

#include "app/session/background_render.h"
#include "render/samples/pixel.h"

namespace trace {
namespace {

constexpr int kFirstBlock = 8, kFiner = 4;  // pixels of a block's side, and what divides it

/// All tests so far.
double testsOf(const PixelTracer& tracer) {
  const Statistics counts = tracer.statistics();
  double sum = static_cast<double>(counts.nodes.count);
  for (const std::uint64_t tests : counts.tests) sum += static_cast<double>(tests);
  return sum;
}

/// One row of blocks.
void measureRow(const Session& session, int row, Picture& blocks) {
  const Size size = session.size();
  PixelTracer tracer(session.moments(), session.settings(), size);
  const int samples = std::min(kMostCostSamples, tracer.samples());
  const auto middle = [](int block, int count, int pixels) {
    return static_cast<int>((2 * std::int64_t{block} + 1) * pixels / (2 * count));
  };
  double before = 0;
  for (int x = 0; x < blocks.width; ++x) {
    for (int k = 0; k < samples; ++k)
      tracer.sample(middle(x, blocks.width, size.width), middle(row, blocks.height, size.height), k);
    const double now = testsOf(tracer);
    blocks.at(x, row) = Color((std::exchange(before, now) - now) / -samples);
  }
}

}  // namespace

CostMap costMap(std::shared_ptr<const Session> session, int block, const Cancelled& cancelled) {
  const Size size = session->size();
  Picture blocks(std::max(1, size.width / block), std::max(1, size.height / block));
  CostMap map{session, block, {}};
  Job job;
  job.patience = {};
  try {
    parallelChunks(blocks.height, session->settings().threads, job, [&](std::int64_t row, int) {
      if (cancelled && cancelled()) job.cancel = true;
      if (!job.cancel) measureRow(*session, static_cast<int>(row), blocks);
    });
  } catch (const std::exception&) {  // too little memory or time: there is none
    return map;
  }
  if (!job.cancel) map.tests = enlarged(blocks, size);
  return map;
}

void CostMaker::measure(int block) {
  task_.start([session = wanted_, block](const Cancelled& cancelled) {
    return session ? costMap(session, block, cancelled) : CostMap{};
  });
}

void CostMaker::want(const std::shared_ptr<const Session>& session) {
  if (session == wanted_) return;
  wanted_ = session;
  map_ = {};
  measure(kFirstBlock);
}

bool CostMaker::update() {
  std::optional<CostMap> made = task_.take();
  if (!made || made->session != wanted_ || made->tests.width == 0) return false;
  map_ = std::move(*made);
  if (map_.block > 1) measure(std::max(1, map_.block / kFiner));
  return true;
}

}  // namespace trace
