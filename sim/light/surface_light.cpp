// Sums over the open directions of many places for many normals. Neighbouring surfaces mostly share their
// normal and read the same places, so what directions give to a normal, and what a place gives, is kept for a
// while.
#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "sim/base/parallel.h"
#include "sim/light/givers.h"
#include "sim/light/sky_shares.h"
#include "sim/light/surface.h"
#include "sim/world/field.h"

namespace espalier::sim {
namespace {

using Tap = SurfaceSensors::Tap;

/// Judges surfaces one after the other.
class Judge {
 public:
  Judge(const OpenTable& open, const Givers& givers)
      : open_(open),
        givers_(givers),
        fronts_(kFronts),
        amounts_(kFronts * 64 * givers.words()),
        known_(kKnown) {}

  struct Light {
    float received;  ///< by the taps' weights; beyond the bounds where the line was followed too far
    float most;      ///< what all directions in front would give
  };

  Light at(std::span<const Tap> taps, Vec3f normal) {
    const std::size_t hash = hashOf(normal), slot = hash % kFronts;
    std::uint32_t* const amounts = amounts_.data() + slot * 64 * givers_.words();
    Front& front = fronts_[slot];
    if (front.normal != normal) {
      givers_.give(normal, amounts);
      front = {normal, std::accumulate(amounts, amounts + 64 * givers_.words(), std::uint32_t{0})};
    }
    if (taps.empty()) return {0.0f, givers_.inFull(front.most)};
    // The weights add up to 1 but for rounding: what is missing is counted, so that nothing missing is exact.
    float missing = 0.0f;
    for (const Tap& tap : taps) {
      Known& known = known_[(tap.place + hash) % kKnown];
      if (known.place != tap.place || known.normal != normal)
        known = {tap.place, normal, sumOfSet(open_.row(tap.place).data(), amounts, givers_.words())};
      missing += tap.weight * givers_.inFull(front.most - known.sum);
    }
    const float most = givers_.inFull(front.most);
    return {most - missing, most};
  }

 private:
  static constexpr std::size_t kFronts = 64, kKnown = std::size_t{1} << 14;
  struct Front {
    Vec3f normal{0.0f};
    std::uint32_t most = 0;
  };
  struct Known {
    std::uint32_t place = 0;
    Vec3f normal{0.0f};  ///< no surface's
    std::uint32_t sum = 0;
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
  std::vector<std::uint32_t> amounts_;
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
  std::vector<Givers::Amount> amounts;
  for (std::size_t d = 0; d < directions.size(); ++d)
    amounts.push_back({static_cast<float>(amount(d)), 0.0f, 0.0f, 0.0f});
  return gathered(
      sensors, open, {directions, amounts, Givers::Along::half},
      [](const Judge::Light& light, Vec3f) { return std::clamp(light.received, 0.0f, light.most); });
}

}  // namespace

double openSky(Weighting weighting, Vec3 normal) {
  if (weighting != Weighting::uniform) return unobstructed(weighting, normal);
  const auto y = static_cast<float>(std::clamp(normal.y, -1.0, 1.0));
  return 1.0 - static_cast<double>(std::acos(y)) / std::numbers::pi;
}

std::vector<float> surfaceSky(const SurfaceSensors& sensors, const OpenTable& open, const Sky& sky) {
  std::vector<Givers::Amount> amounts;
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
  return gathered(sensors, open, {sky.directions, amounts, Givers::Along::nothing},
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
