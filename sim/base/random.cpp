#include "sim/base/random.h"

#include <Random123/philox.h>
#include <fmt/format.h>
#include <xxhash.h>

#include <cmath>
#include <numbers>

#include "sim/base/error.h"

namespace espalier::sim {

// Counter words: node; iteration (24 bits) and the high bits of the site's number (8); its low bits (16) and
// the item (16); the purpose (8), the trial (16) and the block of four numbers (8). Every field has a place
// of its own, so no stream runs into another.
PhiloxInput philoxInput(const RandomKey& key, Purpose purpose, unsigned item, unsigned trial) {
  if (item >= Slots::kItems || trial >= Slots::kTrials || key.number >= Slots::kNumbers ||
      key.iteration >= Slots::kNumbers) {
    throw BrokenContract(
        fmt::format("random numbers for site {}, iteration {}, item {} and trial {}; they are told apart "
                    "below {}, {}, {} and {}",
                    key.number, key.iteration, item, trial, Slots::kNumbers, Slots::kNumbers, Slots::kItems,
                    Slots::kTrials));
  }
  return {{key.node, key.iteration | (key.number >> 16 << 24), (key.number << 16) | item,
           (static_cast<std::uint32_t>(purpose) << 24) | (trial << 8)},
          {static_cast<std::uint32_t>(key.stream), static_cast<std::uint32_t>(key.stream >> 32)}};
}

void Slots::fill(unsigned block) {
  if (block >= kSlots / 4) {
    throw BrokenContract(fmt::format("a trial's random number {}; there are {}", 4 * block, kSlots));
  }
  const auto& [words, keys] = input_;
  const r123::Philox4x32::ctr_type counter{{words[0], words[1], words[2], words[3] | block}};
  const r123::Philox4x32::key_type key{{keys[0], keys[1]}};
  const auto numbers = r123::Philox4x32()(counter, key);
  for (std::size_t i = 0; i < 4; ++i) buffer_[i] = numbers[i];
  block_ = block;
}

int Draws::whole(int low, int high) {
  const auto span = static_cast<std::uint64_t>(high - low) + 1;
  return low + static_cast<int>((bits() * span) >> 32);
}

Vec3 Draws::onSphere() {
  return inCone(Vec3(0, 1, 0), -1.0);
}

Vec3 Draws::inCone(Vec3 axis, double cos_half_angle) {
  const double turn = uniform(), height = uniform();
  return sim::inCone(axis, cos_half_angle, turn, height);
}

std::uint64_t streamOf(std::uint64_t seed, std::string_view planting, std::uint64_t plant) {
  const std::uint64_t numbers[] = {seed, plant, XXH3_64bits(planting.data(), planting.size())};
  return XXH3_64bits(numbers, sizeof numbers);
}

RandomKey keyAt(std::uint64_t stream, Voxel v) {
  return {stream, static_cast<std::uint32_t>(v.x) | (static_cast<std::uint32_t>(v.y) << 16), 0,
          static_cast<std::uint32_t>(v.z)};
}

glm::dvec2 unitCircle(double turns) {
  // Taylor's series within an eighth of a turn about the nearest quarter: the first terms left out are below
  // 1e-17 there.
  constexpr double kSine[] = {-1.0 / 6,        1.0 / 120,        -1.0 / 5040,          1.0 / 362880,
                              -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000};
  constexpr double kCosine[] = {-1.0 / 2,       1.0 / 24,        -1.0 / 720,         1.0 / 40320,
                                -1.0 / 3628800, 1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000};
  const double quarters = std::floor(4.0 * turns + 0.5);
  const double x = 2.0 * std::numbers::pi * (turns - 0.25 * quarters), x2 = x * x;
  double sine = 0.0, cosine = 0.0;
  for (int i = 7; i >= 0; --i) {
    sine = (sine + kSine[i]) * x2;
    cosine = (cosine + kCosine[i]) * x2;
  }
  sine = x + x * sine;
  cosine = 1.0 + cosine;
  switch (static_cast<long long>(quarters) & 3) {
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    case 3:
      return {sine, -cosine};
    default:
      return {cosine, sine};
  }
}

Vec3 inCone(Vec3 axis, double cos_half_angle, double turn, double height) {
  // Even in height is even on the sphere (Archimedes).
  const double along = 1.0 - height * (1.0 - cos_half_angle);
  const double across = std::sqrt(std::max(0.0, 1.0 - along * along));
  const Vec3 u = perpendicular(axis);
  const Vec3 v = glm::cross(axis, u);
  const glm::dvec2 way = unitCircle(turn);
  return along * axis + across * (way.x * u + way.y * v);
}

Vec3 perpendicular(Vec3 unit) {
  const Vec3 a = glm::abs(unit);
  const Vec3 helper = a.x <= a.y && a.x <= a.z ? Vec3(1, 0, 0) : a.y <= a.z ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  return glm::normalize(glm::cross(unit, helper));
}

}  // namespace espalier::sim
