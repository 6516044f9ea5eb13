#include "sim/grow/growth.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "sim/base/error.h"

namespace espalier::sim {
namespace {

/// A place in millionths of a metre. Beyond what 64 bits hold it is the end of them: the same for all out
/// there.
std::array<std::int64_t, 3> quantized(Vec3 place_m) {
  std::array<std::int64_t, 3> whole{};
  for (int axis = 0; axis < 3; ++axis) {
    const double micro = std::clamp(place_m[axis] * 1e6, -9e18, 9e18);
    whole[static_cast<std::size_t>(axis)] = std::llround(std::isnan(micro) ? 0.0 : micro);
  }
  return whole;
}

}  // namespace

std::uint64_t keyOfPlace(Vec3 place_m, std::uint64_t twin) {
  const auto whole = quantized(place_m);
  return XXH3_64bits_withSeed(whole.data(), sizeof whole, twin);
}

std::uint64_t keyOfName(std::string_view name) {
  return XXH3_64bits_withSeed(name.data(), name.size(),
                              0x6b6579);  // not what a place of the same bytes gives
}

std::vector<Seed> seedsAt(const Frame& frame, const std::vector<Vec3>& places_vx) {
  std::vector<Seed> seeds;
  std::map<std::array<std::int64_t, 3>, std::uint64_t> met;
  for (const Vec3 place : places_vx) {
    const Vec3 place_m = worldFromVoxel(frame, place);
    seeds.push_back({place, keyOfPlace(place_m, met[quantized(place_m)]++)});
  }
  return seeds;
}

void requireProcesses(const std::vector<Planting>& plantings) {
  for (const Planting& planting : plantings) {
    if (!planting.process) throw BrokenContract("the planting '" + planting.name + "' has no growth process");
  }
}

Tally total(const Growth& growth) {
  Tally sum;
  for (const Tally& tally : growth.tallies) {
    for (std::size_t k = 0; k < kOutcomes; ++k) {
      sum.sites[k] += tally.sites[k];
      sum.trials[k] += tally.trials[k];
    }
  }
  return sum;
}

}  // namespace espalier::sim
