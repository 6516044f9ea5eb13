#include "sim/light/open_rays.h"

#include <gtest/gtest.h>

#include <random>

#include "sim/light/clear_bricks.h"
#include "sim/light/exposure.h"
#include "sim/light/filled_ahead.h"
#include "sim/light/sky.h"
#include "sim/light/sun.h"
#include "sim/sweep/lanes.h"
#include "tests/support/bit_worlds.h"

namespace espalier {
namespace {

using sim::Voxel;

/// Up, level and down, from along an axis to as long as there are.
sim::DirectionSet allKinds() {
  sim::DirectionSet set = sim::makeSky({.directions = 128}).directions;
  const auto sun = sim::makeSun(sim::SunArc{}).directions;
  set.insert(set.end(), sun.begin(), sun.end());
  for (const Voxel v : {Voxel(1, 0, 0), Voxel(-1, 0, 0), Voxel(0, 1, 0), Voxel(0, -1, 0), Voxel(0, 0, 1),
                        Voxel(0, 0, -1), Voxel(63, 62, -61), Voxel(-63, 1, 0), Voxel(1, -63, 62),
                        Voxel(1, 1, -1), Voxel(-1, 1, 1), Voxel(-2, 0, 1), Voxel(0, -3, 2), Voxel(5, -7, -6)})
    set.push_back({v, sim::crossedVoxels(v), 1});
  return set;
}

/// Corners, places beside the rim, and others; some of them twice.
std::vector<Voxel> placesIn(Voxel size, int count, unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::vector<Voxel> places;
  for (int corner = 0; corner < 8; ++corner) {
    places.emplace_back((corner & 1) != 0 ? size.x - 1 : 0, (corner & 2) != 0 ? size.y - 1 : 0,
                        (corner & 4) != 0 ? size.z - 1 : 0);
  }
  for (int i = 0; i < count; ++i) {
    places.emplace_back(below(size.x), below(size.y), below(size.z));
    if (i % 3 == 0) places.push_back(places.back());
  }
  return places;
}

void expectWhatRaysMeet(const sim::BitVolume& bits, const sim::DirectionSet& set,
                        const std::vector<Voxel>& places) {
  const sim::OpenRays rays(bits, set);
  sim::ClearAhead ahead;
  const auto open = rays.from(bits, places, ahead);
  ASSERT_EQ(open.size(), places.size() * rays.words());
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t d = 0; d < 64 * rays.words(); ++d) {
      const bool is_open = ((open[i * rays.words() + d / 64] >> (d % 64)) & 1u) != 0;
      ASSERT_EQ(is_open, d < set.size() && sim::reachesEdge(bits, places[i], set[d]))
          << "place " << i << " direction " << d;
    }
  }
}

TEST(OpenRays, AreThoseThatReachTheEdge) {
  const auto set = allKinds();
  for (const Voxel size :
       {Voxel(61, 40, 53), Voxel(64, 64, 64), Voxel(1, 90, 70), Voxel(90, 1, 70), Voxel(90, 70, 1),
        Voxel(1, 1, 1), Voxel(300, 20, 9), Voxel(9, 20, 300), Voxel(20, 300, 9), Voxel(129, 77, 7)}) {
    for (const double chance : {0.0, 0.0003, 0.01, 0.2}) {
      const auto bits = tests::randomBits(size, chance, 11);
      expectWhatRaysMeet(bits, set, placesIn(size, 60, 5));
    }
  }
}

// Long ways: beyond the legs, and with bricks that are clear or not.
TEST(OpenRays, AreThoseThatReachTheEdgeOfALargeWorld) {
  sim::BitVolume bits({270, 260, 210});
  tests::addBox(bits, {0, 0, 0}, {269, 5, 209});        // ground
  tests::addBox(bits, {40, 6, 100}, {220, 200, 109});   // a wall
  tests::addBox(bits, {100, 230, 0}, {120, 232, 209});  // a beam above it
  std::vector<Voxel> places = placesIn(bits.size(), 100, 6);
  for (int i = 0; i < 100; ++i) places.emplace_back(30 + 2 * i, 7 + i, 110 + i % 3);
  expectWhatRaysMeet(bits, allKinds(), places);
}

// More bricks along every axis than a word has bits.
TEST(OpenRays, AreThoseThatReachTheEdgeOfAVeryLargeWorld) {
  sim::BitVolume bits({530, 521, 540});
  std::mt19937 random(3);
  for (int i = 0; i < 3000; ++i)
    bits.set({static_cast<int>(random() % 530), static_cast<int>(random() % 300),
              static_cast<int>(random() % 540)});
  expectWhatRaysMeet(bits, allKinds(), placesIn(bits.size(), 60, 6));
}

