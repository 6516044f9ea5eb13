#pragma once
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/import/facing.h"
#include "scenes/import/skeleton_forest.h"
#include "scenes/prepare/fields.h"
#include "scenes/problem.h"
#include "scenes/scene.h"
#include "sim/light/background.h"
#include "sim/scatter/picture_points.h"
#include "sim/tile/build_world.h"

namespace espalier::scenes {

/// A mesh that the scene calls optional is not there, so that the scene is skipped, which is no failure.
class MeshMissing : public std::runtime_error {
 public:
  MeshMissing(const Scene& scene, const SceneMesh& mesh);
  /// For a warning.
  const Problem& problem() const { return problem_; }

 private:
  Problem problem_;
};

/// What the files hold that a scene names, as placed. It hangs on nothing that the scene says of voxels.
struct SiteFiles {
  std::vector<sim::TiledMesh> meshes;  ///< world metres
  std::vector<sim::Mesh> shapes;       ///< placed likewise, but no part of the world: for attractors
  std::vector<std::vector<sim::Vec3>> listed_m;  ///< what tables of points list, as forEachTable has them
  std::vector<std::vector<FileTree>> skeletons;  ///< of each of the scene's plants, placed: in metres
  std::vector<std::optional<sim::DensityPicture>> densities;  ///< of each of the scene's attractors
  std::vector<FieldVolume> fields;                            ///< of each of the scene's fields
  std::optional<sim::SkyPicture> sky_picture;                 ///< of its sky's background
  std::vector<FacingReport> facings;                          ///< of meshes with triangles that were turned
  std::vector<sim::InputFile>
      mesh_files;  ///< what meshes, points, skeletons and volumes were read from, each once
  std::vector<std::filesystem::path> mesh_paths;  ///< where those are
  std::vector<Problem> warnings;                  ///< of what mesh files name and have not, and of fields
};

/// Reads all of a scene's files but its rules. Throws PlacedError with what is wrong with any of them;
/// MeshMissing.
SiteFiles readSiteFiles(const Scene& scene);

/// The same with meshes that were read and placed before, in the scene's order. What they were read from is
/// not noted.
SiteFiles readSiteFiles(const Scene& scene, std::vector<sim::Mesh> placed);

}  // namespace espalier::scenes
