#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "render/image/colour_map.h"
#include "render/image/image.h"
#include "render/image/tone.h"
#include "render/voxels/near_faces.h"
#include "render/voxels/visibility.h"

/// The six panels of Greene 1989, figure 6, and hours of sun: what light does in a world of voxels, each cube
/// drawn as it stands.
namespace espalier::render {

enum class Panel {
  sun_exposure,
  sky_exposure,
  threshold,
  shadow_matte,
  surface_colour,
  first_pass,
  sun_hours
};

/// What the panels need to know of a world. Several threads may ask at once. What no panel wanted may be left
/// out.
struct PanelWorld {
  const sim::BitVolume& occupied;
  const sim::Bricks& bricks;
  FaceValue sun;                                  ///< 0..1
  FaceValue sky;                                  ///< 0..1
  std::function<sim::Colour(sim::Voxel)> colour;  ///< linear, of an occupied voxel
  FaceValue sun_hours = {};
  /// All light on a face but the sun's own, linear, red, green and blue; without it the sky's alone.
  std::array<FaceValue, 3> ambient = {};
  std::function<sim::Colour(sim::Voxel)> emitted = {};  ///< what a voxel sends out by itself; none: nothing
};

/// The light that a plant asks for.
struct LightNeeds {
  float sun = 0.8f, sky = 0.2f;  ///< their shares of exposure, 1 together
  float least = 0.3f;            ///< exposure at which it still grows
  friend bool operator==(const LightNeeds&, const LightNeeds&) = default;
};

struct PanelLook {
  sim::Vec3 to_sun{0.0, 1.0, 0.0};  ///< unit; the sun of the shadow matte and of the first pass
  std::string sun_map = "magma";
  std::string sky_map = "viridis";
  std::string hours_map = "plasma";
  float most_hours = 12.0f;  ///< that the map's bright end stands for
  ToneCurve tone;            ///< of the first pass
};

struct PanelPicture {
  Image display;   ///< RGB display values, for the eye
  Image measured;  ///< pure values, for measuring: no shading, no smoothing
  /// Of `measured`. Fields: the panel's value as the mean over what a pixel shows of the world, 0 where it
  /// shows sky alone, then "coverage", the pixel's share that is not sky. Colours: R, G, B, premultiplied by
  /// A.
  std::vector<std::string> channel_names;
};

/// Shades what a camera sees.
class PanelPainter {
 public:
  /// Prepares what these panels need. What is given must outlive the painter.
  PanelPainter(const Visibility& seen, const PanelWorld& world, PanelLook look,
               std::span<const Panel> panels);
  /// One of the panels named to the constructor; a threshold is that of a plant with these needs.
  PanelPicture paint(Panel panel, const LightNeeds& needs = {}) const;

 private:
  const Visibility& seen_;
  PanelLook look_;
  // For each fragment, as all that follows: how many samples it is of, and with what sign: below 0 for sky.
  std::vector<std::int8_t> samples_;
  std::vector<float> relief_;  ///< how bright a cube's face is drawn
  struct Shown {
    std::vector<float> pure, smooth;  ///< as it is, and smoothed over faces side by side
  };
  Shown sun_, sky_, hours_;
  std::array<Shown, 3> ambient_;  ///< if it is given
  std::vector<float> lit_;
  std::vector<sim::Colour> colour_, emitted_;
};

/// The light of first passes: of the whole sky on level ground, and of the sun on what is square to it.
struct FirstPassLight {
  sim::Colour sky, sun;
};
FirstPassLight firstPassLight();

/// Light that a surface of a colour sends on, linear: Greene blends the shadow matte with sky_exposure to
/// approximate the light that falls on it, and mats its colour through that. `sky`: what it receives of the
/// sky, 0..1; `sun`: the share of it that the sun reaches, times the cosine of the angle at which it does.
sim::Colour firstPass(sim::Colour surface, float sky, float sun);

/// The two colours of the threshold panel, display values, for its legend.
struct ThresholdColours {
  sim::Colour above, below;
};
ThresholdColours thresholdColours();

/// The sky behind pictures in colour, linear light, in a direction of unit length.
sim::Colour skyColour(sim::Vec3 direction);

}  // namespace espalier::render
