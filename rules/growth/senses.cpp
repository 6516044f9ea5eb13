#include "rules/growth/senses.h"

#include <algorithm>
#include <iterator>

#include "rules/growth/apices.h"
#include "rules/growth/rule_book.h"
#include "rules/growth/scene_lines.h"
#include "rules/growth/scene_surfaces.h"
#include "sim/grow/plant.h"
#include "sim/sense/company.h"
#include "sim/sense/mass.h"
#include "sim/sense/proximity.h"
#include "sim/tile/tiling.h"

namespace espalier::rules {
namespace {

sim::Vec3 unitOrZero(sim::Vec3 v) {
  const double length = glm::length(v);
  return length > 1e-9 ? v / length : sim::Vec3(0.0);
}

/// Limbs leave one node through the same voxels: those of a sibling right beside the node are no obstacle.
void addSiblings(const sim::SiteView& view, sim::NodeId node, Surroundings& around) {
  std::vector<sim::Voxel> limb;
  view.kin.forEachChild(node, [&](sim::NodeId child) {
    limb.clear();
    sim::tileSegment(around.at_vx, view.plant.skeleton.position_vx[static_cast<std::size_t>(child)], limb);
    std::copy_if(limb.begin(), limb.end(), std::back_inserter(around.attachment),
                 [&](sim::Voxel v) { return sim::besides(v, around.voxel); });
  });
}

/// As a rule set asks: the sun's and the sky's weights made to sum to 1.
double blended(const Light& light, const Exposure& seen) {
  return (light.sun * seen.sun + light.sky * seen.sky) / (light.sun + light.sky);
}

/// Growth rate over that at the least exposure: linear from 1 at the minimum to boost at the maximum.
double vigourAt(const RuleSet& rules, double exposure) {
  const double span = rules.require.exposure_max - rules.require.exposure_min;
  const double above = span > 0.0 ? (exposure - rules.require.exposure_min) / span : 1.0;
  return 1.0 + (rules.light.boost - 1.0) * std::clamp(above, 0.0, 1.0);
}

/// What a sense finds in a place.
struct Found {
  double value = 0.0;
  sim::Vec3 way{0.0};  ///< unit, or zero
};

/// Of what is known exactly: lines or surfaces.
template <class Near>
Found findExactly(const sim::SiteView& view, const SenseSpec& sense, sim::Vec3 at_vx) {
  const double within_vx = sense.within.number;
  const auto nearest = Near(view.commons, at_vx, within_vx).nearest(at_vx, within_vx);
  return {distanceRead(nearest, at_vx, sense, view.world.frame()),
          nearest ? unitOrZero(*nearest - at_vx) : sim::Vec3(0.0)};
}

Found findVoxel(const sim::SiteView& view, const SenseSpec& sense, sim::Vec3 at_vx) {
  const sim::Voxel about = sim::voxelAt(at_vx);
  const auto found = sim::nearestOf(view.world, whoseOf(view, sense), about, sense.within.number);
  const auto nearest = found ? std::optional(sim::Vec3(*found)) : std::nullopt;
  return {distanceRead(nearest, sim::Vec3(about), sense, view.world.frame()),
          nearest ? unitOrZero(*nearest - at_vx) : sim::Vec3(0.0)};
}

Found find(const sim::SiteView& view, const SenseSpec& sense, sim::Vec3 at_vx) {
  switch (sense.measure) {
    case SenseSpec::Measure::density: {
      const sim::Crowd crowd =
          sim::crowdAround(view.world, whoseOf(view, sense), sim::voxelAt(at_vx), sense.within.number);
      return {crowd.density, crowd.centre ? unitOrZero(*crowd.centre - at_vx) : sim::Vec3(0.0)};
    }
    case SenseSpec::Measure::distance:
    case SenseSpec::Measure::nearness:
      if (sense.of == kOfSurfaces) return findExactly<SurfacesNear>(view, sense, at_vx);
      return sense.of == kOfLines ? findExactly<LinesNear>(view, sense, at_vx)
                                  : findVoxel(view, sense, at_vx);
    case SenseSpec::Measure::height:
      break;
  }
  return {sim::heightAbove(view.world, whoseOf(view, sense), at_vx) * view.world.frame().voxel_m,
          {0.0, -1.0, 0.0}};
}

}  // namespace

Surroundings lookAround(const sim::SiteView& view, const sim::Site& site) {
  const sim::Skeleton& skeleton = view.plant.skeleton;
  Surroundings around;
  around.at_vx = site.at_vx;
  around.voxel = sim::voxelAt(site.at_vx);
  if (const sim::NodeId parent = skeleton.parent[static_cast<std::size_t>(site.node)];
      parent != sim::kNoNode) {
    const sim::Vec3 from = skeleton.position_vx[static_cast<std::size_t>(parent)];
    around.heading = unitOrZero(around.at_vx - from);
    sim::tileSegment(from, around.at_vx, around.attachment);
  }
  addSiblings(view, site.node, around);
  around.away = sim::awayFromScene(view.world, around.voxel);
  return around;
}

bool readsSkyTable(const RuleSet& rules) {
  const bool turns = highest(rules.bias.light) != 0.0 || lowest(rules.bias.light) != 0.0;
  return turns && rules.bias.brightest == Brightest::table;
}

Exposure exposureOf(const sim::Light& light) {
  return {light.sun.fraction(), light.sky.fraction()};
}

Vigour vigourOf(const Exposure& seen, const RuleSet& rules) {
  const double exposure = blended(rules.light, seen);
  return {exposure, vigourAt(rules, exposure)};
}

bool hasSenseOf(const RuleSet& rules, std::string_view of) {
  bool has = false;
  forEachSet(rules, [&](const RuleSet& set, const std::string&) {
    has = has || std::any_of(set.senses.begin(), set.senses.end(),
                             [&](const SenseSpec& sense) { return sense.of == of; });
  });
  return has;
}

sim::Whose whoseOf(const sim::SiteView& view, const SenseSpec& sense) {
  const auto word = std::find(kWhose.begin(), kWhose.end(), sense.of);
  const int plant = sim::numberOf(view.world, view.plant);
  if (word == kWhose.end()) return {sim::Whose::Kind::region, plant, sense.of};
  return {static_cast<sim::Whose::Kind>(word - kWhose.begin()), plant, {}};
}

double distanceRead(std::optional<sim::Vec3> nearest_vx, sim::Vec3 at_vx, const SenseSpec& sense,
                    const sim::Frame& frame) {
  const double within_vx = sense.within.number;
  const double far_vx = nearest_vx ? glm::length(*nearest_vx - at_vx) : within_vx;
  return sense.measure == SenseSpec::Measure::nearness ? 1.0 - far_vx / within_vx : far_vx * frame.voxel_m;
}

double readingOf(const sim::SiteView& view, const SenseSpec& sense, sim::Vec3 at_vx) {
  if (sense.measure == SenseSpec::Measure::density)
    return sim::densityAround(view.world, whoseOf(view, sense), sim::voxelAt(at_vx), sense.within.number);
  return find(view, sense, at_vx).value;
}

bool readsAsRequired(const RuleSet& rules, const Senses& senses) {
  for (const SenseBounds& bounds : rules.require.senses) {
    for (const Reading& reading : senses.circumstance.readings) {
      if (reading.sense == bounds.name && !(reading.value >= bounds.min && reading.value <= bounds.max))
        return false;
    }
  }
  return true;
}

Senses sense(const sim::SiteView& view, const Surroundings& around, const Vigour& vigour,
             const RuleSet& rules) {
  Senses senses;
  if (readsSkyTable(rules)) {
    senses.light = view.sky->brightest(around.voxel);
  } else if (view.light != nullptr) {
    senses.light = unitOrZero(view.light->sky.toward);
  }
  senses.exposure = vigour.exposure;
  senses.vigour = vigour.vigour;
  if (highest(rules.bias.twist) != 0.0 || lowest(rules.bias.twist) != 0.0) {
    const auto mass = sim::centreOfMass(view.world.occupied(), around.voxel, rules.bias.twist_radius.number);
    if (mass) senses.twist = unitOrZero(glm::cross(around.heading, *mass - around.at_vx));
  }
  if (highest(rules.bias.apex) != 0.0 || lowest(rules.bias.apex) != 0.0)
    senses.apex = towardApex(view, around, rules.bias.apex_of);
  for (std::size_t i = 0; i < rules.bias.towards.size(); ++i) {
    const PullSpec& pull = rules.bias.towards[i];
    senses.towards[i] =
        unitOrZero(pull.direction ? *pull.direction
                                  : sim::voxelFromWorld(view.world.frame(), *pull.point_m) - around.at_vx);
  }
  senses.circumstance = {
      senses.exposure, static_cast<double>(view.iteration), around.at_vx.y * view.world.frame().voxel_m, {}};
  for (const SenseSpec& spec : rules.senses) {
    const auto bends = std::find_if(rules.bias.senses.begin(), rules.bias.senses.end(),
                                    [&](const SenseBias& by) { return by.name == spec.name; });
    if (bends == rules.bias.senses.end()) {
      senses.circumstance.readings.push_back({spec.name, readingOf(view, spec, around.at_vx)});
      continue;
    }
    const Found found = find(view, spec, around.at_vx);
    senses.circumstance.readings.push_back({spec.name, found.value});
    senses.sensed[static_cast<std::size_t>(bends - rules.bias.senses.begin())] = found.way;
  }
  return senses;
}

}  // namespace espalier::rules
