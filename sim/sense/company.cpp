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

/// The bit nearest to a place of -63 to 126; of two the lower. The word is not 0.
int nearestBit(std::uint64_t word, int place) {
  const std::uint64_t up_to = place < 0 ? 0 : place >= 63 ? word : word & ((std::uint64_t{2} << place) - 1);
  const std::uint64_t beyond = word & ~up_to;
  if (up_to == 0) return std::countr_zero(beyond);
  const int before = 63 - std::countl_zero(up_to);
  if (beyond == 0) return before;
  const int behind = std::countr_zero(beyond);
  return place - before <= behind - place ? before : behind;
}

/// The bits that are so far from a place at most.
std::uint64_t bitsAbout(int place, int far) {
  const int low = place - far, high = place + far;
  if (low > 63 || high < 0) return 0;
  std::uint64_t bits = ~std::uint64_t{0};
  if (low > 0) bits &= ~std::uint64_t{0} << low;
  if (high < 63) bits &= ~std::uint64_t{0} >> (63 - high);
  return bits;
}

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
  std::int64_t count = 0;
  forEachWordOfBall(world.occupied(), about, radius_vx, [&](Voxel first, std::uint64_t word, int, int) {
    count += bitCount(thoseOf(world, whose, first, word));
  });
  return static_cast<double>(count) / static_cast<double>(ballOf(radius_vx).voxels);
}

Crowd crowdAround(const World& world, const Whose& whose, Voxel about, double radius_vx) {
  MassOfBall mass(about);
  forEachWordOfBall(world.occupied(), about, radius_vx, [&](Voxel first, std::uint64_t word, int dy, int dz) {
    mass.add(first, thoseOf(world, whose, first, word), dy, dz);
  });
  const auto all = static_cast<double>(ballOf(radius_vx).voxels);
  return {static_cast<double>(mass.count()) / all, mass.centre()};
}

namespace {

std::optional<Voxel> nearestWithin(const World& world, const Whose& whose, Voxel about, double radius_vx) {
  std::optional<Voxel> nearest;
  auto least = static_cast<double>(std::numeric_limits<int>::max());
  const auto before = [](Voxel a, Voxel b) { return std::tie(a.y, a.z, a.x) < std::tie(b.y, b.z, b.x); };
  forEachWordOfBall(world.occupied(), about, radius_vx, [&](Voxel first, std::uint64_t word, int dy, int dz) {
    const double off = static_cast<double>(dy * dy + dz * dz);
    if (off > least) return;
    const int place = about.x - first.x;
    if (nearest) word &= bitsAbout(place, rootBelow(least - off));
    const std::uint64_t those = thoseOf(world, whose, first, word);
    if (those == 0) return;
    Voxel v = first;
    v.x += nearestBit(those, place);
    const double dx = v.x - about.x, square = dx * dx + off;
    if (square > least || (square == least && !before(v, *nearest))) return;
    least = square;
    nearest = v;
  });
  return nearest;
}

}  // namespace

std::optional<Voxel> nearestOf(const World& world, const Whose& whose, Voxel about, double radius_vx) {
  constexpr double kFirst = 5.0;  // a ball of the double radius has eight times the voxels
  for (double radius = kFirst; radius < radius_vx; radius *= 2.0) {
    if (const auto nearest = nearestWithin(world, whose, about, radius)) return nearest;
  }
  return nearestWithin(world, whose, about, radius_vx);
}

double heightAbove(const World& world, const Whose& whose, Vec3 at_vx) {
  Voxel v = voxelAt(at_vx);
  const Voxel own = v;
  while (v.y >= 0 && !(v != own && world.occupied().at(v) && thoseOf(world, whose, v, 1) != 0)) --v.y;
  return std::max(0.0, at_vx.y - (v.y + 0.5));
}

}  // namespace espalier::sim
