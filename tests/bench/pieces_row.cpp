#include <fmt/format.h>

#include <cmath>

#include "scenes/import/mesh_import.h"
#include "sim/cut/pieces.h"
#include "tests/bench/rows.h"

namespace espalier::bench {
namespace {

constexpr const char* kPiecesRow = "13 cracks by voxels";

/// Crooked ways across what lies about the origin, side by side, from which sheets go straight down.
std::vector<sim::CutLine> crookedWays(double reach_m, double above_m) {
  std::vector<sim::CutLine> lines;
  for (const double aside : {-0.45, 0.0, 0.4}) {
    sim::Vec3 last(aside * reach_m, above_m, -2.0 * reach_m);
    for (int i = 1; i <= 24; ++i) {
      const double bend = (i % 2 == 0 ? 0.04 : -0.04) + (i % 3 == 0 ? 0.05 : 0.0);
      const sim::Vec3 next((aside + bend) * reach_m, above_m, (-2.0 + i / 6.0) * reach_m);
      lines.push_back({last, next});
      last = next;
    }
  }
  return lines;
}

}  // namespace

void benchPieces(Report& report) {
  report.title("13. A boulder cut by three crooked sheets, by the number of its voxels");
  const sim::Mesh boulder =
      scenes::importMesh(ESPALIER_SOURCE_DIR "/scenes/meshes/boulder.obj", scenes::RegionsFrom::group);
  const std::vector<sim::CutLine> lines = crookedWays(1.5, 2.0);
  for (const double voxel_m : {0.024, 0.016, 0.012, 0.008}) {
    sim::CutSettings settings;
    settings.voxel_m = voxel_m;
    settings.kerf_m = 0.05;  // the same question at each size
    settings.sweep_m = {0.0, -3.0, 0.0};
    sim::Pieces cut;
    const double seconds = medianSeconds([&] { cut = sim::cutSolid(boulder, lines, settings); });
    double sum_m3 = 0.0;
    std::size_t triangles = 0;
    for (const sim::Piece& piece : cut.pieces) {
      sum_m3 += piece.volume_m3;
      triangles += piece.mesh.triangles.size();
    }
    report.note(fmt::format("  {} voxels: {} pieces, {} triangles, {:.2f} % of the solid's volume",
                            cut.voxels, cut.pieces.size(), triangles, 100.0 * sum_m3 / cut.solid_m3));
    report.add({kPiecesRow, "    all of it", seconds, "s"});
    report.add({kPiecesRow, "    for a million voxels of the solid",
                1e6 * seconds / static_cast<double>(cut.voxels), "s"});
  }
}

}  // namespace espalier::bench
