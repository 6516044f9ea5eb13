#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/bits.h"
#include "sim/sweep/directions.h"
#include "sim/tile/mesh.h"

/// Others who answer the same question, each at its best: which of these directions reach the world's edge
/// from the centres of these voxels?
namespace espalier::bench {

struct Question {
  const sim::DirectionSet& directions;
  std::vector<sim::Voxel> places;  ///< free voxels

  double rays() const { return static_cast<double>(places.size()) * static_cast<double>(directions.size()); }
};

/// Sums of the weights of the directions that reach the edge, as sim::ExposureField has them.
using Sums = std::vector<std::uint16_t>;

class Peer {
 public:
  virtual ~Peer() = default;
  virtual std::string name() const = 0;
  /// On as many threads as a loop may use here (sim/base/parallel.h).
  virtual Sums answer(const Question& question) const = 0;
};

using Peers = std::vector<std::unique_ptr<Peer>>;

/// Embree's occlusion rays: single, in packets and in streams, with one origin or one direction to a packet;
/// on the faces of the occupied voxels (each on its own, or neighbours joined into rectangles), and on the
/// triangles from which they were tiled, given in voxel space.
Peers embreePeers(const sim::BitVolume& occupied, const std::vector<sim::Mesh>& meshes_vx);

/// NanoVDB's hierarchical DDA over a mask grid: the library's own firstActive, and a walk with the same HDDA
/// that looks at every voxel.
Peers nanovdbPeers(const sim::BitVolume& occupied);
std::string vdbVersions();

/// Another grower on a wall: the IvyGen add-on of Blender, which judges one candidate a node. Nothing where
/// no `blender` with it is installed.
struct IvyGen {
  double nodes = 0.0, cpu_s = 0.0;
};
std::optional<IvyGen> ivyGenNodes();

}  // namespace espalier::bench
