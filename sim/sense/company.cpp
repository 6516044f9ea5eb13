#include "sim/sense/company.h"

#include <bit>
#include <limits>

#include "sim/sense/ball.h"
#include "sim/tile/tiling.h"

namespace espalier::sim {
namespace {

std::uint64_t ofRegion(const World& world, const std::string& region, Voxel first, std::uint64_t among) {
  std::uint64_t those = 0;
  for (std::uint64_t left = among; left != 0; left &= left - 1) {
    const Voxel v = first + Voxel(std::countr_zero(left), 0, 0);
    if (world.part(world.partAt(v)).region == region) those |= left & -left;
  }
  return those;
}

/// The bit nearest to a place, which may lie before the word or behind it; of two the lower. The word is not
/// 0.
int nearestBit(std::uint64_t word, int place) {
  const std::uint64_t up_to = place < 0 ? 0 : place >= 63 ? word : word & ((std::uint64_t{2} << place) - 1);
  const std::uint64_t beyond = word & ~up_to;
  if (up_to == 0) return std::countr_zero(beyond);
  const int before = 63 - std::countl_zero(up_to);
  if (beyond == 0) return before;
  const int behind = std::countr_zero(beyond);
  return place - before <= behind - place ? before : behind;
}

/// Where voxels of those asked for can be: what stands in no plant is passed over by whole words.
const BitVolume& amongWhich(const World& world, const Whose& whose) {
  using Kind = Whose::Kind;
  const bool plants = whose.kind == Kind::plants || whose.kind == Kind::own || whose.kind == Kind::others;
  return plants ? world.inPlants() : world.occupied();
}

template <class Pick>
double densityIn(const BitVolume& set, Voxel about, double radius_vx, Pick pick) {
  std::int64_t count = 0;
  forEachWordOfBall(set, about, radius_vx,
                    [&](Voxel first, std::uint64_t word, int, int) { count += bitCount(pick(first, word)); });
  return static_cast<double>(count) / static_cast<double>(ballOf(radius_vx).voxels);
}

/// Of the voxels of a set, those that `pick(first, word)` leaves.
template <class Pick>
std::optional<Voxel> nearestIn(const BitVolume& set, Voxel about, double radius_vx, Pick pick) {
  const Voxel size = set.size();
  std::optional<Voxel> nearest;
  int least = std::numeric_limits<int>::max();  // the square of how far it is
  const auto before = [](Voxel a, Voxel b) { return std::tie(a.y, a.z, a.x) < std::tie(b.y, b.z, b.x); };
  for (const auto& [dy, dz, half] : ballOf(radius_vx).outward) {
    const int off = dy * dy + dz * dz;
    if (off > least) break;
    const int y = about.y + dy, z = about.z + dz;
    if (y < 0 || y >= size.y || z < 0 || z >= size.z) continue;
    const int far = nearest ? std::min(half, rootBelow(least - off)) : half;
    const int high = std::min(size.x - 1, about.x + far);
    for (int x = std::max(0, about.x - far); x <= high; x += BitVolume::kWordBits) {
      const Voxel first(x, y, z);
      const int place = about.x - x;
      const std::uint64_t word = set.from(first) & bitsAbout(place, far);
      const std::uint64_t those = word == 0 ? 0 : pick(first, word);
      if (those == 0) continue;
      const Voxel v = first + Voxel(nearestBit(those, place), 0, 0);
      const int square = (v.x - about.x) * (v.x - about.x) + off;
      if (square > least || (square == least && !before(v, *nearest))) continue;
      least = square;
      nearest = v;
    }
  }
  return nearest;
}

constexpr auto kAsTheyAre = [](Voxel, std::uint64_t word) { return word; };

}  // namespace

std::uint64_t thoseOf(const World& world, const Whose& whose, Voxel first, std::uint64_t among) {
  if (whose.kind == Whose::Kind::everything || among == 0) return among;
  switch (whose.kind) {
    case Whose::Kind::scene:
      return among & ~world.ofPlants(first, among);
    case Whose::Kind::plants:
      return world.ofPlants(first, among);
    case Whose::Kind::own:
      return world.ofPlant(first, among, whose.plant);
    case Whose::Kind::others:
      return world.ofOtherPlants(first, among, whose.plant);
    case Whose::Kind::region:
      return ofRegion(world, whose.region, first, among & ~world.ofPlants(first, among));
    case Whose::Kind::everything:
      break;
  }
  return among;
}

double densityAround(const World& world, const Whose& whose, Voxel about, double radius_vx) {
  return densityIn(amongWhich(world, whose), about, radius_vx,
                   [&](Voxel first, std::uint64_t word) { return thoseOf(world, whose, first, word); });
}

Crowd crowdAround(const World& world, const Whose& whose, Voxel about, double radius_vx) {
  MassOfBall mass(about);
  forEachWordOfBall(amongWhich(world, whose), about, radius_vx,
                    [&](Voxel first, std::uint64_t word, int dy, int dz) {
                      mass.add(first, thoseOf(world, whose, first, word), dy, dz);
                    });
  const auto all = static_cast<double>(ballOf(radius_vx).voxels);
  return {static_cast<double>(mass.count()) / all, mass.centre()};
}

std::optional<Voxel> nearestOf(const World& world, const Whose& whose, Voxel about, double radius_vx) {
  return nearestIn(amongWhich(world, whose), about, radius_vx,
                   [&](Voxel first, std::uint64_t word) { return thoseOf(world, whose, first, word); });
}

Company::Company(const World& world, const Whose& whose, Voxel about, int reach_vx)
    : low_(glm::max(about - reach_vx, Voxel(0))),
      those_(glm::min(about + reach_vx, world.frame().size - 1) - low_ + 1) {
  const BitVolume& set = amongWhich(world, whose);
  const Voxel size = those_.size();
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; x += BitVolume::kWordBits) {
        const Voxel first = low_ + Voxel(x, y, z);
        const std::uint64_t word = set.from(first) & bitsAbout(0, size.x - 1 - x);
        if (word != 0) those_.row(y, z)[x >> 6] = thoseOf(world, whose, first, word);
      }
    }
  }
}

double Company::density(Voxel about, double radius_vx) const {
  return densityIn(those_, about - low_, radius_vx, kAsTheyAre);
}

std::optional<Voxel> Company::nearest(Voxel about, double radius_vx) const {
  const auto found = nearestIn(those_, about - low_, radius_vx, kAsTheyAre);
  return found ? std::optional(*found + low_) : std::nullopt;
}

double heightAbove(const World& world, const Whose& whose, Vec3 at_vx) {
  Voxel v = voxelAt(at_vx);
  const Voxel own = v;
  while (v.y >= 0 && !(v != own && world.occupied().at(v) && thoseOf(world, whose, v, 1) != 0)) --v.y;
  return std::max(0.0, at_vx.y - (v.y + 0.5));
}

}  // namespace espalier::sim
