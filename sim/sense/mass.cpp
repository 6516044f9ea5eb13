#include "sim/sense/mass.h"

#include "sim/sense/ball.h"

namespace espalier::sim {

std::optional<Vec3> centreOfMass(const BitVolume& occupied, Voxel about, double radius_vx) {
  MassOfBall mass(about);
  forEachWordOfBall(occupied, about, radius_vx,
                    [&](Voxel first, std::uint64_t word, int dy, int dz) { mass.add(first, word, dy, dz); });
  return mass.centre();
}

}  // namespace espalier::sim
