#pragma once
#include <cstdint>
#include <vector>

#include "scenes/import/vector_grid.h"
#include "scenes/problem.h"
#include "scenes/scene.h"
#include "sim/base/frame.h"
#include "sim/base/provenance.h"
#include "sim/scatter/inside_points.h"

namespace espalier::scenes {

struct Site;

/// What a guide field takes from files: of each the one that it asks for.
struct FieldVolume {
  VectorLattice grid;  ///< its axis
  sim::Frame region;   ///< of the cubes that may lie inside its mesh; of size 0 where it names none
  std::vector<std::int64_t> inside;  ///< which do: as rules::GuideRegion has them
};

/// Reads the volumes of a scene's fields; `files` takes what was read, `warnings` where a grid is held more
/// coarsely than its file has it. Throws sim::InputError with the place in the scene's file.
std::vector<FieldVolume> readFieldGrids(const Scene& scene, std::vector<sim::InputFile>& files,
                                        std::vector<Problem>& warnings);

/// Finds the insides of the meshes within which a site's fields hold; its warnings take how doubtful one is.
/// Throws likewise, for a mesh without an inside.
void findRegions(const Scene& scene, Site& site);

/// A scene's field as growth has it: its lengths in voxel widths. Borrows the volume.
rules::Guide guideOf(const FieldSpec& field, const FieldVolume& volume, const sim::Frame& frame);

}  // namespace espalier::scenes
