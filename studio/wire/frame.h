#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// How frames of the stream to the page are put together (README.md, "Frames").
namespace espalier::studio {

enum class FrameKind : std::uint8_t { nothing = 0, event = 1, nodes = 2, elements = 3 };

/// Its eight bytes, and what follows.
std::string frameOf(FrameKind kind, std::string_view payload);

static_assert(std::endian::native == std::endian::little, "numbers in frames are little endian");

/// Appends numbers as they lie in memory.
template <class T>
void put(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof(T));
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}
template <class T>
void put(std::string& bytes, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (values.empty()) return;
  const std::size_t at = bytes.size();
  bytes.resize(at + values.size() * sizeof(T));
  std::memcpy(bytes.data() + at, values.data(), values.size() * sizeof(T));
}

}  // namespace espalier::studio
