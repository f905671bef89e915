// Numbers for what asks a Sampler and is no sample of a pixel: photons, places of a cache.
#pragma once

#include "render/samples/sampler.h"

namespace trace {

class HashedNumbers : public SampleNumbers {
 public:
  explicit HashedNumbers(std::uint64_t seed = 0) : seed_(seed) {}
  /// Others from now on.
  void next() { seed_ = mixBits(seed_); }
  Vec2 pair(std::uint64_t branch) override {
    const std::uint64_t bits = mixBits(seed_ ^ branch);
    return {unitFromBits(bits), unitFromBits(mixBits(bits))};
  }

 private:
  std::uint64_t seed_;
};

}  // namespace trace
