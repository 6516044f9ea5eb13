#pragma once
#include <memory>
#include <vector>

#include "render/files/vdb.h"
#include "scenes/show/shown_field.h"
#include "sim/base/voxel_set.h"
#include "sim/world/world.h"

namespace espalier::scenes {

/// Guide fields as grids for render::writeVdb.
struct GuideVolumes {
  std::shared_ptr<const sim::VoxelSet> near;  ///< the voxels that know of them, of every field
  std::vector<render::VdbField> fields;       ///< "field NAME": s X_f, along the world's axes
};

/// The most voxels that are written of each, but for those that hold attractors themselves.
inline constexpr std::size_t kMostGuideVoxels = 1'000'000;

/// Those of the fields that bend somebody, around the attractors of the fronts that they bend: up to three
/// voxels from each, or fewer where these would be more than kMostGuideVoxels. Borrows the growth. Throws
/// sim::InputError as ShownField does.
GuideVolumes guideVolumes(const sim::Growth& growth, const std::vector<UsedField>& fields,
                          const sim::World& world);

}  // namespace espalier::scenes
