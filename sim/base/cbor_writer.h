#pragma once
#include <cstdint>
#include <ostream>
#include <string_view>
#include <vector>

namespace espalier::sim {

/// Writes CBOR (RFC 8949) as it goes, so that nothing needs to be in memory twice: every head says how many
/// items or bytes follow, and they must. Heads are as short as they can be.
class CborWriter {
 public:
  explicit CborWriter(std::ostream& out) : out_(out) {}

  void number(std::uint64_t value) { head(0, value); }
  void text(std::string_view value) {
    head(3, value.size());
    raw(value.data(), value.size());
  }
  void boolean(bool value) { out_.put(static_cast<char>(value ? 0xf5 : 0xf4)); }
  void array(std::size_t items) { head(4, items); }
  /// Each item is a key, a text, and a value. Keys go in ascending order.
  void map(std::size_t items) { head(5, items); }

  /// A string of bytes, which follow by raw().
  void bytes(std::size_t count) { head(2, count); }
  void raw(const void* data, std::size_t count) {
    out_.write(static_cast<const char*>(data), static_cast<std::streamsize>(count));
  }
  /// Plain numbers as their bytes in memory.
  template <typename T>
  void packed(const std::vector<T>& values) {
    bytes(values.size() * sizeof(T));
    raw(values.data(), values.size() * sizeof(T));
  }

 private:
  void head(unsigned kind, std::uint64_t value) {
    unsigned extra = 0, code = static_cast<unsigned>(value);
    if (value > 0xffffffffu)
      extra = 8, code = 27;
    else if (value > 0xffffu)
      extra = 4, code = 26;
    else if (value > 0xffu)
      extra = 2, code = 25;
    else if (value > 23u)
      extra = 1, code = 24;
    out_.put(static_cast<char>(kind << 5 | code));
    while (extra-- > 0) out_.put(static_cast<char>(value >> (8 * extra) & 0xffu));
  }

  std::ostream& out_;
};

}  // namespace espalier::sim
