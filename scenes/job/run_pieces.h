#pragma once
#include <string>
#include <vector>

#include "scenes/job/pieces_shown.h"
#include "scenes/job/report.h"
#include "scenes/job/run.h"
#include "scenes/job/stages.h"
#include "scenes/made/pieces_made.h"
#include "scenes/write/output_folder.h"

/// Pieces of a scene's meshes in a run.
namespace espalier::scenes {

/// The files' names.
std::vector<std::string> piecesFileNames(const Scene& scene);

struct RunPieces {
  std::vector<PiecesMade> made;
  std::vector<ShownPieces> shown;  ///< where pictures show them
};

/// Cuts what the scene asks for, in a stage of its own. `images`: those that are drawn. Tells the report of
/// it, and `late_warnings`. Throws PlacedError.
RunPieces cutPieces(const Scene& scene, const Site& site, const sim::Growth& growth,
                    const std::vector<ImageSpec>& images, const RunOptions& options, Report& report,
                    Stages& stages, std::vector<std::string>& late_warnings);

/// NAME.glb of each: a node for each piece. Borrows both.
void addPiecesFiles(const RunPieces& pieces, const sim::Provenance& made_by, std::vector<OutputFile>& files);

/// One line each, for people.
std::string piecesText(const std::vector<Report::Pieces>& pieces);

}  // namespace espalier::scenes