// What blocks a ray is the only thing there is: nothing else keeps a look going as far as that.
TEST(OpenRays, AreBlockedByASingleVoxelHoweverFar) {
  sim::DirectionSet set = allKinds();
  for (const Voxel v : {Voxel(27, 26, 5), Voxel(-20, 21, 19), Voxel(9, -8, 9), Voxel(3, 2, -3),
                        Voxel(4, 4, 3), Voxel(-4, 3, 4), Voxel(5, -5, -5)})
    set.push_back({v, sim::crossedVoxels(v), 1});
  const Voxel size(530, 520, 517);  // coarse
  ASSERT_TRUE(sim::ClearBricks::isCoarse(size));
  sim::BitVolume bits(size);
  const sim::OpenRays rays(bits, set);
  std::mt19937 random(17);
  std::size_t far = 0;
  for (const Voxel from : placesIn(size, 20, 18)) {
    for (std::size_t d = 0; d < set.size(); d += 1 + random() % 4) {
      std::vector<Voxel> ray;
      for (Voxel base = from; sim::contains(size, base); base += set[d].v) {
        for (const Voxel o : set[d].crossed) {
          if (sim::contains(size, base + o)) ray.push_back(base + o);
        }
      }
      if (ray.empty()) continue;
      const std::size_t k =
          random() % (random() % 2 == 0 ? ray.size() : std::min<std::size_t>(30, ray.size()));
      far += k > 100 ? 1 : 0;
      bits.set(ray[k]);
      sim::Bricks filled(size);
      filled.add(ray[k]);
      sim::ClearAhead ahead;
      const auto open = rays.from(bits, {&from, 1}, ahead, &filled);
      for (std::size_t i = 0; i < set.size(); ++i) {
        ASSERT_EQ(((open[i / 64] >> (i % 64)) & 1u) != 0, sim::reachesEdge(bits, from, set[i]))
            << "direction " << i << " of " << d;
      }
      bits.clear(ray[k]);
    }
  }
  EXPECT_GT(far, 100u);
}

// A group's directions begin where those of the one before end.
TEST(OpenRays, TakeAnyNumberOfDirectionsInCoarseWorlds) {
  sim::DirectionSet set = sim::makeSky({.directions = 600}).directions;
  const auto others = allKinds();
  set.insert(set.end(), others.begin(), others.end());
  sim::BitVolume bits({16, 2000, 1060});
  ASSERT_TRUE(sim::ClearBricks::isCoarse(bits.size()));
  std::mt19937 random(6);
  for (int i = 0; i < 20000; ++i) {
    bits.set({static_cast<int>(random() % 16), static_cast<int>(random() % 700),
              static_cast<int>(random() % 1060)});
  }
  expectWhatRaysMeet(bits, set, placesIn(bits.size(), 30, 7));
  expectWhatRaysMeet(bits, sim::DirectionSet(set.begin(), set.begin() + 257), placesIn(bits.size(), 9, 8));
}

// More directions than a group holds, and down alone.
TEST(OpenRays, TakeAnyNumberOfDirections) {
  const auto bits = tests::randomBits({70, 33, 41}, 0.004, 8);
  auto many = sim::makeSky({.directions = 700}).directions;
  expectWhatRaysMeet(bits, many, placesIn(bits.size(), 20, 7));
  for (auto& direction : many) {
    direction.v = -direction.v;
    for (Voxel& o : direction.crossed) o = -o;
  }
  expectWhatRaysMeet(bits, many, placesIn(bits.size(), 20, 8));
  expectWhatRaysMeet(bits, {}, placesIn(bits.size(), 20, 9));
  expectWhatRaysMeet(bits, allKinds(), {});
}

TEST(OpenRays, AreTheSameAtEveryLevel) {
  const auto best = sim::lanes::level();
  const auto bits = tests::randomBits({75, 50, 66}, 0.003, 12);
  sim::BitVolume coarse({525, 521, 517});
  std::mt19937 random(4);
  for (int i = 0; i < 6000; ++i)
    coarse.set({static_cast<int>(random() % 525), static_cast<int>(random() % 200),
                static_cast<int>(random() % 517)});
  for (const std::string& level : sim::lanes::levels()) {
    sim::lanes::useLevel(level);
    expectWhatRaysMeet(bits, allKinds(), placesIn(bits.size(), 30, 9));
    expectWhatRaysMeet(coarse, allKinds(), placesIn(coarse.size(), 15, 9));
  }
  sim::lanes::useLevel(best);
}

