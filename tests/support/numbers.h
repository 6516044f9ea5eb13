#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

/// Chance for tests, the same on every machine.
namespace espalier::tests {

/// A small generator (SplitMix64).
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::size_t below(std::size_t end) { return static_cast<std::size_t>(next() % end); }
  int whole(int low, int high) {
    return low + static_cast<int>(below(static_cast<std::size_t>(high - low + 1)));
  }
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53;
  }
  bool chance(double share) { return uniform(0.0, 1.0) < share; }
  template <class List>
  const auto& pick(const List& list) {
    return *(std::begin(list) + static_cast<std::ptrdiff_t>(below(std::size(list))));
  }

 private:
  std::uint64_t state_;
};

/// Bytes with one to four random edits: other bytes, some of YAML's own signs, holes, repetitions, cut ends.
inline std::string mutated(std::string bytes, Numbers& numbers) {
  constexpr std::string_view kNasty = "{}[]:,-#&*!|>'\"%@`\n\t ?~0.eE<\\\xff";
  const std::size_t edits = 1 + numbers.below(4);
  for (std::size_t i = 0; i < edits && !bytes.empty(); ++i) {
    const auto at = numbers.below(bytes.size());
    switch (numbers.below(6)) {
      case 0:
        bytes[at] = static_cast<char>(numbers.below(256));
        break;
      case 1:
        bytes[at] = kNasty[numbers.below(kNasty.size())];
        break;
      case 2:
        bytes.insert(at, 1, kNasty[numbers.below(kNasty.size())]);
        break;
      case 3:
        bytes.erase(at, 1 + numbers.below(8));
        break;
      case 4:
        bytes.insert(at, bytes.substr(numbers.below(bytes.size()), numbers.below(40)));
        break;
      case 5:
        if (numbers.chance(0.1)) bytes.resize(at);
        break;
    }
  }
  return bytes;
}

}  // namespace espalier::tests
