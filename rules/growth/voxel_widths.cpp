#include "rules/growth/voxel_widths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "rules/growth/element_places.h"
#include "rules/growth/rule_book.h"
#include "rules/language/sense_keys.h"
#include "sim/base/error.h"

namespace espalier::rules {
namespace {

constexpr double kShortestSegment = 0.1, kLongestSegment = 60.0;
constexpr double kFarthestTwist = 64.0;
constexpr double kFarthestOff = 16.0;  // surfaces are looked for so far about each corner
constexpr double kThinnestTwig = 1e-6, kThickestTwig = 100.0;  // thinner ones are none in single precision
constexpr double kFinestDetail = 0.02;
constexpr double kFarthestCorner = 1e5;  // as far as plain numbers reach: 1000 voxel widths, a hundredfold

// A trial tiles an element whole, and a proposal holds the voxels of all that stand on its segment: with this
// many a trial takes some 0.1 s and a proposal 12 MB. A hundred leaves of 50 x 50 are half of it.
constexpr double kMostVoxels = 1e6;

std::string nameOf(const RuleSet& rules, const std::string& path) {
  return fmt::format("rule set '{}'{}", rules.name, path.empty() ? "" : ", " + path);
}

void convert(Distance& distance, double voxel_m) {
  distance = {widths(distance, voxel_m)};
}

void convert(Value& value, double voxel_m) {
  value.low /= voxel_m;
  value.high /= voxel_m;
  for (Value::Point& point : value.curve) point.y /= voxel_m;
}

/// Makes closed bodies of an element's polygons.
void thicken(Element& element) {
  if (!(element.thick.number > 0.0)) return;
  const sim::Vec3 up(0.0, 0.0, element.thick.number);
  std::vector<std::vector<sim::Vec3>> bodies;
  for (std::vector<sim::Vec3> lower : element.polygons) {
    sim::Vec3 twice(0.0);
    for (std::size_t i = 2; i < lower.size(); ++i)
      twice += glm::cross(lower[i - 1] - lower[0], lower[i] - lower[0]);
    if (twice.z < 0.0) std::reverse(lower.begin(), lower.end());
    std::vector<sim::Vec3> upper;
    for (const sim::Vec3 corner : lower) upper.push_back(corner + up);
    bodies.push_back(upper);
    for (std::size_t i = 0; i < lower.size(); ++i) {
      const std::size_t next = (i + 1) % lower.size();
      bodies.push_back({lower[i], lower[next], upper[next], upper[i]});
    }
    std::reverse(lower.begin(), lower.end());
    bodies.push_back(std::move(lower));
  }
  element.polygons = std::move(bodies);
  element.thick = {};
  element.body = true;
}

void convert(RuleSet& rules, double voxel_m) {
  Length& length = rules.random_tree.length;
  if (length.metres) convert(length.value, voxel_m);
  length.metres = false;
  for (Distance* distance : {&rules.bias.twist_radius, &rules.require.proximity_min,
                             &rules.require.proximity_max, &rules.prefer.proximity, &rules.stem.radius,
                             &rules.stem.thickens, &rules.stem.thickest, &rules.colonization.branching.above})
    convert(*distance, voxel_m);
  for (std::optional<Distance>* distance :
       {&rules.colonization.step, &rules.colonization.influence, &rules.colonization.kill}) {
    if (*distance) convert(**distance, voxel_m);
  }
  if (Roughness* const rough = rules.stem.rough ? &*rules.stem.rough : nullptr) {
    for (Distance* distance : {&rough->amplitude, &rough->over, &rough->detail}) convert(*distance, voxel_m);
  }
  Diffusion& diffusion = rules.diffusion;
  for (Distance* distance : {&diffusion.gap_min, &diffusion.gap_max, &diffusion.off})
    convert(*distance, voxel_m);
  if (diffusion.distance && diffusion.distance->metres) {
    convert(diffusion.distance->value, voxel_m);
    diffusion.distance->metres = false;
  }
  for (glm::dvec2& step : diffusion.steps) step /= voxel_m;
  for (SenseSpec& sense : rules.senses) convert(sense.within, voxel_m);
  for (Element& element : rules.elements) {
    if (element.size_metres) convert(element.size, voxel_m);
    element.size_metres = false;
    if (element.petiole.metres) convert(element.petiole.value, voxel_m);
    element.petiole.metres = false;
    if (element.phyllotaxis) convert(element.phyllotaxis->spacing, voxel_m);
    if (element.polygons_metres) {
      for (auto& polygon : element.polygons) {
        for (sim::Vec3& corner : polygon) corner /= voxel_m;
      }
    }
    element.polygons_metres = false;
    convert(element.thick, voxel_m);
    thicken(element);
  }
}

/// The least and the most that light makes of sizes and numbers.
double leastVigour(const RuleSet& rules) {
  return std::min(1.0, rules.light.boost);
}
double mostVigour(const RuleSet& rules) {
  return std::max(1.0, rules.light.boost);
}

/// About as many voxels as an element takes at most, scaled so: a plane meets sqrt(3) of them for each square
/// width at most, and those at its rim beside them.
double mostVoxels(const Element& element, double scale) {
  double voxels = 0.0;
  for (const auto& polygon : element.polygons) {
    sim::Vec3 twice(0.0);
    double around = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      twice += glm::cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
      around += glm::length(polygon[(i + 1) % polygon.size()] - polygon[i]);
    }
    voxels += 2.0 * 0.5 * glm::length(twice) * scale * scale + 3.0 * around * scale + 8.0;
  }
  return voxels;
}

/// As far as the rules say; skeletons that are given may have longer ones.
double longestSegment(const RuleSet& rules) {
  if (rules.propagate == Propagate::random_tree) return highest(rules.random_tree.length.value);
  return rules.colonization.step ? rules.colonization.step->number : kLongestSegment;
}

/// Not counting what light adds.
double mostOnASegment(const RuleSet& rules, const Element& element) {
  if (rules.propagate == Propagate::diffusion) return 1.0;
  if (!element.phyllotaxis) return std::ceil(highest(element.per_segment));
  return std::ceil(longestSegment(rules) / element.phyllotaxis->spacing.number) * element.phyllotaxis->whorl;
}

/// What keeps elements from being tiled; empty if nothing does.
std::string tooManyVoxels(const RuleSet& rules, const std::string& at) {
  double sum = 0.0, most = 0.0;
  std::size_t largest = 0;
  for (std::size_t i = 0; i < rules.elements.size(); ++i) {
    const Element& element = rules.elements[i];
    const double number = std::max(1.0, mostOnASegment(rules, element) * mostVigour(rules));
    const double voxels = number * mostVoxels(element, highest(element.size) * mostVigour(rules));
    sum += voxels;
    if (voxels > most) largest = i;
    most = std::max(most, voxels);
  }
  if (sum <= kMostVoxels) return "";
  return fmt::format(
      "elements may take {:.3g} voxels on one segment {} in full light, most of them elements[{}] (size, "
      "polygons, per_segment, light.boost); expected at most {:.0f}",
      sum, at, largest, kMostVoxels);
}

/// What keeps a rule set in voxel widths from working; empty if nothing does. `at` names the voxel.
std::string wrongWith(const RuleSet& rules, const std::string& at) {
  const double shortest = lowest(rules.random_tree.length.value);
  const double longest = highest(rules.random_tree.length.value);
  if (!(shortest >= kShortestSegment && longest <= kLongestSegment)) {
    return fmt::format("random_tree.length is {:.3g} to {:.3g} voxel widths {}; expected {} to {}", shortest,
                       longest, at, kShortestSegment, kLongestSegment);
  }
  const auto within = [&](const char* key, const Distance& distance, double least, double most) {
    if (distance.number > 0.0 && distance.number >= least && distance.number <= most) return std::string();
    return fmt::format("{} is {:.3g} voxel widths {}; expected {}{}", key, distance.number, at,
                       least > 0.0 ? fmt::format("at least {}", least) : "more than 0",
                       most < kNoLimit ? fmt::format(", at most {}", most) : "");
  };
  std::string wrong = within("bias.twist.radius", rules.bias.twist_radius, 0.0, kFarthestTwist);
  // Of sets that no reader has checked too: senses are asked for by their names.
  checkSenses(rules, [](std::string_view) { return 0; },
              {[&](const std::string& path, const std::string& text, const Check::Misnamed&) {
                if (wrong.empty()) wrong = path + ": " + text;
              }});
  for (const SenseSpec& sense : rules.senses) {
    if (wrong.empty())
      wrong = within(("senses." + sense.name + ".within").c_str(), sense.within, 0.0, kFarthestTwist);
  }
  if (wrong.empty()) wrong = within("stem.radius", rules.stem.radius, kThinnestTwig, kThickestTwig);
  if (wrong.empty()) wrong = within("stem.thickest", rules.stem.thickest, kThinnestTwig, kNoLimit);
  if (rules.stem.rough) {
    const Roughness& rough = *rules.stem.rough;
    if (wrong.empty()) wrong = within("stem.rough.over", rough.over, kThinnestTwig, kNoLimit);
    if (wrong.empty()) wrong = within("stem.rough.detail", rough.detail, kFinestDetail, kNoLimit);
  }
  if (!wrong.empty()) return wrong;
  const double min = rules.require.proximity_min.number, max = rules.require.proximity_max.number;
  if (!(min < max)) {
    return fmt::format(
        "require.proximity.min is {:.3g} and require.proximity.max is {:.3g} voxel widths {}; expected the "
        "first to be less than the second",
        min, max, at);
  }
  if (rules.propagate == Propagate::diffusion)
    wrong = within("diffusion.off", rules.diffusion.off, 0.0, kFarthestOff);
  if (!wrong.empty()) return wrong;
  if (const Diffusion& d = rules.diffusion; d.gap_min.number > d.gap_max.number) {
    return fmt::format(
        "diffusion.gap.min is {:.3g} and diffusion.gap.max is {:.3g} voxel widths {}; expected the first to "
        "be at most the second",
        d.gap_min.number, d.gap_max.number, at);
  }
  for (std::size_t i = 0; i < rules.elements.size(); ++i) {
    const double number = mostOnASegment(rules, rules.elements[i]);
    if (rules.elements[i].phyllotaxis && number > kMostOnASegment) {
      return fmt::format(
          "elements[{}].phyllotaxis: up to {:.0f} elements would stand on a segment of {:.3g} voxel widths "
          "{}; "
          "expected at most {}, by a wider spacing or a smaller whorl",
          i, number, longestSegment(rules), at, kMostOnASegment);
    }
    double farthest = 0.0;
    for (const auto& polygon : rules.elements[i].polygons) {
      for (const sim::Vec3& corner : polygon) farthest = std::max(farthest, glm::length(corner));
    }
    farthest *= highest(rules.elements[i].size);
    if (farthest <= kFarthestCorner) continue;
    return fmt::format("elements[{}] has a corner {:.3g} voxel widths away {}; expected at most {}", i,
                       farthest, at, kFarthestCorner);
  }
  return tooManyVoxels(rules, at);
}

class Converter {
 public:
  explicit Converter(double voxel_m)
      : voxel_m_(voxel_m), at_(fmt::format("at a voxel of {:.4g} m", voxel_m)) {}

