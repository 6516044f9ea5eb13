#pragma once
#include <cstddef>
#include <memory>
#include <vector>

namespace espalier::sim {

/// Values one after another that never move while more come to them, as in a std::deque, but on pages large
/// enough to be found by one read that stays in cache. A new one is default-made.
template <typename T>
class Pages {
 public:
  explicit Pages(std::size_t size) {
    while (size_ < size) emplace_back();
  }

  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return pages_[i / kPage][i % kPage]; }
  const T& operator[](std::size_t i) const { return pages_[i / kPage][i % kPage]; }
  T& back() { return (*this)[size_ - 1]; }

  T& emplace_back() {
    if (size_ == pages_.size() * kPage) pages_.push_back(std::make_unique<T[]>(kPage));
    return (*this)[size_++];
  }

 private:
  static constexpr std::size_t kPage = 2048;

  std::vector<std::unique_ptr<T[]>> pages_;
  std::size_t size_ = 0;
};

}  // namespace espalier::sim
