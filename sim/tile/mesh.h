#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/base/vec.h"

namespace espalier::sim {

struct Material {
  std::string name;
  Colour colour{0.6f};  ///< linear RGB base colour
};

/// A triangle mesh as a plain value. Nothing is assumed of it: real meshes are open, inside out and unwelded.
struct Mesh {
  std::string name;
  std::vector<Vec3> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into vertices_m, all in range
  std::vector<std::uint32_t> region;                    ///< per triangle: index into regions
  std::vector<std::uint32_t> material;                  ///< per triangle: index into materials
  std::vector<std::string> regions;                     ///< named parts that rules and scenes refer to
  std::vector<Material> materials;
  std::size_t degenerate_dropped = 0;  ///< zero-area triangles that the importer left out
};

/// A hash of all that a world could be made of: not the names of the mesh and its materials.
std::uint64_t contentHash(const Mesh& mesh);

}  // namespace espalier::sim
