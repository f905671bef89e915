// Numbers equal keys alike, in the order of their first appearance: how corners of faces become points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace trace {

/// Key: trivially copyable without padding, a multiple of four bytes, equal if its bytes are.
template <class Key>
class Unique {
 public:
  /// The number of the key: that of an equal one before, or the next.
  std::uint32_t number(const Key& key) {
    if (2 * (keys_.size() + 1) > slots_.size()) grow();
    for (std::size_t at = hash(key) & (slots_.size() - 1);; at = (at + 1) & (slots_.size() - 1)) {
      std::uint32_t& slot = slots_[at];
      if (slot == kFree) {
        slot = static_cast<std::uint32_t>(keys_.size());
        keys_.push_back(key);
        return slot;
      }
      if (std::memcmp(&keys_[slot], &key, sizeof key) == 0) return slot;
    }
  }

  const std::vector<Key>& keys() const { return keys_; }

 private:
  static constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

  static std::size_t hash(const Key& key) {
    std::uint32_t words[sizeof(Key) / 4];
    std::memcpy(words, &key, sizeof key);
    std::uint64_t h = 0x9e3779b97f4a7c15u;
    for (std::uint32_t word : words) {
      h = (h ^ word) * 0xff51afd7ed558ccdu;
      h ^= h >> 32;
    }
    return static_cast<std::size_t>(h ^ (h >> 29));
  }

  void grow() {
    slots_.assign(slots_.empty() ? 64 : 2 * slots_.size(), kFree);
    for (std::uint32_t i = 0; i < keys_.size(); ++i) {
      std::size_t at = hash(keys_[i]) & (slots_.size() - 1);
      while (slots_[at] != kFree) at = (at + 1) & (slots_.size() - 1);
      slots_[at] = i;
    }
  }

  std::vector<Key> keys_;
  std::vector<std::uint32_t> slots_;  ///< a power of two of them, at most half full
};

}  // namespace trace
