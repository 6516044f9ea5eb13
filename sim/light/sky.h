#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "sim/sweep/directions.h"

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

/// What a receiver with this unit normal gets from the whole sky where nothing stands in the way, as a part
/// of what level ground gets: 1 for uniform; (1 + n.y) / 2 for cosine, so 1/2 for a wall; 0.396 for a wall
/// under the overcast sky.
double unobstructed(Weighting weighting, Vec3 normal);

inline constexpr int kMostSkyDirections = 4096;

struct SkySettings {
  Weighting weighting = Weighting::uniform;
  double standard_error = 0.005;  ///< of sky_exposure, wanted; says how many directions are used
  std::optional<int> directions = std::nullopt;  ///< or this many, up to kMostSkyDirections
};

/// The sky as a set of directions, evenly spread.
///
/// The weights are shares of the hemisphere's solid angle and add up to kWhole. From 16 directions on, the
/// sums of share * d and of share * d.y^2 are (0, 1/2, 0) and 1/3 to within 1e-5, less than a unit of a
/// weight: what an unobstructed sky gives to level ground is exact for each weighting.
struct Sky {
  Weighting weighting = Weighting::uniform;
  DirectionSet directions;
  double standard_error = 0.0;  ///< of sky_exposure, expected from this number of directions
};

/// The standard error of sky_exposure with so many directions: the law measured over streets, courts, corners
/// and towns of boxes (tests/sim/light/sky_law_test.cpp).
double skyError(Weighting weighting, int directions);

/// The fewest directions that keep a standard error, rounded up to 32. Throws InputError for one that would
/// need more than kMostSkyDirections.
int directionsFor(Weighting weighting, double standard_error);

/// Throws InputError for settings that make no sky.
Sky makeSky(const SkySettings& settings);

/// The sky's directions weighted by what a receiver with this normal gets from each of them; for free space,
/// which has no normal, as level ground receives it. The weights add up to what unobstructed() says, of
/// kWhole.
DirectionSet receivedBy(const Sky& sky, Vec3 normal = Vec3(0, 1, 0));

/// For legends, reports and metadata: "cosine-weighted view factor, 256 directions, standard error 0.004".
std::string describe(const Sky& sky);

}  // namespace espalier::sim