// A brick is clear along a direction only if no ray that comes through it, on whatever line, meets anything
// there or later.
TEST(ClearBricks, NoRayThroughOneMeetsAnything) {
  auto set = allKinds();
  set.resize(std::min<std::size_t>(set.size(), 64 * sim::ClearBricks::kWords));
  for (const Voxel size : {Voxel(40, 33, 30), Voxel(17, 40, 25), Voxel(510, 390, 150)}) {
    const auto bits = tests::randomBits(size, size.x > 100 ? 1e-7 : 0.0005, 13);
    const sim::ClearBricks clear(size, sim::Bricks(bits), set);
    std::size_t clear_ones = 0;
    for (std::size_t d = 0; d < set.size(); ++d) {
      for (const Voxel from : placesIn(size, 150, 14)) {
        // What is met from each voxel of the ray on.
        std::vector<Voxel> ray;
        for (Voxel base = from; sim::contains(size, base); base += set[d].v) {
          for (const Voxel o : set[d].crossed) ray.push_back(base + o);
        }
        bool free = true;
        for (std::size_t i = ray.size(); i-- > 0;) {
          free = free && !bits.at(ray[i]);
          if (!clear.is(d, ray[i])) continue;
          ++clear_ones;
          ASSERT_TRUE(free) << "direction " << d;
        }
      }
    }
    EXPECT_GT(clear_ones, 1000u);
  }
}

/// Whether all bricks are as those of clear bricks made anew.
bool isAsAnew(const sim::ClearBricks& clear, const sim::BitVolume& bits, const sim::DirectionSet& set) {
  const sim::ClearBricks anew(bits.size(), sim::Bricks(bits), set);
  const Voxel bricks = (bits.size() + 7) / 8;
  for (int y = 0; y < bricks.y; ++y)
    for (int z = 0; z < bricks.z; ++z)
      for (int x = 0; x < bricks.x; ++x)
        if (!std::equal(anew.ofBrick({x, y, z}), anew.ofBrick({x, y, z}) + sim::ClearBricks::kWords,
                        clear.ofBrick({x, y, z})))
          return false;
  return true;
}

// However many bricks fill or empty at a time.
TEST(ClearBricks, ThatFollowAVolumeAreAsIfMadeAnew) {
  auto set = allKinds();
  set.resize(std::min<std::size_t>(set.size(), 64 * sim::ClearBricks::kWords));
  for (const Voxel size : {Voxel(90, 70, 61), Voxel(17, 140, 25), Voxel(8, 8, 8), Voxel(510, 390, 150)}) {
    auto bits = tests::randomBits(size, size.x > 100 ? 1e-7 : 2e-5, 21);
    sim::Bricks filled(bits);
    sim::ClearBricks clear(size, filled, set);
    std::mt19937 random(22);
    const auto anywhere = [&] {
      const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
      return Voxel(below(size.x), below(size.y), below(size.z));
    };
    for (const int voxels : {1, 0, 3, 1, 40, 2, 3000, 1}) {
      const sim::ClearBricks unchanged = clear;
      for (int i = 0; i < voxels; ++i) bits.set(anywhere());
      clear.follow(sim::Bricks(bits), set);
      ASSERT_TRUE(isAsAnew(clear, bits, set)) << size.x << " " << voxels;
      // There is something to follow.
      if (voxels == 3 && size.x == 90) {
        EXPECT_FALSE(isAsAnew(unchanged, bits, set));
      }
    }
    clear.follow(sim::Bricks(size), set);
    ASSERT_TRUE(isAsAnew(clear, sim::BitVolume(size), set));
  }
}

// However far a ray goes on, behind what the horizon says it meets nothing.
TEST(Horizons, LieBehindAllThatRaysMeet) {
  const auto set = allKinds();
  for (const Voxel size :
       {Voxel(40, 33, 30), Voxel(17, 40, 25), Voxel(1, 90, 30), Voxel(530, 515, 513), Voxel(3000, 9, 2000)}) {
    const auto bits = tests::randomBits(size, size.x > 100 ? 1e-6 : 0.003, 13);
    const sim::FilledAhead ahead(size, sim::Bricks(bits), set);
    std::size_t met = 0, nothing = 0;
    for (std::size_t d = 0; d < set.size(); ++d) {
      const int axis = sim::Horizons::depthAxis(set[d].v);
      for (const Voxel from : placesIn(size, 60, 14)) {
        const int reach = ahead.horizons().reach(d, from);
        if (reach < 0) ++nothing;
        for (Voxel base = from; sim::contains(size, base); base += set[d].v) {
          for (const Voxel o : set[d].crossed) {
            if (!bits.at(base + o)) continue;
            ++met;
            ASSERT_GE(reach, std::abs((base + o - from)[axis])) << "direction " << d;
          }
        }
      }
    }
    EXPECT_GT(met, 0u);
    if (sim::ClearBricks::isCoarse(size)) {
      EXPECT_GT(nothing, 100u);
    }
  }
}

