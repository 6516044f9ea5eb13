#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "rules/language/rule_set.h"
#include "sim/grow/process.h"

/// The surfaces of the scene's meshes as senses of `surfaces` find them: exactly, and those of guides too.
/// They lie in the commons, as the scene's lines do.
namespace espalier::rules {

inline constexpr const char* kSceneSurfaces = "surfaces";  ///< in sim::Commons

/// By its corners, voxel space.
using TriangleCorners = std::array<sim::Vec3, 3>;
/// In boxes of near ones, so that a site looks at few of many.
sim::Columns columnsOf(std::span<const TriangleCorners> triangles_vx);

/// Those near a place.
class SurfacesNear {
 public:
  /// All that come nearer to it than `reach_vx`; none where the commons know of none.
  SurfacesNear(const sim::Commons& commons, sim::Vec3 about_vx, double reach_vx);

  /// The point of them that is nearest, if it is nearer than `within_vx`; of triangles that are equally near
  /// always the same one's.
  std::optional<sim::Vec3> nearest(sim::Vec3 at_vx, double within_vx) const;

 private:
  std::vector<TriangleCorners> triangles_;
};

}  // namespace espalier::rules
