#include "sim/light/givers.h"

#include <algorithm>
#include <cmath>
#include <numeric>

// Vectors whose length is known when compiling.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/light/givers.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace espalier::sim::giving::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Numbers = hn::ScalableTag<std::uint32_t>;
using Reals = hn::ScalableTag<float>;

std::uint32_t SumOfSet(const std::uint64_t* bits, const std::uint32_t* amounts, std::size_t words) {
  const Numbers d;
  constexpr std::size_t kLanes = HWY_LANES(std::uint32_t);
  static_assert(64 % (2 * kLanes) == 0);
  auto even = hn::Zero(d), odd = hn::Zero(d);  // two sums, so that no addition waits for the one before
  const auto chosen = [&](std::uint64_t word, std::size_t at, const std::uint32_t* of_word) {
    const std::uint64_t here = word >> at;
    return hn::IfThenElseZero(hn::LoadMaskBits(d, reinterpret_cast<const std::uint8_t*>(&here)),
                              hn::LoadU(d, of_word + at));
  };
  for (std::size_t w = 0; w < words; ++w, amounts += 64) {
    for (std::size_t at = 0; at < 64; at += 2 * kLanes) {
      even = hn::Add(even, chosen(bits[w], at, amounts));
      odd = hn::Add(odd, chosen(bits[w], at + kLanes, amounts));
    }
  }
  return hn::GetLane(hn::SumOfLanes(d, hn::Add(even, odd)));
}

/// For directions along the receiver's plane `along` of what they would give before it; `all`: none is
/// behind.
void Give(const float* const (&ways)[3], const float* const (&parts)[4], std::size_t count,
          const float (&normal)[3], float along, bool all, std::uint32_t* amounts) {
  const Reals d;
  const auto nx = hn::Set(d, normal[0]), ny = hn::Set(d, normal[1]), nz = hn::Set(d, normal[2]);
  const auto dot = [&](const float* x, const float* y, const float* z, std::size_t i) {
    return hn::Add(hn::Add(hn::Mul(hn::LoadU(d, x + i), nx), hn::Mul(hn::LoadU(d, y + i), ny)),
                   hn::Mul(hn::LoadU(d, z + i), nz));
  };
  const auto in_plane = hn::Set(d, 1e-6f), share = hn::Set(d, along), zero = hn::Zero(d);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto given =
        hn::Max(hn::Add(hn::LoadU(d, parts[0] + i), dot(parts[1], parts[2], parts[3], i)), zero);
    const auto cosine = dot(ways[0], ways[1], ways[2], i);
    const auto beside = hn::IfThenElseZero(hn::Le(hn::Abs(cosine), in_plane), hn::Mul(given, share));
    const auto chosen = all ? given : hn::IfThenElse(hn::Gt(cosine, in_plane), given, beside);
    hn::StoreU(hn::BitCast(Numbers(), hn::NearestInt(chosen)), Numbers(), amounts + i);
  }
}

}  // namespace espalier::sim::giving::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier::sim {
namespace giving {
HWY_EXPORT(SumOfSet);
HWY_EXPORT(Give);
}  // namespace giving

Givers::Givers(const DirectionSet& directions, const std::vector<Amount>& amounts, Along along)
    : along_(along) {
  // All of them together stay below 2^30, roundings up included.
  double most = 0.0;
  for (const Amount& a : amounts) most += std::abs(a[0]) + std::hypot(a[1], a[2], a[3]);
  constexpr int kBits = 29;
  unit_ = most > 0.0 ? std::ldexp(1.0, std::ilogb(most) + 1 - kBits) : 1.0;
  const std::size_t count = (directions.size() + 63) / 64 * 64;
  for (std::vector<float>& way : ways_) way.resize(count);
  for (std::vector<float>& part : parts_) part.resize(count);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vec3f unit(glm::normalize(Vec3(directions[i].v)));
    for (int axis = 0; axis < 3; ++axis) ways_[static_cast<std::size_t>(axis)][i] = unit[axis];
    for (std::size_t part = 0; part < parts_.size(); ++part)
      parts_[part][i] = static_cast<float>(amounts[i][part] / unit_);
  }
}

void Givers::give(Vec3f normal, std::uint32_t* amounts) const {
  constexpr float kUpright = 1.0f - 1e-6f;
  const bool halves = along_ == Along::half && std::abs(normal.y) < kUpright;
  const bool all = along_ == Along::half && normal.y >= kUpright;
  const float* const ways[3] = {ways_[0].data(), ways_[1].data(), ways_[2].data()};
  const float* const parts[4] = {parts_[0].data(), parts_[1].data(), parts_[2].data(), parts_[3].data()};
  const float n[3] = {normal.x, normal.y, normal.z};
  using namespace giving;
  HWY_DYNAMIC_DISPATCH(Give)(ways, parts, ways_[0].size(), n, halves ? 0.5f : 0.0f, all, amounts);
}

std::uint32_t sumOfSet(const std::uint64_t* bits, const std::uint32_t* amounts, std::size_t words) {
  using namespace giving;
  return HWY_DYNAMIC_DISPATCH(SumOfSet)(bits, amounts, words);
}

}  // namespace espalier::sim
#endif
