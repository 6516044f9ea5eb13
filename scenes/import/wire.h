#pragma once
// Internal to the wing.
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// Values as bytes, for the pipe between a reading child and its parent: counts, then arrays, in this
/// machine's own byte order. Not a file format.
namespace espalier::scenes {

class Packer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void putArray(const T* data, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(static_cast<std::uint64_t>(count));
    bytes_.append(reinterpret_cast<const char*>(data), count * sizeof(T));
  }
  void putText(const std::string& text) { putArray(text.data(), text.size()); }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// The bytes are not trusted (a damaged file may have overwritten the child's memory): every count is held
/// against the bytes that are there. Throws std::runtime_error.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  T get() {
    T value{};
    const std::string_view raw = take(sizeof value);
    std::memcpy(&value, raw.data(), sizeof value);
    return value;
  }
  template <class T>
  std::vector<T> getArray() {
    const auto count = getCount(sizeof(T));
    const std::string_view raw = take(count * sizeof(T));
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), raw.data(), raw.size());
    return values;
  }
  std::string getText() { return std::string(take(getCount(1))); }
  /// A count of things that take at least `each` bytes.
  std::size_t getCount(std::size_t each) {
    const auto count = get<std::uint64_t>();
    if (count > bytes_.size() / each) throw std::runtime_error("a count is larger than what follows it");
    return static_cast<std::size_t>(count);
  }
  void requireEnd() const {
    if (!bytes_.empty()) throw std::runtime_error("there are bytes after the end");
  }

 private:
  std::string_view take(std::size_t count) {
    if (count > bytes_.size()) throw std::runtime_error("the bytes end early");
    const auto taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }

  std::string_view bytes_;
};

}  // namespace espalier::scenes
