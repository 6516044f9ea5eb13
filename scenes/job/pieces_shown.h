#pragma once
#include <vector>

#include "scenes/made/pieces_made.h"
#include "scenes/prepare/site.h"
#include "scenes/scene.h"
#include "scenes/show/shown_pieces.h"

namespace espalier::scenes {

/// Whether an image shows pieces.
bool showsPieces(const ImageSpec& image);

/// The pieces as the images show them: once for each distance. Throws PlacedError where a world of them does
/// not fit into memory.
std::vector<ShownPieces> shownPieces(const Scene& scene, const Site& site,
                                     const std::vector<PiecesMade>& made,
                                     const std::vector<ImageSpec>& images);

}  // namespace espalier::scenes
