#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "render/model/leaf_picture.h"
#include "sim/base/vec.h"

/// Leaves that the program draws itself, from curves, so that nobody needs a picture from elsewhere.
namespace espalier::render {

/// ovate, ivy, palmate, needles, branch, blossom: kinds that drawnLeaf knows.
const std::vector<std::string>& drawnKinds();

/// A leaf of that kind in a colour, linear RGB; drawn once for all who ask for the same. Throws InputError
/// for a kind that is none, and where OpenImageIO's module is missing.
std::shared_ptr<const LeafPicture> drawnLeaf(const std::string& kind, sim::Colour colour);

/// Which share of such a picture is blade.
double bladeShareOf(const std::string& kind);
double bladeShareOf(const LeafPicture& picture);

using Cards = std::vector<std::vector<sim::Vec3>>;
/// Polygons that hold such a picture, 1 long (see sim::ElementShape): near its outline, so that not much is
/// cut away; blades folded a little along the middle, sprays as two cards that cross, flowers about their
/// middle.
Cards cardsOf(const std::string& kind);
/// For a picture of that size, in pixels: a card folded a little along the middle.
Cards cardsOf(int width_px, int height_px);

}  // namespace espalier::render
