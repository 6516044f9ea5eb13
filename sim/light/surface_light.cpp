// Sums over the open directions of many places for many normals. Two things keep them short. A direction
// gives a receiver with normal n an amount a + n.b as long as it lies in front of it, so one sum of (a, b)
// over the open bits serves every normal; and such sums over eight bits at a time are looked up. Neighbouring
// surfaces mostly share their normal and read the same places, so what a place gives is kept for a while.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>

#include "sim/base/parallel.h"
#include "sim/light/sky_shares.h"
#include "sim/light/surface.h"
#include "sim/world/field.h"

namespace espalier::sim {
namespace {

using Tap = SurfaceSensors::Tap;

/// What a direction gives: [0] + n.x [1] + n.y [2] + n.z [3].
using Amount = std::array<float, 4>;

Amount operator+(const Amount& a, const Amount& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
}

/// What a direction gives a receiver in whose plane it lies. The sun's stands for a step of its way, in half
/// of which the sun is before the receiver. What looks straight up or down has the horizon for its plane: all
/// of the sun's way lies above it.
enum class Along { nothing, half };

/// Directions with what each gives.
class Givers {
 public:
  Givers(const DirectionSet& directions, const std::vector<Amount>& amounts, Along along) : along_(along) {
    for (const LatticeDirection& d : directions) units_.push_back(Vec3f(glm::normalize(Vec3(d.v))));
    sums_.resize((directions.size() + 7) / 8);
    for (std::size_t byte = 0; byte < sums_.size(); ++byte) {
      sums_[byte][0] = Amount{};
      for (unsigned set = 1; set < 256; ++set) {
        const std::size_t d = 8 * byte + static_cast<std::size_t>(std::countr_zero(set));
        const Amount& rest = sums_[byte][set & (set - 1)];
        sums_[byte][set] = d < amounts.size() ? rest + amounts[d] : rest;
      }
    }
  }

  std::size_t words() const { return (units_.size() + 63) / 64; }

  /// The directions in front of a receiver, a bit for each; and behind them, from words() on, those along its
  /// plane that give half.
  void front(Vec3f normal, std::uint64_t* mask) const {
    constexpr float kAlong = 1e-6f, kUpright = 1.0f - 1e-6f;
    const bool halves = along_ == Along::half && std::abs(normal.y) < kUpright;
    const bool all = along_ == Along::half && normal.y >= kUpright;
    for (std::size_t w = 0; w < words(); ++w) {
      const std::size_t last = std::min(units_.size() - 64 * w, std::size_t{64});
      std::uint64_t before = 0, along = 0;
      for (std::size_t i = 0; i < last; ++i) {
        const Vec3f& u = units_[64 * w + i];
        const float cosine = u.x * normal.x + u.y * normal.y + u.z * normal.z;
        before |= static_cast<std::uint64_t>(cosine > kAlong || all) << i;
        along |= static_cast<std::uint64_t>(halves && std::abs(cosine) <= kAlong) << i;
      }
      mask[w] = before;
      mask[words() + w] = along;
    }
  }

  /// Of the open directions, by what front() says.
  float given(const std::uint64_t* open, const std::uint64_t* mask, Vec3f normal) const {
    const float before = ofThose(open, mask, normal);
    const std::uint64_t* const along = mask + words();
    const bool any = std::any_of(along, along + words(), [](std::uint64_t word) { return word != 0; });
    return any ? before + 0.5f * ofThose(open, along, normal) : before;
  }
  /// Where nothing stands in the way.
  float most(const std::uint64_t* mask, Vec3f normal) const {
    const std::vector<std::uint64_t> all(words(), ~std::uint64_t{0});
    return given(all.data(), mask, normal);
  }

 private:
  float ofThose(const std::uint64_t* open, const std::uint64_t* mask, Vec3f normal) const {
    Amount sum{};
    for (std::size_t byte = 0; byte < sums_.size(); ++byte) {
      const std::uint64_t word = open[byte / 8] & mask[byte / 8];
      sum = sum + sums_[byte][(word >> (8 * (byte % 8))) & 0xffu];
    }
    return sum[0] + sum[1] * normal.x + sum[2] * normal.y + sum[3] * normal.z;
  }

  std::vector<Vec3f> units_;
  std::vector<std::array<Amount, 256>> sums_;
  Along along_;
};

/// Judges surfaces one after the other.
class Judge {
 public:
  Judge(const OpenTable& open, const Givers& givers)
      : open_(open),
        givers_(givers),
        fronts_(kFronts),
        masks_(kFronts * 2 * givers.words()),
        known_(kKnown) {}

  struct Light {
    float received;  ///< by the taps' weights; beyond the bounds where the line was followed too far
    float most;      ///< what all directions in front would give
  };

