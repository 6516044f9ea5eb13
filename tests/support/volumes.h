#pragma once
#include <openvdb/openvdb.h>

#include <filesystem>
#include <functional>
#include <string>

#include "sim/base/vec.h"

/// Volumes for what reads them.
namespace espalier::tests {

/// A grid of vectors, active in size voxels from `low` on, in cubes of `voxel_m` from the origin on.
template <class Grid = openvdb::Vec3SGrid>
typename Grid::Ptr vectorGrid(const std::string& name, double voxel_m, sim::Voxel low, sim::Voxel size,
                              const std::function<sim::Vec3(sim::Vec3 at_m)>& vector) {
  openvdb::initialize();
  auto grid = Grid::create();
  grid->setName(name);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel_m));
  for (int x = low.x; x < low.x + size.x; ++x) {
    for (int y = low.y; y < low.y + size.y; ++y) {
      for (int z = low.z; z < low.z + size.z; ++z) {
        const sim::Vec3 v = vector(voxel_m * sim::Vec3(x, y, z));
        grid->tree().setValueOn({x, y, z}, typename Grid::ValueType(openvdb::Vec3d(v.x, v.y, v.z)));
      }
    }
  }
  return grid;
}

inline void writeVolume(const std::filesystem::path& path, const openvdb::GridCPtrVec& grids) {
  openvdb::io::File file(path.string());
  file.write(grids);
  file.close();
}

}  // namespace espalier::tests
