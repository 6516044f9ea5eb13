#include <fmt/format.h>

#include <cmath>

#include "rules/language/diffusion_keys.h"
#include "rules/language/envelope_keys.h"
#include "rules/language/registry.h"
#include "rules/language/sense_keys.h"
#include "rules/language/wander_keys.h"
#include "sim/base/counted.h"

namespace espalier::rules {
namespace {

using Polygon = std::vector<sim::Vec3>;
using Rules = std::function<void(const RuleSet&, const Check::Given&, const Check::Complain&)>;

Check check(std::vector<std::string> reads, Rules run) {
  return {std::move(reads), [run = std::move(run)](const void* rules, const Check::Given& given,
                                                   const Check::Complain& complain) {
            run(*static_cast<const RuleSet*>(rules), given, complain);
          }};
}

/// Complains where a lower bound lies above its upper bound, at the one that was written. Bounds in two units
/// wait for the voxel size (rules/growth/voxel_widths.h).
Check ordered(const std::string& low_path, const std::string& high_path,
              const std::function<Distance(const RuleSet&)>& low,
              const std::function<Distance(const RuleSet&)>& high, bool may_be_equal) {
  return check({low_path, high_path}, [=](const RuleSet& rules, const Check::Given& given,
                                          const Check::Complain& complain) {
    const Distance a = low(rules), b = high(rules);
    if (a.metres != b.metres || a.number < b.number || (may_be_equal && a.number == b.number)) return;
    const auto said = [&](const std::string& path, const Distance& bound) {
      return fmt::format("{} is {}{}", path, written(Datum{bound}), given(path) ? "" : " (by default)");
    };
    complain(given(low_path) ? low_path : high_path,
             fmt::format("{} and {}; expected the first to be {} the second", said(low_path, a),
                         said(high_path, b), may_be_equal ? "at most" : "less than"));
  });
}

double longestEdge(const Polygon& polygon) {
  double longest = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    longest = std::max(longest, glm::distance(polygon[i], polygon[(i + 1) % polygon.size()]));
  }
  return longest;
}

/// Newell's normal, its length twice the area.
sim::Vec3 areaNormal(const Polygon& polygon) {
  sim::Vec3 normal{0.0};
  for (std::size_t i = 0; i < polygon.size(); ++i)
    normal += glm::cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return normal;
}

std::string wrongWith(const Polygon& polygon) {
  if (polygon.size() < 3)
    return fmt::format("a polygon of {}; expected at least 3", sim::counted(polygon.size(), "corner"));
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (polygon[i] == polygon[(i + 1) % polygon.size()]) {
      return fmt::format("corners {} and {} are the same point; expected each corner once", i + 1,
                         (i + 1) % polygon.size() + 1);
    }
  }
  const double edge = longestEdge(polygon);
  const auto normal = areaNormal(polygon);
  if (glm::length(normal) < 1e-6 * edge * edge)
    return "a polygon without area; expected corners that do not lie on one line";
  sim::Vec3 centre{0.0};
  for (const auto& corner : polygon) centre += corner / static_cast<double>(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const double off = std::abs(glm::dot(polygon[i] - centre, glm::normalize(normal)));
    // Greene's own leaves are flat to about a fiftieth of their length.
    if (off > 0.1 * edge) {
      return fmt::format(
          "corner {} lies {:.3g} off the polygon's plane; expected a flat polygon, within a tenth of its "
          "longest edge",
          i + 1, off);
    }
  }
  return "";
}

void checkElements(const RuleSet& rules, const Check::Given& given, const Check::Complain& complain) {
  for (std::size_t i = 0; i < rules.elements.size(); ++i) {
    const auto& element = rules.elements[i];
    const auto path = fmt::format("elements[{}]", i);
    for (std::size_t j = 0; j < i; ++j) {
      if (rules.elements[j].name == element.name) {
        complain(path + ".name",
                 fmt::format("two elements are named '{}'; expected names that differ", element.name));
        break;
      }
    }
    if (element.thick.number > 0.0 && element.thick.metres != element.polygons_metres) {
      complain(path + ".thick",
               element.polygons_metres
                   ? "a number beside polygons of lengths; expected a length too, such as 3 cm"
                   : "a length beside polygons of plain numbers; expected a number, as they are");
    }
    if (element.size_metres && element.polygons_metres) {
      complain(
          path + ".size",
          "size is a length, and the corners of the polygons are lengths too; expected a factor here, or "
          "corners as plain numbers, multiples of the size");
    }
    if (element.polygons.empty() && element.texture.empty() && element.from.empty())
      complain(path, "an element without polygons; expected at least one, or a texture");
    if (!element.texture.empty() && !element.from.empty())
      complain(path + ".from", "a texture and from; expected one of them");
    if (element.from.empty() && !element.product.empty())
      complain(path + ".product", "product means nothing without from; expected from: SCENE.yaml beside it");
    if (element.phyllotaxis && given(path + ".per_segment"))
      complain(path + ".per_segment",
               "per_segment beside phyllotaxis, whose spacing says how many there are; expected one of them");
    for (std::size_t p = 0; p < element.polygons.size(); ++p) {
      const auto wrong = wrongWith(element.polygons[p]);
      if (!wrong.empty()) complain(fmt::format("{}.polygons[{}]", path, p), wrong);
    }
  }
}

