// Sums over the open directions of many places for many normals. Neighbouring surfaces mostly share their
// normal and read the same places, so what directions give to a normal, and what a place gives, is kept for a
// while.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "sim/base/parallel.h"
#include "sim/light/givers.h"
#include "sim/light/lie_alike.h"
#include "sim/light/seen_along.h"
#include "sim/light/sky_shares.h"
#include "sim/light/surface.h"
#include "sim/world/field.h"

namespace espalier::sim {
namespace {

using Tap = SurfaceSensors::Tap;

constexpr std::size_t kGrain = 8192;  // surfaces that are judged one after the other

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

  /// What of the directions with a bit reaches a surface.
  float of(const std::uint64_t* bits, Vec3f normal) {
    return givers_.inFull(sumOfSet(bits, before(normal, hashOf(normal)).amounts, givers_.words()));
  }

  Light at(std::span<const Tap> taps, Vec3f normal) {
    const std::size_t hash = hashOf(normal);
    const Front& front = before(normal, hash);
    if (taps.empty()) return {0.0f, givers_.inFull(front.most)};
    // The weights add up to 1 but for rounding: what is missing is counted, so that nothing missing is exact.
    float missing = 0.0f;
    for (const Tap& tap : taps) {
      Known& known = known_[(tap.place + hash) % kKnown];
      if (known.place != tap.place || known.normal != normal)
        known = {tap.place, normal, sumOfSet(open_.row(tap.place).data(), front.amounts, givers_.words())};
      missing += tap.weight * givers_.inFull(front.most - known.sum);
    }
    const float most = givers_.inFull(front.most);
    return {most - missing, most};
  }

 private:
  static constexpr std::size_t kFronts = 64, kKnown = std::size_t{1} << 14;
  struct Front {
    Vec3f normal{0.0f};
    const std::uint32_t* amounts = nullptr;
    std::uint32_t most = 0;  ///< what they add up to
  };
  struct Known {
    std::uint32_t place = 0;
    Vec3f normal{0.0f};  ///< no surface's
    std::uint32_t sum = 0;
  };

  /// What the directions before a receiver give.
  const Front& before(Vec3f normal, std::size_t hash) {
    const std::size_t slot = hash % kFronts;
    Front& front = fronts_[slot];
    if (front.normal != normal) {
      std::uint32_t* const amounts = amounts_.data() + slot * 64 * givers_.words();
      givers_.give(normal, amounts);
      front = {normal, amounts, std::accumulate(amounts, amounts + 64 * givers_.words(), std::uint32_t{0})};
    }
    return front;
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
  parallelFor(values.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Judge judge(open, givers);
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3f normal = sensors.surfaces[i].surface.normal;
      values[i] = finished(judge.at(sensors.of(i), normal), normal);
    }
  });
  return values;
}

/// By scalar amounts, as they are, of the sun: it is in one place, so that it matters where a surface looks
/// from. For each list of amounts the surfaces' values.
std::vector<std::vector<float>> summed(const SurfaceSensors& sensors, const OpenTable& open,
                                       const DirectionSet& directions,
                                       const std::vector<std::vector<double>>& lists) {
  std::vector<Givers> givers;
  for (const std::vector<double>& list : lists) {
    std::vector<Givers::Amount> amounts;
    for (const double amount : list) amounts.push_back({static_cast<float>(amount), 0.0f, 0.0f, 0.0f});
    givers.emplace_back(directions, amounts, Givers::Along::half);
  }
  std::vector<std::vector<float>> values(lists.size(), std::vector<float>(sensors.surfaces.size()));
  parallelFor(sensors.surfaces.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<Judge> judges;
    for (const Givers& each : givers) judges.emplace_back(open, each);
    SeenAlong along(open, directions);
    for (std::size_t i = begin; i < end; ++i) {
      const TiledVoxel& tiled = sensors.surfaces[i];
      const Vec3f normal = tiled.surface.normal;
      const std::uint64_t* const seen = sensors.of(i).empty() ? nullptr : along.from(tiled);
      for (std::size_t list = 0; list < lists.size(); ++list) {
        if (seen) {
          values[list][i] = judges[list].of(seen, normal);
        } else {
          const Judge::Light light = judges[list].at(sensors.of(i), normal);
          values[list][i] = std::clamp(light.received, 0.0f, light.most);
        }
      }
    }
  });
  return values;
}

std::vector<double> sharesOf(const Sun& sun) {
  std::vector<double> shares;
  for (const LatticeDirection& d : sun.directions) shares.push_back(shareOf(d));
  return shares;
}

}  // namespace

double openSky(Weighting weighting, Vec3 normal) {
  if (weighting != Weighting::uniform) return unobstructed(weighting, normal);
  const auto y = static_cast<float>(std::clamp(normal.y, -1.0, 1.0));
  return 1.0 - static_cast<double>(std::acos(y)) / std::numbers::pi;
}

std::vector<float> surfaceSky(const SurfaceSensors& sensors, const OpenTable& open, const Sky& sky) {
  const bool below = !sky.directions.empty() && sky.directions.front().v.y < 0;
  const Vec3 side(1.0, below ? -1.0 : 1.0, 1.0);
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
                    return share_of_open * static_cast<float>(openSky(sky.weighting, Vec3(normal) * side));
                  });
}

std::vector<float> surfaceSun(const SurfaceSensors& sensors, const OpenTable& open, const Sun& sun) {
  return summed(sensors, open, sun.directions, {sharesOf(sun)})[0];
}

std::vector<float> surfaceSunHours(const SurfaceSensors& sensors, const OpenTable& open, const Sun& sun) {
  return summed(sensors, open, sun.directions, {sun.hours})[0];
}

SunOnSurfaces sunOnSurfaces(const SurfaceSensors& sensors, const OpenTable& open, const Sun& sun) {
  auto both = summed(sensors, open, sun.directions, {sharesOf(sun), sun.hours});
  return {std::move(both[0]), std::move(both[1])};
}

}  // namespace espalier::sim
