#pragma once
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/scatter/envelope.h"

/// Solids that points are strewn in, as files state them: of scenes (attractors) and of rules (a crown).
namespace espalier::rules {

/// The largest side that a solid may have, metres.
inline constexpr double kMostOfEnvelope_m = 1e5;
/// The most points that may be asked for.
inline constexpr double kMostPoints = 1e7;
/// How many there are where nothing is said.
inline constexpr int kUsualPoints = 500;

/// A surface of revolution as it was written.
struct ProfileSpec {
  std::vector<glm::dvec2> profile_m;  ///< [height, radius], four of them in what is sound
};

/// A solid: exactly one of these in what is sound. Metres.
struct EnvelopeSpec {
  std::optional<sim::Cone> cone;
  std::optional<sim::Dome> dome;
  std::optional<sim::Cylinder> cylinder;
  std::optional<sim::Sphere> sphere;
  std::optional<sim::Ellipsoid> ellipsoid;
  std::optional<sim::Box> box;
  std::optional<ProfileSpec> revolution;
};

/// How points are strewn in a solid.
struct StrewingSpec {
  std::optional<int> count;  ///< kUsualPoints
  sim::Spread spread = sim::Spread::volume;
  std::vector<glm::dvec2> density;  ///< [share of the height, density]
};

/// A crown that stands over each seed.
struct CrownSpec {
  EnvelopeSpec shape;
  double trunk_m = 0.0;  ///< from the seed up to the crown's foot; below 0 down
  StrewingSpec strewing;
};

/// The names of the solids that were stated: "cone".
std::vector<std::string> solidsIn(const EnvelopeSpec& spec);
/// The one that was stated, in its place. Throws BrokenContract where checkEnvelope would complain.
sim::Envelope envelopeOf(const EnvelopeSpec& spec, sim::Vec3 foot_m);
sim::Strewing strewingOf(const StrewingSpec& spec);

}  // namespace espalier::rules
