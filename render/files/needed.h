#pragma once
// Internal to the wing.
#include <cstdint>
#include <vector>

#include "render/files/surfaces.h"
#include "render/model/model_mesh.h"

namespace espalier::render {

/// What of a plant's mesh a glTF file needs.
struct Needed {
  bool normals = true, uvs = true;
  /// Of each vertex the one that stands for it, itself or one before; empty: each stands for itself.
  std::vector<std::uint32_t> first;

  std::uint32_t standsFor(std::uint32_t vertex) const { return first.empty() ? vertex : first[vertex]; }
};

/// Not needed are UVs of stems on which no picture lies; those of stalks, and their normals; normals of
/// blades that are the facets' own, which glTF has readers compute. One vertex stands for all that then
/// differ in nothing, at a point of stems or within a blade.
Needed neededOf(const ModelMesh& mesh, PlantSurface kind);

}  // namespace espalier::render
