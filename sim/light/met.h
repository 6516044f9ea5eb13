#pragma once
#include <cstdint>
#include <vector>

#include "sim/light/lighting.h"
#include "sim/light/surface.h"
#include "sim/sweep/carried.h"

// Internal to the room: what rays meet, told as numbers of the receivers of a Lighting (its surfaces, then
// the faces that are judged by themselves).
namespace espalier::sim {

/// What takes light in a world and is not buried, each face with the number of the receiver that it shows.
Stops<std::uint32_t> receiversMet(const World& world, const Lighting& light);

/// What each receiver meets along each of some directions.
struct Met {
  std::size_t directions = 0;
  std::vector<std::uint32_t> numbers;  ///< receiver by receiver; the number of all receivers where nothing is

  const std::uint32_t* by(std::size_t receiver) const { return numbers.data() + receiver * directions; }
};

/// The receivers of a Lighting with the places from which they are judged (sim/light/surface.h).
SurfaceSensors sensorsOf(const World& world, const Lighting& light);

/// Where each receiver looks from; (-1, -1, -1) where it has no free place before it.
std::vector<Voxel> viewpoints(const SurfaceSensors& sensors);

/// For each viewpoint what lies where its ray ends. The stairs of a slanting surface show rays their risers,
/// which the surface itself does not: what turns its back to a ray is not met. `stops`: of receiversMet.
Met meet(const Stops<std::uint32_t>& stops, const SurfaceSensors& sensors,
         const std::vector<Voxel>& viewpoints, const DirectionSet& directions, std::size_t first,
         std::size_t count);

}  // namespace espalier::sim
