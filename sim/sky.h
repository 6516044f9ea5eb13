#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "sim/directions.h"

namespace espalier::sim {

/// How the parts of the sky count. Named wherever an exposure is shown: they differ by up to 60 % at one
/// place.
enum class Weighting {
  uniform,      ///< by solid angle: every part alike (Greene's own); all of the sky is 1
  cosine,       ///< times the cosine with the receiver's normal: the view factor; 1 for open level ground
  cie_overcast  ///< times the luminance (1 + 2 sin elevation) / 3 too; 1 for open level ground
};
std::string_view nameOf(Weighting weighting);
/// "uniform by solid angle", "cosine-weighted view factor", "CIE overcast sky".
std::string_view describe(Weighting weighting);

/// What a direction gives to a receiver with this unit normal for each share of the hemisphere that it stands
/// for: 1 for uniform; 2 n.d for cosine; 6/7 n.d (1 + 2 d.y) for the overcast sky. 0 from behind the
/// receiver.
double received(Weighting weighting, Vec3 direction, Vec3 normal);

struct SkySettings {
  Weighting weighting = Weighting::uniform;
  double standard_error = 0.005;  ///< of sky_exposure, wanted; says how many directions are used
  std::optional<int> directions;  ///< or this many
};

/// The sky as a set of directions.
struct Sky {
  Weighting weighting = Weighting::uniform;
  DirectionSet directions;      ///< weights are shares of the hemisphere's solid angle, adding up to kWhole
  double standard_error = 0.0;  ///< of sky_exposure, expected from this number of directions
};

/// Throws InputError for settings that make no sky.
Sky makeSky(const SkySettings& settings);

/// The sky's directions weighted by what a receiver with this normal gets from each of them; for free space,
/// which has no normal, as level ground receives it. The weights of open ground add up to kWhole.
DirectionSet receivedBy(const Sky& sky, Vec3 normal = Vec3(0, 1, 0));

/// For legends, reports and metadata: "cosine-weighted view factor, 256 directions, standard error 0.004".
std::string describe(const Sky& sky);

}  // namespace espalier::sim
