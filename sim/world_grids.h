#pragma once
// Heavy: openvdb.h. Include from the few .cpp files that need the grids themselves.
#include <openvdb/openvdb.h>

#include "sim/world.h"

namespace espalier::sim {

/// The truth of the world. All grids share one transform, with voxel (0,0,0) at the frame's origin.
struct World::Grids {
  openvdb::Int32Grid::Ptr part;         ///< background kFree
  openvdb::Vec3SGrid::Ptr colour;       ///< active where occupied
  openvdb::FloatGrid::Ptr coverage;     ///< active where occupied
  openvdb::Vec3SGrid::Ptr normal;       ///< active where occupied
  openvdb::Int32Grid::Ptr layer;        ///< active within the boundary layers, 0 on the objects
  openvdb::Int32Grid::Ptr nearest;      ///< part of the nearest scene object, same topology as layer
  openvdb::FloatGrid::Ptr distance_vx;  ///< distance to it, same topology as layer
};

}  // namespace espalier::sim
