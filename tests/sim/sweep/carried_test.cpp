#include "sim/sweep/carried.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "sim/base/parallel.h"
#include "sim/light/sky.h"
#include "tests/support/bit_worlds.h"

namespace espalier {
namespace {

using sim::LatticeDirection;
using sim::Stops;
using sim::Voxel;

LatticeDirection along(Voxel v, int weight = 1) {
  return {v, sim::crossedVoxels(v), static_cast<std::uint16_t>(weight)};
}

/// Casts the ray: the value of the face through which it comes into the first stop.
template <typename Value>
std::optional<Value> cast(const Stops<Value>& stops, Voxel p, const LatticeDirection& direction) {
  const sim::BitVolume& bits = stops.where;
  Voxel before = p;
  for (Voxel start = p;; start += direction.v) {
    for (const Voxel o : direction.crossed) {
      const Voxel q = start + o;
      if (!sim::contains(bits.size(), q)) return std::nullopt;
      for (std::uint8_t face = 0; bits.at(q) && face < sim::kFaces; ++face) {
        if (sim::kFaceNormals[face] == before - q)
          return stops.faces[face].values[stops.faces[face].where.number(q)];
      }
      before = q;
    }
  }
}

template <typename Value>
Stops<Value> randomStops(Voxel size, double chance, unsigned seed) {
  Stops<Value> stops(tests::randomBits(size, chance, seed));
  std::mt19937 random(seed);
  for (auto& face : stops.faces) {
    for (Value& value : face.values) value = static_cast<Value>(1 + random() % 60000);
  }
  return stops;
}

std::vector<Voxel> everyWay() {
  std::vector<Voxel> ways;
  for (int y = -1; y <= 1; ++y) {
    for (int z = -1; z <= 1; ++z) {
      for (int x = -1; x <= 1; ++x) {
        if (Voxel(x, y, z) != Voxel(0)) ways.emplace_back(x, y, z);
      }
    }
  }
  for (const Voxel v :
       {Voxel(3, 2, -1), {-5, 1, 4}, {2, -7, 1}, {-1, -3, -63}, {40, 3, 2}, {7, 0, -3}, {-2, 0, 9}})
    ways.push_back(v);
  return ways;
}

TEST(Carried, VoxelsSeeWhatTheirRaysMeet) {
  const Voxel size(37, 21, 29);
  for (const double chance : {0.0, 0.004, 0.1}) {
    const auto stops = randomStops<std::uint32_t>(size, chance, 7);
    constexpr std::uint32_t kOpen = 70000;
    for (const Voxel v : everyWay()) {
      const LatticeDirection direction = along(v);
      sim::CarriedSweep<std::uint32_t> sweep(stops, direction, kOpen);
      for (int i = 0; i < size.y; ++i) {
        const int y = sweep.downwards() ? size.y - 1 - i : i;
        sweep.run(y);
        for (int z = 0; z < size.z; ++z) {
          const std::uint32_t* const row = sweep.row(z);
          for (int x = 0; x < size.x; ++x) {
            if (stops.where.at({x, y, z})) continue;
            ASSERT_EQ(row ? row[x] : kOpen, cast(stops, {x, y, z}, direction).value_or(kOpen))
                << v.x << " " << v.y << " " << v.z << " from " << x << " " << y << " " << z;
          }
        }
      }
    }
  }
}

TEST(Carried, SumsAreThoseOfTheRaysOnAnyNumberOfThreads) {
  const Voxel size(19, 13, 17);
  const auto stops = randomStops<std::uint16_t>(size, 0.03, 3);
  sim::DirectionSet directions = sim::makeSky({.directions = 24}).directions;
  for (sim::LatticeDirection& d : directions) d.weight /= 2;
  for (std::size_t i = 0; i < 24; ++i) directions.push_back(along(-directions[i].v, directions[i].weight));
  const auto field = sim::carriedSum(stops, directions);
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x) {
        double sum = 0.0;
        if (stops.where.at({x, y, z})) {
          ASSERT_EQ(field.values[field.index({x, y, z})], 0);
          continue;
        }
        for (const auto& d : directions)
          sum += d.weight * static_cast<double>(cast(stops, {x, y, z}, d).value_or(0));
        ASSERT_EQ(field.values[field.index({x, y, z})], std::lround(sum / sim::ExposureField::kWhole));
      }
    }
  }
  for (const int threads : {1, 2, 5}) {
    sim::onThreads(threads, [&] { EXPECT_EQ(sim::carriedSum(stops, directions).values, field.values); });
  }
}

}  // namespace
}  // namespace espalier
