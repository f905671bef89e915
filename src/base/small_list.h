// A list that takes no memory from the heap while it is short.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace trace {

template <class T, std::size_t kFew>
class SmallList {
 public:
  void add(const T& item) {
    if (count_ == kFew) many_.assign(few_.begin(), few_.end());
    if (count_ >= kFew)
      many_.push_back(item);
    else
      few_[count_] = item;
    ++count_;
  }
  /// Takes the last away. Precondition: not empty.
  T take() {
    const T last = all()[--count_];
    if (count_ >= kFew) many_.pop_back();
    return last;
  }
  /// Keeps the first. Precondition: there are as many.
  void shrink(std::size_t count) {
    if (count_ > kFew && count <= kFew) std::copy_n(many_.begin(), count, few_.begin());
    count_ = count;
    many_.resize(count > kFew ? count : 0);
  }
  std::size_t size() const { return count_; }
  std::span<T> all() { return {count_ > kFew ? many_.data() : few_.data(), count_}; }

 private:
  std::array<T, kFew> few_;  // not set before it is used
  std::vector<T> many_;
  std::size_t count_ = 0;
};

}  // namespace trace
