#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "scenes/inspect/looks.h"
#include "scenes/inspect/surface.h"
#include "scenes/problem.h"
#include "scenes/scene.h"
#include "sim/tile/mesh.h"

namespace espalier::scenes {

/// What a mesh's file holds, and how it would stand in a scene.
struct Inspected {
  std::filesystem::path file;
  std::size_t triangles = 0, degenerate = 0;  ///< degenerate ones are left out of all else
  MeshShape shape;                            ///< in the file's own numbers
  UnitLooks unit;
  UpLooks up;
  std::size_t groups = 0;  ///< named ones; with none, materials stand in
  Surface surface;         ///< by the regions that `regions` makes
  RegionsFrom regions = RegionsFrom::group;
  std::vector<std::pair<std::string, double>> materials;  ///< with their areas, in the file's own numbers
  std::vector<Problem> warnings;                          ///< of reading it

  /// As the lines of a scene have it: metres, y up, near the origin, and regions by material where it has one
  /// group alone.
  SceneMesh line;
  sim::Vec3 low_m{0.0}, high_m{0.0};
  double from_origin_m =
      0.0;  ///< how far it lay where it is brought nearer (placement.translate_m); 0: it is not
};

/// A mesh that was read once, for all that is made of it.
struct Inspection {
  Inspected found;
  sim::Mesh placed;        ///< as `found.line` has it
  double reading_s = 0.0;  ///< what reading it took
};

/// Reads a mesh as scenes do (scenes/import/mesh_import.h), and looks at it. Throws sim::InputError,
/// also for one whose areas no number could hold.
Inspection inspectMesh(const std::filesystem::path& file);

}  // namespace espalier::scenes
