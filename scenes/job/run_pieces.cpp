#include "scenes/job/run_pieces.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/files/gltf.h"
#include "scenes/problem.h"
#include "sim/base/counted.h"

namespace espalier::scenes {
namespace {

std::string fileNameOf(const std::string& name) {
  return name + ".glb";
}

Report::Pieces reportOf(const PiecesMade& made) {
  Report::Pieces about{made.name,
                       made.of,
                       made.kerf_m,
                       made.voxel_m,
                       made.cut.voxels,
                       made.cut.solid_m3,
                       made.cut.crumbs,
                       made.cut.crumbs_m3,
                       {}};
  for (const sim::Piece& piece : made.cut.pieces)
    about.pieces.push_back({piece.mesh.name, piece.mesh.triangles.size(), piece.volume_m3, piece.middle_m});
  return about;
}

}  // namespace

std::vector<std::string> piecesFileNames(const Scene& scene) {
  std::vector<std::string> names;
  for (const PiecesSpec& spec : scene.pieces) names.push_back(fileNameOf(spec.name));
  return names;
}

RunPieces cutPieces(const Scene& scene, const Site& site, const sim::Growth& growth,
                    const std::vector<ImageSpec>& images, const RunOptions& options, Report& report,
                    Stages& stages, std::vector<std::string>& late_warnings) {
  RunPieces pieces;
  if (scene.pieces.empty()) return pieces;
  stages.run("cutting", [&] {
    std::vector<Problem> remarks;
    pieces.made = makePieces(scene, site, growth, remarks);
    for (const Problem& remark : remarks) {
      if (options.on_warning) options.on_warning(remark);
      report.warnings.push_back(remark.text);
      late_warnings.push_back(remark.text);
    }
    for (const PiecesMade& made : pieces.made) report.pieces.push_back(reportOf(made));
    if (options.pictures) pieces.shown = shownPieces(scene, site, pieces.made, images);
  });
  return pieces;
}

void addPiecesFiles(const RunPieces& pieces, const sim::Provenance& made_by, std::vector<OutputFile>& files) {
  for (const PiecesMade& made : pieces.made) {
    files.push_back({fileNameOf(made.name), [&made, &made_by](std::iostream& out) {
                       std::vector<const sim::Mesh*> meshes;
                       for (const sim::Piece& piece : made.cut.pieces) meshes.push_back(&piece.mesh);
                       render::writeGlb(
                           out, meshes, [](const auto&) {}, made_by);
                     }});
  }
}

std::string piecesText(const std::vector<Report::Pieces>& pieces) {
  std::string text;
  for (const Report::Pieces& one : pieces) {
    text += fmt::format("{}: {} of {}", inQuotes(one.name), sim::counted(one.pieces.size(), "piece"),
                        inQuotes(one.of));
    constexpr std::size_t kTold = 5;
    for (std::size_t i = 0; i < std::min(kTold, one.pieces.size()); ++i)
      text +=
          fmt::format("{} {:.1f} %", i == 0 ? ", of" : ",", 100.0 * one.pieces[i].volume_m3 / one.solid_m3);
    if (one.pieces.size() > kTold) text += " ..";
    text += " of its volume";
    if (one.crumbs > 0)
      text += fmt::format("; {} of {:.2g} % left out", sim::counted(one.crumbs, "crumb"),
                          100.0 * one.crumbs_m3 / one.solid_m3);
    text += "\n";
  }
  return text;
}

}  // namespace espalier::scenes