  Light at(std::span<const Tap> taps, Vec3f normal) {
    const std::size_t hash = hashOf(normal), slot = hash % kFronts;
    std::uint64_t* const mask = masks_.data() + slot * 2 * givers_.words();
    Front& front = fronts_[slot];
    if (front.normal != normal) {
      front.normal = normal;
      givers_.front(normal, mask);
      front.most = givers_.most(mask, normal);
    }
    // The weights add up to 1 but for rounding: what is missing is counted, so that nothing missing is exact.
    float missing = 0.0f;
    for (const Tap& tap : taps) {
      Known& known = known_[(tap.place + hash) % kKnown];
      if (known.place != tap.place || known.normal != normal)
        known = {tap.place, normal, givers_.given(open_.row(tap.place).data(), mask, normal)};
      missing += tap.weight * (front.most - known.value);
    }
    return {front.most - missing, front.most};
  }

 private:
  static constexpr std::size_t kFronts = 256, kKnown = std::size_t{1} << 14;
  struct Front {
    Vec3f normal{0.0f};
    float most = 0.0f;
  };
  struct Known {
    std::uint32_t place = 0;
    Vec3f normal{0.0f};  ///< no surface's
    float value = 0.0f;
  };

  static std::size_t hashOf(Vec3f n) {
    std::uint64_t hash = std::bit_cast<std::uint32_t>(n.x);
    hash = hash * 0x9e3779b97f4a7c15u + std::bit_cast<std::uint32_t>(n.y);
    hash = hash * 0x9e3779b97f4a7c15u + std::bit_cast<std::uint32_t>(n.z);
    return static_cast<std::size_t>((hash * 0x9e3779b97f4a7c15u) >> 32);
  }

  const OpenTable& open_;
  const Givers& givers_;
  std::vector<Front> fronts_;
  std::vector<std::uint64_t> masks_;
  std::vector<Known> known_;
};

/// `finished` turns what a surface received into its value.
template <typename Finish>
std::vector<float> gathered(const SurfaceSensors& sensors, const OpenTable& open, const Givers& givers,
                            Finish finished) {
  std::vector<float> values(sensors.surfaces.size());
  constexpr std::size_t kGrain = 8192;
  parallelFor(values.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Judge judge(open, givers);
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3f normal = sensors.surfaces[i].surface.normal;
      values[i] = finished(judge.at(sensors.of(i), normal), normal);
    }
  });
  return values;
}

/// By scalar amounts, as they are.
std::vector<float> summed(const SurfaceSensors& sensors, const OpenTable& open,
                          const DirectionSet& directions, const std::function<double(std::size_t)>& amount) {
  std::vector<Amount> amounts;
  for (std::size_t d = 0; d < directions.size(); ++d)
    amounts.push_back({static_cast<float>(amount(d)), 0.0f, 0.0f, 0.0f});
  return gathered(sensors, open, {directions, amounts, Along::half}, [](const Judge::Light& light, Vec3f) {
    return std::clamp(light.received, 0.0f, light.most);
  });
}

}  // namespace

double openSky(Weighting weighting, Vec3 normal) {
  if (weighting != Weighting::uniform) return unobstructed(weighting, normal);
  const auto y = static_cast<float>(std::clamp(normal.y, -1.0, 1.0));
  return 1.0 - static_cast<double>(std::acos(y)) / std::numbers::pi;
}

std::vector<float> surfaceSky(const SurfaceSensors& sensors, const OpenTable& open, const Sky& sky) {
  std::vector<Amount> amounts;
  for (const LatticeDirection& d : sky.directions) {
    const Vec3 unit = glm::normalize(Vec3(d.v));
    const double straight = shareOf(d) * received(sky.weighting, unit, unit);
    if (sky.weighting == Weighting::uniform) {
      amounts.push_back({static_cast<float>(straight), 0.0f, 0.0f, 0.0f});
    } else {
      const Vec3f b(straight * unit);
      amounts.push_back({0.0f, b.x, b.y, b.z});
    }
  }
  return gathered(sensors, open, {sky.directions, amounts, Along::nothing},
                  [&](const Judge::Light& light, Vec3f normal) {
                    if (light.most <= 0.0f) return 0.0f;
                    const float share_of_open = std::clamp(light.received / light.most, 0.0f, 1.0f);
                    return share_of_open * static_cast<float>(openSky(sky.weighting, Vec3(normal)));
                  });
}

std::vector<float> surfaceSun(const SurfaceSensors& sensors, const OpenTable& open, const Sun& sun) {
  return summed(sensors, open, sun.directions, [&](std::size_t d) { return shareOf(sun.directions[d]); });
}

std::vector<float> surfaceSunHours(const SurfaceSensors& sensors, const OpenTable& open, const Sun& sun) {
  return summed(sensors, open, sun.directions, [&](std::size_t d) { return sun.hours[d]; });
}

}  // namespace espalier::sim
