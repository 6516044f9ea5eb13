#include "rules/growth/apices.h"

#include <limits>

#include "rules/growth/rule_book.h"

namespace espalier::rules {
namespace {

constexpr const char *kApexPart = "part", *kApexPlace = "place";

}  // namespace

bool asksForApices(const RuleSet& rules) {
  bool asks = false;
  forEachSet(rules, [&](const RuleSet& set, const std::string&) {
    asks = asks || highest(set.bias.apex) != 0.0 || lowest(set.bias.apex) != 0.0;
  });
  return asks;
}

sim::Columns columnsOf(std::span<const sim::Peak> apices) {
  sim::Columns columns;
  auto& parts = sim::column<std::int32_t>(columns, kApexPart);
  auto& places = sim::column<sim::Vec3>(columns, kApexPlace);
  for (const sim::Peak& apex : apices) {
    parts.push_back(apex.part);
    places.push_back(apex.at_vx);
  }
  return columns;
}

sim::Vec3 towardApex(const sim::SiteView& view, const Surroundings& around, const std::string& region) {
  const auto known = view.commons.find(kApices);
  if (known == view.commons.end()) return sim::Vec3(0.0);
  const auto& parts = sim::column<std::int32_t>(known->second, kApexPart);
  const auto& places = sim::column<sim::Vec3>(known->second, kApexPlace);
  const auto nearest = view.world.nearnessAt(around.voxel);
  const std::string* const meant = !region.empty() ? &region
                                   : nearest       ? &view.world.part(nearest->part).region
                                                   : nullptr;
  if (meant == nullptr) return sim::Vec3(0.0);
  double least = std::numeric_limits<double>::infinity();
  sim::Vec3 way(0.0);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (view.world.part(parts[i]).region != *meant) continue;
    const double far = glm::distance(places[i], around.at_vx);
    if (far >= least) continue;
    least = far;
    way = places[i] - around.at_vx;
  }
  return least > 1e-9 && least < std::numeric_limits<double>::infinity() ? way / least : sim::Vec3(0.0);
}

}  // namespace espalier::rules
