#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/light/lighting.h"
#include "sim/light/sky.h"

/// Light that bounces from surface to surface: radiosity by passes over the voxels (Greene 1989, section 5).
/// On the first pass rays that meet something bring nothing; on each later one they bring the radiosity of
/// what they meet. Radiosities are those of a Lighting's receivers: its surfaces, then the faces that are
/// judged by themselves.
///
/// What a surface meets and what it sees of the open sky add up to the whole half-space before it, so a pass
/// never makes light: what it brings is a mean of radiosities, times the share of the half-space that is
/// taken by what is met.
namespace espalier::sim {

inline constexpr int kMostPasses = 1000;

struct BounceSettings {
  int directions = 128;      ///< over each half of the sphere, above the horizon and below
  int passes = 8;            ///< at most, the first included; 1 to kMostPasses
  double tolerance = 0.002;  ///< ends when no radiosity changes by more, in parts of the largest; 0: never
  /// By the cosine with the receiver's normal (Lambert), or all directions before it alike, as Greene had
  /// them.
  bool lambert = true;
  bool overcast = false;  ///< the sky brightens towards the zenith (CIE), else all of it is alike
  std::size_t most_bytes = std::size_t{1} << 30;  ///< for what rays meet, which later passes need again: else
                                                  ///< it is found anew in each, with the same answer
};

/// What each receiver has of its own, linear. Light is what falls onto a surface, as it would look if that
/// was white; radiosity is what the surface sends on, emitted or reflected.
struct BounceSources {
  Colour sky{1.0f};             ///< light of the whole sky on level ground
  Colour below{0.0f};           ///< light of rays that leave the world below the horizon, if all of them did
  std::vector<Colour> sun;      ///< light of the sun
  std::vector<Colour> albedo;   ///< 0..1
  std::vector<Colour> emitted;  ///< radiosity of its own; empty: nothing shines
};

/// Light of every receiver.
struct Bounced {
  std::vector<float> sky;      ///< share of the sky's light, 0..1
  std::vector<float> below;    ///< share of the half-space before it that leaves the world below the horizon
  std::vector<float> covered;  ///< share of it in which something is met; none where it has no free place
  std::vector<Colour> light;   ///< that comes from what is met
  int passes = 0;              ///< that were made
  double change = 0.0;         ///< of the last, as settings.tolerance has it
};

/// A world made ready for light that bounces: what its receivers see of the sky and of each other.
class Interreflection {
 public:
  /// Throws InputError for settings that make no sense. Borrows the light.
  Interreflection(const World& world, const Lighting& light, const BounceSettings& settings);
  ~Interreflection();

  /// `sources` are of the light's receivers. Throws InputError for those that make no sense.
  Bounced of(const BounceSources& sources);

 private:
  class Seen;
  std::unique_ptr<Seen> seen_;
};

/// The radiosity of a receiver.
inline Colour radiosity(const BounceSources& sources, const Bounced& bounced, std::size_t receiver) {
  const Colour own = sources.emitted.empty() ? Colour(0.0f) : sources.emitted[receiver];
  return own + sources.albedo[receiver] *
                   (bounced.sky[receiver] * sources.sky + bounced.below[receiver] * sources.below +
                    sources.sun[receiver] + bounced.light[receiver]);
}

}  // namespace espalier::sim
