#pragma once
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "rules/language/rule_set.h"
#include "sim/grow/process.h"

/// The scene's lines as senses of `lines` find them: exactly, where voxels tell places apart by a width at
/// best. They belong to the scene and to no plant, so they lie in the commons.
namespace espalier::rules {

inline constexpr const char* kSceneLines = "lines";  ///< in sim::Commons

/// From their ends, voxel space.
using LineEnds = std::pair<sim::Vec3, sim::Vec3>;
sim::Columns columnsOf(std::span<const LineEnds> lines_vx);

/// Those near a place.
class LinesNear {
 public:
  /// All that come nearer to it than `reach_vx`; none where the commons know of none.
  LinesNear(const sim::Commons& commons, sim::Vec3 about_vx, double reach_vx);

  /// The point of them that is nearest, if it is nearer than `within_vx`; of lines that are equally near that
  /// of the first.
  std::optional<sim::Vec3> nearest(sim::Vec3 at_vx, double within_vx) const;

 private:
  std::vector<LineEnds> lines_;
};

}  // namespace espalier::rules