/// Whether all is as if made anew.
bool isAsAnew(const sim::FilledAhead& ahead, const sim::BitVolume& bits, const sim::DirectionSet& set) {
  const sim::FilledAhead anew(bits.size(), sim::Bricks(bits), set);
  const Voxel bricks = ahead.bricks();
  const auto words = static_cast<std::size_t>(bricks.x * bricks.y * bricks.z) / 4 + 1;
  for (const auto& direction : set) {
    const std::size_t octant = sim::FilledAhead::octantOf(direction.v);
    if (!std::equal(anew.around(octant), anew.around(octant) + words, ahead.around(octant))) return false;
  }
  for (const Voxel at : placesIn(bits.size(), 300, 4)) {
    for (std::size_t d = 0; d < set.size(); ++d) {
      if (ahead.horizons().reach(d, at) != anew.horizons().reach(d, at)) return false;
    }
  }
  return true;
}

// However many bricks fill or empty at a time.
TEST(FilledAhead, ThatFollowsAVolumeIsAsIfMadeAnew) {
  const auto set = allKinds();
  for (const Voxel size : {Voxel(90, 70, 61), Voxel(17, 140, 25), Voxel(8, 8, 8), Voxel(530, 525, 513)}) {
    auto bits = tests::randomBits(size, size.x > 100 ? 1e-7 : 2e-5, 21);
    sim::FilledAhead ahead(size, sim::Bricks(bits), set);
    std::mt19937 random(22);
    const auto anywhere = [&] {
      const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
      return Voxel(below(size.x), below(size.y), below(size.z));
    };
    for (const int voxels : {1, 0, 3, 1, 40, 2, 3000, 1}) {
      const sim::FilledAhead unchanged = ahead;
      for (int i = 0; i < voxels; ++i) bits.set(anywhere());
      ahead.follow(sim::Bricks(bits), set);
      ASSERT_TRUE(isAsAnew(ahead, bits, set)) << size.x << " " << voxels;
      // There is something to follow.
      if (voxels == 3 && size.x == 90) {
        EXPECT_FALSE(isAsAnew(unchanged, bits, set));
      }
    }
    ahead.follow(sim::Bricks(size), set);
    ASSERT_TRUE(isAsAnew(ahead, sim::BitVolume(size), set));
  }
}

// Whatever of a brick's neighbours along some axes, and of itself, holds anything.
TEST(FilledAhead, KnowsOfTheBricksAround) {
  const auto set = allKinds();
  const auto bits = tests::randomBits({70, 50, 61}, 0.0002, 23);
  const sim::Bricks filled(bits);
  const sim::FilledAhead ahead(bits.size(), filled, set);
  const Voxel bricks = ahead.bricks();
  std::size_t number = 0;
  for (int y = 0; y < bricks.y; ++y) {
    for (int z = 0; z < bricks.z; ++z) {
      for (int x = 0; x < bricks.x; ++x, ++number) {
        for (unsigned octant = 0; octant < 8; ++octant) {
          if (ahead.around(octant) == nullptr) continue;
          for (unsigned axes = 0; axes < 8; ++axes) {
            bool expected = false;
            for (unsigned some = 0; some < 8; ++some) {
              if ((some & axes) != some) continue;
              const auto step = [&](unsigned axis) {
                return (some & axis) == 0 ? 0 : (octant & axis) != 0 ? -1 : 1;
              };
              expected = expected || filled.bits().at(Voxel(x, y, z) + Voxel(step(1), step(2), step(4)));
            }
            const auto four = ahead.around(octant)[number / 4];
            ASSERT_EQ(((four >> (8 * (number % 4) + axes)) & 1u) != 0, expected);
          }
        }
      }
    }
  }
}

// With the bricks that somebody keeps, too.
TEST(OpenRays, WithWhatWasClearBeforeAreThoseThatReachTheEdgeNow) {
  const sim::DirectionSet set = allKinds();
  for (const Voxel size : {Voxel(75, 50, 66), Voxel(530, 313, 240)}) {
    auto bits = tests::randomBits(size, size.x > 100 ? 2e-6 : 0.0005, 31);
    sim::Bricks filled(bits);
    const sim::OpenRays rays(bits, set);
    sim::ClearAhead ahead, ahead_kept;
    for (unsigned round = 0; round < 6; ++round) {
      const auto places = placesIn(size, 20, round);
      sim::ClearAhead anew;
      const auto open = rays.from(bits, places, anew);
      ASSERT_EQ(rays.from(bits, places, ahead), open);
      ASSERT_EQ(rays.from(bits, places, ahead_kept, &filled), open);
      for (const Voxel place : placesIn(size, 3, 100 + round)) {
        bits.set(place);
        filled.add(place);
      }
    }
    expectWhatRaysMeet(bits, set, placesIn(size, 20, 50));
  }
}

}  // namespace
}  // namespace espalier
