// A stack that takes no memory from the heap while it is low, and whose items never move.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace trace {

template <class T, std::size_t kFew>
class InlineStack {
 public:
  InlineStack() = default;
  InlineStack(const InlineStack&) = delete;
  InlineStack& operator=(const InlineStack&) = delete;
  ~InlineStack() {
    while (!empty()) pop();
  }

  template <class... Arguments>
  T& push(Arguments&&... arguments) {
    T* item = count_ < kFew ? std::construct_at(few(count_), std::forward<Arguments>(arguments)...)
                            : many_.emplace_back(new T(std::forward<Arguments>(arguments)...)).get();
    ++count_;
    return *item;
  }
  /// Precondition of both: not empty.
  T& top() { return count_ > kFew ? *many_.back() : *few(count_ - 1); }
  void pop() {
    if (count_ > kFew)
      many_.pop_back();
    else
      std::destroy_at(few(count_ - 1));
    --count_;
  }
  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }
  /// Item i from the bottom.
  const T& operator[](std::size_t i) const { return i < kFew ? *few(i) : *many_[i - kFew]; }

 private:
  T* few(std::size_t i) { return std::launder(reinterpret_cast<T*>(data_) + i); }
  const T* few(std::size_t i) const { return std::launder(reinterpret_cast<const T*>(data_) + i); }

  alignas(T) std::byte data_[kFew * sizeof(T)];  // not set before it is used
  std::vector<std::unique_ptr<T>> many_;
  std::size_t count_ = 0;
};

}  // namespace trace
