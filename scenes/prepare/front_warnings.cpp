#include "scenes/prepare/front_warnings.h"

#include <fmt/format.h>

#include <algorithm>

#include "rules/front/lengths.h"
#include "rules/growth/voxel_widths.h"

namespace espalier::scenes {
namespace {

/// How attractors lie, voxel widths.
struct Lie {
  double spacing = 0.0;  ///< from one to the next
  double extent = 0.0;   ///< the longest side of a box around all
};

Lie lieOf(const std::vector<sim::Vec3>& at_vx) {
  sim::Vec3 low(HUGE_VAL), high(-HUGE_VAL);
  for (const sim::Vec3& at : at_vx) {
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  const sim::Vec3 sides = high - low;
  return {rules::spacingOf(rules::sortedAttractors(at_vx)), std::max({sides.x, sides.y, sides.z})};
}

std::string metres(double length_vx, double voxel_m) {
  return fmt::format("{:.3g} m", length_vx * voxel_m);
}

/// What cannot work of one order's lengths, each with what would.
std::vector<std::string> troubles(const rules::Colonization& front, const Lie& lie, double voxel_m) {
  const rules::FrontLengths suitable = rules::suitableLengths(lie.spacing);
  const auto length = [&](const std::optional<rules::Distance>& given, double otherwise) {
    return given ? rules::widths(*given, voxel_m) : otherwise;
  };
  const double step = length(front.step, suitable.step), kill = length(front.kill, suitable.kill),
               influence = length(front.influence, suitable.influence);
  const auto m = [&](double length_vx) { return metres(length_vx, voxel_m); };
  std::vector<std::string> all;
  if ((front.step || front.kill) && !front.onto && 2.0 * kill < step) {
    all.push_back(
        fmt::format("kill is {}, less than half of the step of {}: most attractors are passed by; "
                    "expected kill of {} or more, or a step of {} or less",
                    m(kill), m(step), m(0.5 * step), m(2.0 * kill)));
  }
  if (front.influence && influence < suitable.step * 2.0) {
    all.push_back(
        fmt::format("influence is {}, and the attractors are {} from each other: hardly any is in "
                    "reach of the next; expected about {}",
                    m(influence), m(lie.spacing), m(suitable.influence)));
  }
  if ((front.step || front.influence) && step > influence) {
    all.push_back(
        fmt::format("the step of {} is longer than the influence radius of {}; expected a step of "
                    "about {}",
                    m(step), m(influence), m(suitable.step)));
  }
  if (front.kill && 2.0 * kill > lie.extent && lie.extent > 0.0) {
    all.push_back(
        fmt::format("kill is {}, and all attractors lie within {}: the first node ends most of them; "
                    "expected about {}",
                    m(kill), m(lie.extent), m(suitable.kill)));
  }
  return all;
}

}  // namespace

std::vector<Problem> frontWarnings(const Scene& scene, const sim::Frame& frame,
                                   const std::vector<NamedPoints>& attractors) {
  std::vector<Problem> warnings;
  for (const PlantSpec& plant : scene.plants) {
    const rules::RuleSet& trunk = *plant.rules;
    if (!colonizes(plant)) continue;
    const std::string wanted = attractorsFor(plant);
    const auto named = std::find_if(attractors.begin(), attractors.end(),
                                    [&](const NamedPoints& points) { return points.name == wanted; });
    if (named == attractors.end() || named->at_vx.size() < 2) continue;
    const Lie lie = lieOf(named->at_vx);
    const auto tell = [&](const rules::RuleSet* set, const char* path) {
      if (set == nullptr) return;
      for (const std::string& trouble : troubles(set->colonization, lie, frame.voxel_m)) {
        const Problem told =
            problemAt(plant.rules_place, scene.file, fmt::format("{}colonization: {}", path, trouble));
        if (std::none_of(warnings.begin(), warnings.end(), [&](const Problem& w) {
              return w.text.ends_with(": " + trouble) && w.line == told.line && w.column == told.column;
            }))
          warnings.push_back(told);
      }
    };
    tell(&trunk, "");
    tell(trunk.branches.get(), "branches.");
    tell(trunk.twigs.get(), "twigs.");
  }
  return warnings;
}

}  // namespace espalier::scenes