void checkPulls(const RuleSet& rules, const Check::Given&, const Check::Complain& complain) {
  for (std::size_t i = 0; i < rules.bias.towards.size(); ++i) {
    const PullSpec& pull = rules.bias.towards[i];
    const auto path = fmt::format("bias.towards[{}]", i);
    if (pull.point_m.has_value() == pull.direction.has_value())
      complain(path, "expected either a point or a direction");
    else if (pull.direction && *pull.direction == sim::Vec3(0.0))
      complain(path + ".direction", "[0, 0, 0] is no direction; expected one that leads somewhere");
  }
}

void checkColonization(const RuleSet& rules, const Check::Given& given, const Check::Complain& complain) {
  const Colonization& front = rules.colonization;
  if (front.crown) checkCrown(*front.crown, "colonization.crown", complain);
  if (front.crown && !front.attractors.empty())
    complain("colonization.crown", "a crown beside attractors; expected one of them");
  if (rules.propagate == Propagate::colonization && !front.crown && front.attractors.empty())
    complain("colonization",
             "no attractors; expected the name of some of the scene's (attractors: NAME), or a crown");
  if (front.kill && front.influence && front.kill->metres == front.influence->metres &&
      front.kill->number >= front.influence->number)
    complain("colonization.kill",
             "kill is not less than influence: every attractor would end before it acts");
  for (const auto& [key, set] : {std::pair("onto", front.onto), std::pair("repeated", front.repeated)}) {
    if (set && front.acts == Acts::on_all_neighbours)
      complain(std::string("colonization.") + key,
               fmt::format("{} means nothing where attractors pull all around them; expected it with acts: "
                           "on_nearest_node or on_every_node",
                           key));
  }
  static_cast<void>(given);
}

}  // namespace

const std::vector<Check>& ruleChecks() {
  static const std::vector<Check> checks = {
      ordered(
          "random_tree.trials.min", "random_tree.trials.max",
          [](auto& r) { return Distance{double(r.random_tree.trials_min)}; },
          [](auto& r) { return Distance{double(r.random_tree.trials_max)}; }, true),
      ordered(
          "require.proximity.min", "require.proximity.max", [](auto& r) { return r.require.proximity_min; },
          [](auto& r) { return r.require.proximity_max; }, false),
      ordered(
          "require.exposure.min", "require.exposure.max",
          [](auto& r) { return Distance{r.require.exposure_min}; },
          [](auto& r) { return Distance{r.require.exposure_max}; }, false),
      ordered(
          "colonization.branching.angle.min", "colonization.branching.angle.max",
          [](auto& r) { return Distance{r.colonization.branching.angle_min_deg}; },
          [](auto& r) { return Distance{r.colonization.branching.angle_max_deg}; }, true),
      ordered(
          "diffusion.gap.min", "diffusion.gap.max", [](auto& r) { return r.diffusion.gap_min; },
          [](auto& r) { return r.diffusion.gap_max; }, true),
      check({"light.blend"},
            [](auto& rules, auto&, auto& complain) {
              if (rules.light.sun + rules.light.sky <= 0.0) {
                complain("light.blend", "both weights are 0; expected sun or sky to be more than 0");
              }
            }),
      ordered(
          "require.age.min", "require.age.max", [](auto& r) { return Distance{double(r.require.age_min)}; },
          [](auto& r) { return Distance{double(r.require.age_max)}; }, true),
      check({"random_tree.wander"}, checkWander),
      check({}, checkPulls),
      check({}, checkSenses),
      check({}, checkElements),
      check({}, checkColonization),
      check({}, checkDiffusion),
  };
  return checks;
}

}  // namespace espalier::rules
