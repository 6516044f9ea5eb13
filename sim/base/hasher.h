#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sim/base/vec.h"

namespace espalier::sim {

/// XXH3 (64 bits) of bytes, as it is known everywhere.
std::uint64_t hashOf(std::string_view bytes);

/// A hash (XXH3) of values fed one by one, each array with its length; padding bytes never reach it.
class Hasher {
 public:
  Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;
  ~Hasher();

  template <typename T>
  void add(const std::vector<T>& values) {
    add(values.size());
    update(values.data(), values.size() * sizeof(T));
  }
  void add(std::string_view text) {
    add(text.size());
    update(text.data(), text.size());
  }
  template <typename T>
  requires std::is_arithmetic_v<T> || std::is_same_v<T, Vec3>
  void add(const T& value) { update(&value, sizeof value); }

  std::uint64_t digest() const;

 private:
  void update(const void* bytes, std::size_t count);
  void* state_;  // XXH3_state_t
};

}  // namespace espalier::sim
