#pragma once
#include <string>
#include <vector>

#include "render/image/colour_map.h"
#include "render/image/image.h"

/// Legends drawn into the lower left corner of pictures of display values, on a translucent plate. Their size
/// follows the picture's.
namespace espalier::render {

/// A bar of colours with ticks from 0 to the greatest value.
struct BarLegend {
  std::string title;   ///< what is shown: "sky exposure"
  std::string note;    ///< how it was weighed: "fraction of the sky seen, solid-angle weighted"; lines by \n
  float most = 1.0f;   ///< what the bar's end stands for; > 0
  float step = 0.25f;  ///< from tick to tick; > 0
};
void drawLegend(Image& image, const BarLegend& legend, const ColourMap& colours);

struct Swatch {
  sim::Colour colour;  ///< display values
  std::string label;
};
/// Patches of colour with a label each.
struct SwatchLegend {
  std::string title;
  std::string note;
  std::vector<Swatch> swatches;
};
void drawLegend(Image& image, const SwatchLegend& legend);

}  // namespace espalier::render
