#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "render/colour_map.h"
#include "render/image.h"
#include "render/tone.h"
#include "render/visibility.h"
#include "sim/field.h"

/// The six panels of Greene 1989, figure 6: what light does in a world of voxels, each cube drawn as it
/// stands.
namespace espalier::render {

enum class Panel { sun_exposure, sky_exposure, threshold, shadow_matte, surface_colour, first_pass };

/// What the panels need to know of a world. `colour` may be called by several threads at once.
struct PanelWorld {
  const sim::BitVolume& occupied;
  const sim::Bricks& bricks;
  const sim::ExposureField& sun;
  const sim::ExposureField& sky;
  std::function<sim::Colour(sim::Voxel)> colour;  ///< linear, of an occupied voxel
};

struct PanelLook {
  float blend_sun = 0.8f, blend_sky = 0.2f;  ///< of exposure
  float threshold = 0.3f;                    ///< least exposure at which the plant lives
  sim::Vec3 to_sun{0.0, 1.0, 0.0};           ///< unit; the sun of the shadow matte and of the first pass
  std::string sun_map = "magma";
  std::string sky_map = "viridis";
  ToneCurve tone;  ///< of the first pass
};

struct PanelPicture {
  Image display;   ///< RGB display values, for the eye
  Image measured;  ///< pure values, for measuring: no shading, no smoothing
  /// Of `measured`. Fields: the panel's value as the mean over what a pixel shows of the world, 0 where it
  /// shows sky alone, then "coverage", the pixel's share that is not sky. Colours: R, G, B, premultiplied by
  /// A.
  std::vector<std::string> channel_names;
};

/// Shades what a camera sees. The exposure shown on a face is that of the free voxel in front of it.
class PanelPainter {
 public:
  /// Prepares what these panels need. What is given must outlive the painter.
  PanelPainter(const Visibility& seen, const PanelWorld& world, PanelLook look,
               std::span<const Panel> panels);
  /// One of the panels named to the constructor.
  PanelPicture paint(Panel panel) const;

 private:
  const Visibility& seen_;
  PanelLook look_;
  std::vector<float> relief_;  ///< how bright a cube's face is drawn; for each fragment, as all that follows
  std::vector<float> pure_sun_, pure_sky_;
  std::vector<float> sun_, sky_;  ///< smoothed over faces side by side
  std::vector<float> lit_;
  std::vector<sim::Colour> colour_;
};

/// The two colours of the threshold panel, display values, for its legend.
struct ThresholdColours {
  sim::Colour above, below;
};
ThresholdColours thresholdColours();

/// The sky behind pictures in colour, linear light, in a direction of unit length.
sim::Colour skyColour(sim::Vec3 direction);

}  // namespace espalier::render
