#pragma once
#include <optional>
#include <vector>

#include "rules/growth/laid_kinds.h"
#include "sim/grow/process.h"

/// Whether something has room beside what lies there already.
namespace espalier::rules {

// Feet that are nearer than this stand in one place, voxel widths; so that what crosses everything has an
// end.
inline constexpr double kOnePlace_vx = 0.2;

/// What a site of diffusion knows of where it is: the same for all of its rule sets.
struct LayingSite {
  Stance stance;                               ///< of the one that lies there, or of where a seed is
  const sim::PlacedElement* beside = nullptr;  ///< null at a seed
  const LaidKind* beside_kind = nullptr;
  const Ground* ground = nullptr;
  const std::vector<LaidKind>* kinds = nullptr;  ///< of the plant's shapes
};

/// An element that is to be laid.
struct Scaled {
  const LaidKind& kind;
  double scale = 1.0;

  Outline outline() const;
};

/// Where it is tried in the plane of its site.
struct LaidWay {
  glm::dvec2 by{0.0};
  glm::dvec2 turn{1.0, 0.0};  ///< from the site's +y
};

/// What lies and stands about a place. All that it is given must outlive it.
class LaidRoom {
 public:
  LaidRoom(const sim::SiteView& view, const LayingSite& site, const Diffusion& diffusion)
      : view_(view), site_(site), diffusion_(diffusion) {}

  /// Sees neighbours and obstacles within reach of a stance from above it; of surfaces that do not go on from
  /// there those that rise into the layer from `low_vx` to `high_vx` above its plane.
  void look(const Stance& here, double reach_vx, double low_vx, double high_vx);
  /// Neighbours, then obstacles, about that stance.
  const std::vector<Outline>& outlines() const { return outlines_; }

  /// Why an element cannot lie in the plane of that stance for its neighbours' or obstacles' sake; a seed's
  /// needs no neighbour.
  std::optional<sim::Outcome> hinders(const Scaled& element, const LaidWay& way, bool seed) const;
  /// Where it comes to lie on the surface; nothing where that is not there, or bends away beneath it. `up`:
  /// its +y goes up the slope before it is turned.
  std::optional<Stance> settle(const Scaled& element, const LaidWay& way, bool up) const;
  /// Whether it keeps the gap where it comes to lie, which on a bent surface is not quite where it was wanted
  /// (`as_wanted`: it is). There, seen askew, four fifths of the gap will do.
  bool keepsApart(const Scaled& element, const Stance& stance, bool as_wanted) const;
  /// Whether it crosses nothing, exactly; and then finds the voxels that it takes.
  bool fits(sim::ProposedElement& laid, const Stance& stance) const;

 private:
  Stance evened(const Scaled& element, const Stance& stance) const;
  void takeVoxels(sim::ProposedElement& laid, const sim::Facets& facets) const;

  const sim::SiteView& view_;
  const LayingSite& site_;
  const Diffusion& diffusion_;
  std::vector<Outline> outlines_;
  std::vector<const sim::PlacedElement*> neighbours_;
};

}  // namespace espalier::rules