  std::shared_ptr<const RuleSet> convert(const std::shared_ptr<const RuleSet>& rules,
                                         const std::string& path) {
    if (const auto known = known_.find(rules.get()); known != known_.end()) return known->second;
    RuleSet copy = *rules;
    rules::convert(copy, voxel_m_);
    if (const std::string wrong = wrongWith(copy, at_); !wrong.empty())
      throw sim::InputError(nameOf(copy, path) + ": " + wrong);
    const std::string prefix = path.empty() ? "" : path + ".";
    for (auto& [region, rule] : copy.regions) {
      if (rule.rules) rule.rules = convert(rule.rules, prefix + "regions." + region);
    }
    if (copy.others && copy.others->rules)
      copy.others->rules = convert(copy.others->rules, prefix + "regions.others");
    if (copy.branches) copy.branches = convert(copy.branches, prefix + "branches");
    if (copy.twigs) copy.twigs = convert(copy.twigs, prefix + "twigs");
    if (copy.otherwise) copy.otherwise = convert(copy.otherwise, prefix + "otherwise");
    return known_[rules.get()] = std::make_shared<const RuleSet>(std::move(copy));
  }

 private:
  double voxel_m_;
  std::string at_;
  std::map<const RuleSet*, std::shared_ptr<const RuleSet>> known_;
};

}  // namespace

