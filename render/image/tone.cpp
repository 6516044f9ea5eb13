#include "render/image/tone.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace espalier::render {
namespace {

/// The part of the curve that is a power, cut into straight pieces: 512 for each doubling of the value, which
/// is as exact as a float. A picture asks three times a pixel, and powers are dear.
class Curve {
 public:
  static constexpr float kFrom = 0x1p-9f;  ///< below is the curve's straight beginning alone

  Curve() {
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      const float v = std::bit_cast<float>(kFirst + (static_cast<std::uint32_t>(i) << kBelow));
      ends_[i] = 1.055f * powf(v, 1.0f / 2.4f) - 0.055f;
    }
  }
  /// kFrom..1
  float operator()(float v) const {
    const std::uint32_t from_first = std::bit_cast<std::uint32_t>(v) - kFirst;
    const std::size_t piece = from_first >> kBelow;
    const float share = static_cast<float>(from_first & ((1u << kBelow) - 1)) / (1u << kBelow);
    return ends_[piece] + share * (ends_[piece + 1] - ends_[piece]);
  }

 private:
  static constexpr int kBelow = 14;  // bits of a float's fraction that lie within a piece
  static constexpr std::uint32_t kFirst = std::bit_cast<std::uint32_t>(kFrom);
  static constexpr std::size_t kPieces = (std::bit_cast<std::uint32_t>(1.0f) - kFirst) >> kBelow;

  std::array<float, kPieces + 2> ends_;  // one more than the last piece's, which 1 itself asks for
};

}  // namespace

float srgbFromLinear(float value) {
  static const Curve curve;
  const float v = std::clamp(value, 0.0f, 1.0f);
  return v > 0.0031308f ? curve(v) : 12.92f * v;  // what is no number stays none
}

}  // namespace espalier::render
