#pragma once
#include <optional>
#include <string>

#include "sim/base/bits.h"
#include "sim/world/world.h"

/// What stands around a place, told apart by whose it is: Greene's statistics of the local environment, such
/// as the density of a certain object within a certain radius (Voxel Space Automata, 1989, section 3).
namespace espalier::sim {

/// Whose voxels are asked for.
struct Whose {
  enum class Kind { everything, scene, plants, own, others, region };
  Kind kind = Kind::everything;
  int plant = -1;           ///< own: this plant's number; others: all plants but it
  std::string region = {};  ///< of the scene
};

/// Of the voxels from `first` on along x that bits of `among` name (bit i: i voxels on), those asked for. All
/// of them must be occupied.
std::uint64_t thoseOf(const World& world, const Whose& whose, Voxel first, std::uint64_t among);

/// Those in a ball about a voxel.
struct Crowd {
  double density = 0.0;             ///< their share of the ball's voxels, those beyond the world too; 0..1
  std::optional<Vec3> centre = {};  ///< of mass, voxel space; nothing where there are none
};
/// Its density alone, which is quicker.
double densityAround(const World& world, const Whose& whose, Voxel about, double radius_vx);
Crowd crowdAround(const World& world, const Whose& whose, Voxel about, double radius_vx);

/// The nearest of them within a radius; of those that are equally near the first in (y, z, x) order.
std::optional<Voxel> nearestOf(const World& world, const Whose& whose, Voxel about, double radius_vx);

/// The voxels asked for about a place, gathered once to be asked about at many places near it.
class Company {
 public:
  /// All that lie within `reach_vx` of the place along each axis.
  Company(const World& world, const Whose& whose, Voxel about, int reach_vx);

  /// As densityAround and nearestOf have them, for places whose ball lies within the reach.
  double density(Voxel about, double radius_vx) const;
  std::optional<Voxel> nearest(Voxel about, double radius_vx) const;

 private:
  Voxel low_;
  BitVolume those_;
};

/// How far down it is from a place inside the world to the top of the first of their voxels straight below,
/// or to the world's floor; voxel widths, 0 at least.
double heightAbove(const World& world, const Whose& whose, Vec3 at_vx);

}  // namespace espalier::sim
