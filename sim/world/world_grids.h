#pragma once
// Heavy: openvdb.h. Include from the few .cpp files that need the grids themselves.
#include <openvdb/openvdb.h>

#include "sim/world/block_map.h"
#include "sim/world/plant_voxels.h"
#include "sim/world/world.h"

namespace espalier::sim {

inline openvdb::Coord coordOf(Voxel v) {
  return {v.x, v.y, v.z};
}

/// The truth of the world: the scene's surfaces and the boundary layers in grids, the plants' voxels beside
/// them. All grids share one transform, with voxel (0,0,0) at the frame's origin.
struct World::Grids {
  openvdb::Int32Grid::Ptr part;          ///< active where the scene is; background kFree
  openvdb::Vec3SGrid::Ptr colour;        ///< active where the scene is
  openvdb::FloatGrid::Ptr coverage;      ///< active where the scene is
  openvdb::Vec3SGrid::Ptr normal;        ///< active where the scene is
  openvdb::FloatGrid::Ptr offset_vx;     ///< active where the scene is
  openvdb::Int32Grid::Ptr guide;         ///< part of the guide; active where one is; background kFree
  openvdb::Vec3SGrid::Ptr guide_normal;  ///< of the guide, likewise
  openvdb::Int32Grid::Ptr layer;    ///< active within the boundary layers, 0 on the objects; background -1
  openvdb::Int32Grid::Ptr nearest;  ///< part of the nearest scene object, same topology as layer
  openvdb::FloatGrid::Ptr distance_vx;  ///< distance to it, same topology as layer; background infinity

  /// The same data by block. Leaves are never removed but by setLayers, which makes `near` anew.
  struct SurfaceLeaves {
    openvdb::Int32Tree::LeafNodeType* part = nullptr;
    openvdb::Vec3STree::LeafNodeType* colour = nullptr;
    openvdb::FloatTree::LeafNodeType* coverage = nullptr;
    openvdb::Vec3STree::LeafNodeType* normal = nullptr;
    openvdb::FloatTree::LeafNodeType* offset_vx = nullptr;
  };
  struct NearLeaves {
    const std::int32_t* layer = nullptr;
    const std::int32_t* nearest = nullptr;
    const float* distance_vx = nullptr;
  };
  /// The boundary layers by block, and NearSteps' own arrays.
  struct Near {
    explicit Near(Voxel size);
    void add(Voxel v, const NearLeaves& block_leaves);
    /// Fills in the steps, once all blocks are added.
    void findSteps(int layers);
    const NearLeaves& of(Voxel v) const { return leaves[block[blockNumber(blocks, v)] / kInBlock]; }

    static constexpr std::uint32_t kInBlock = 512;
    Voxel blocks;
    std::vector<std::uint32_t> block;  ///< where its steps begin, kInBlock for each of the leaves
    std::vector<NearLeaves> leaves;    ///< the first: where nothing is near
    std::vector<std::uint16_t> steps;
  };
  BlockMap<SurfaceLeaves> surface;
  Near near;
  PlantVoxels plants;
};

}  // namespace espalier::sim
