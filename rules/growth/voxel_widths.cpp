#include "rules/growth/voxel_widths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "rules/growth/rule_book.h"
#include "sim/base/error.h"

namespace espalier::rules {
namespace {

constexpr double kShortestSegment = 0.1, kLongestSegment = 60.0;
constexpr double kFarthestTwist = 64.0;
constexpr double kThickestTwig = 100.0;
constexpr double kFarthestCorner = 1e5;  // as far as plain numbers reach: 1000 voxel widths, a hundredfold

std::string nameOf(const RuleSet& rules, const std::string& path) {
  return fmt::format("rule set '{}'{}", rules.name, path.empty() ? "" : ", " + path);
}

double widths(const Distance& distance, double voxel_m) {
  return distance.metres ? distance.number / voxel_m : distance.number;
}

void convert(Distance& distance, double voxel_m) {
  distance = {widths(distance, voxel_m)};
}

void convert(Value& value, double voxel_m) {
  value.low /= voxel_m;
  value.high /= voxel_m;
  for (Value::Point& point : value.curve) point.y /= voxel_m;
}

void convert(RuleSet& rules, double voxel_m) {
  Length& length = rules.random_tree.length;
  if (length.metres) convert(length.value, voxel_m);
  length.metres = false;
  for (Distance* distance : {&rules.bias.twist_radius, &rules.require.proximity_min,
                             &rules.require.proximity_max, &rules.prefer.proximity, &rules.stem_radius})
    convert(*distance, voxel_m);
  for (Element& element : rules.elements) {
    if (element.size_metres) convert(element.size, voxel_m);
    element.size_metres = false;
    if (!element.polygons_metres) continue;
    for (auto& polygon : element.polygons) {
      for (sim::Vec3& corner : polygon) corner /= voxel_m;
    }
    element.polygons_metres = false;
  }
}

/// What keeps a rule set in voxel widths from working; empty if nothing does. `at` names the voxel.
std::string wrongWith(const RuleSet& rules, const std::string& at) {
  const double shortest = lowest(rules.random_tree.length.value);
  const double longest = highest(rules.random_tree.length.value);
  if (!(shortest >= kShortestSegment && longest <= kLongestSegment)) {
    return fmt::format("random_tree.length is {:.3g} to {:.3g} voxel widths {}; expected {} to {}", shortest,
                       longest, at, kShortestSegment, kLongestSegment);
  }
  const auto within = [&](const char* key, const Distance& distance, double most) {
    if (distance.number > 0.0 && distance.number <= most) return std::string();
    return fmt::format("{} is {:.3g} voxel widths {}; expected more than 0, at most {}", key, distance.number,
                       at, most);
  };
  std::string wrong = within("bias.twist.radius", rules.bias.twist_radius, kFarthestTwist);
  if (wrong.empty()) wrong = within("stem.radius", rules.stem_radius, kThickestTwig);
  if (!wrong.empty()) return wrong;
  const double min = rules.require.proximity_min.number, max = rules.require.proximity_max.number;
  if (!(min < max)) {
    return fmt::format(
        "require.proximity.min is {:.3g} and require.proximity.max is {:.3g} voxel widths {}; expected the "
        "first to be less than the second",
        min, max, at);
  }
  for (std::size_t i = 0; i < rules.elements.size(); ++i) {
    double farthest = 0.0;
    for (const auto& polygon : rules.elements[i].polygons) {
      for (const sim::Vec3& corner : polygon) farthest = std::max(farthest, glm::length(corner));
    }
    farthest *= highest(rules.elements[i].size);
    if (farthest <= kFarthestCorner) continue;
    return fmt::format("elements[{}] has a corner {:.3g} voxel widths away {}; expected at most {}", i,
                       farthest, at, kFarthestCorner);
  }
  return "";
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
    if (copy.otherwise) copy.otherwise = convert(copy.otherwise, prefix + "otherwise");
    return known_[rules.get()] = std::make_shared<const RuleSet>(std::move(copy));
  }

 private:
  double voxel_m_;
  std::string at_;
  std::map<const RuleSet*, std::shared_ptr<const RuleSet>> known_;
};

}  // namespace

std::shared_ptr<const RuleSet> inVoxelWidths(const std::shared_ptr<const RuleSet>& rules, double voxel_m) {
  return Converter(voxel_m).convert(rules, "");
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