double widths(const Distance& distance, double voxel_m) {
  return distance.metres ? distance.number / voxel_m : distance.number;
}

std::shared_ptr<const RuleSet> inVoxelWidths(const std::shared_ptr<const RuleSet>& rules, double voxel_m) {
  return Converter(voxel_m).convert(rules, "");
}

void requireElementsFit(const RuleSet& rules, const sim::Frame& frame) {
  const double diagonal = glm::length(sim::Vec3(frame.size));
  forEachSet(rules, [&](const RuleSet& set, const std::string& path) {
    for (std::size_t i = 0; i < set.elements.size(); ++i) {
      const Element& element = set.elements[i];
      sim::Vec3 low(INFINITY), high(-INFINITY);
      for (const auto& polygon : element.polygons) {
        for (const sim::Vec3& corner : polygon) {
          low = glm::min(low, corner);
          high = glm::max(high, corner);
        }
      }
      const sim::Vec3 extent = high - low;
      const double length =
          std::max({extent.x, extent.y, extent.z}) * lowest(element.size) * leastVigour(set);
      if (!(length > diagonal)) continue;
      throw sim::InputError(fmt::format(
          "{}: elements[{}] is at least {:.4g} voxel widths long at a voxel of {:.4g} m, and nothing longer "
          "than {:.4g} has room in this world of {} x {} x {} voxels",
          nameOf(set, path), i, length, frame.voxel_m, diagonal, frame.size.x, frame.size.y, frame.size.z));
    }
  });
}

LayersNeeded layersNeeded(const RuleSet& rules, double voxel_m, double farthest_vx) {
  LayersNeeded needed;
  const auto ask = [&](const RuleSet& set, const std::string& path, const char* key,
                       const Distance& distance) {
    const double far_vx = widths(distance, voxel_m);
    if (!(far_vx > 0.0 && far_vx < farthest_vx)) return;
    // A quotient of decimals is a whole number but for its last bits: 7 cm in voxels of 1 cm are 7.
    const int layers = static_cast<int>(std::ceil(far_vx - 1e-6)) + 1;
    if (layers <= needed.layers) return;
    needed = {layers, fmt::format("{}: {} is {:.4g} voxel widths", nameOf(set, path), key, far_vx),
              distance.metres ? distance.number : kNoLimit};
  };
  forEachSet(rules, [&](const RuleSet& set, const std::string& path) {
    ask(set, path, "require.proximity.min", set.require.proximity_min);
    ask(set, path, "require.proximity.max", set.require.proximity_max);
    if (set.prefer.has_proximity) ask(set, path, "prefer.proximity", set.prefer.proximity);
  });
  return needed;
}

}  // namespace espalier::rules
