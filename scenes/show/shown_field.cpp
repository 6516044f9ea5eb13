#include "scenes/show/shown_field.h"

#include <fmt/format.h>

#include <algorithm>

#include "rules/growth/front_bend.h"
#include "rules/growth/front_memory.h"
#include "rules/growth/shared_guide.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

const sim::Columns& columnsOf(const sim::Growth& growth, const std::string& key, const char* what,
                              const std::string& name) {
  if (const auto at = growth.commons.find(key); at != growth.commons.end()) return at->second;
  throw sim::InputError(
      fmt::format("what has grown knows no {} {}; expected it there when it grew", what, inQuotes(name)));
}

}  // namespace

std::vector<UsedField> usedFields(const Scene& scene) {
  std::vector<UsedField> fields;
  for (const FieldSpec& field : scene.fields) {
    UsedField used{field.name, {}};
    for (std::size_t i = 0; i < scene.plants.size(); ++i) {
      const auto& names = scene.plants[i].rules->colonization.fields;
      if (colonizes(scene.plants[i]) && std::find(names.begin(), names.end(), field.name) != names.end())
        used.uses.push_back({i, attractorsFor(scene.plants[i])});
    }
    fields.push_back(std::move(used));
  }
  return fields;
}

ShownField::ShownField(const sim::Growth& growth, const UsedField& field)
    : guide_(rules::guideIn(columnsOf(growth, rules::fieldNamed(field.name), "field", field.name))) {
  for (const UsedField::Use& use : field.uses) {
    const auto known =
        std::find_if(sets_.begin(), sets_.end(), [&](const Set& set) { return set.name == use.attractors; });
    const auto number = static_cast<std::size_t>(known - sets_.begin());
    if (known == sets_.end()) {
      const sim::Columns& columns =
          columnsOf(growth, rules::attractorsNamed(use.attractors), "attractors", use.attractors);
      const auto& places = sim::column<sim::Vec3>(columns, rules::kAttractorPlace);
      sets_.push_back({use.attractors, &places, &sim::column<sim::Vec3>(columns, rules::kAttractorNormal),
                       rules::sortedAttractors(places)});
    }
    if (use.planting >= growth.stands.size()) continue;
    const sim::Stand& stand = growth.stands[use.planting];
    std::vector<sim::Vec3> starts;
    for (std::size_t i = 0; i < stand.count; ++i)
      starts.push_back(growth.plants.at(stand.first + i).skeleton.position_vx.front());
    const std::vector<double> farthest = rules::farthestOf(sets_[number].sorted, starts);
    for (std::size_t i = 0; i < starts.size(); ++i) starts_.push_back({starts[i], farthest[i], number});
  }
}

bool ShownField::onSurfaces() const {
  return guide_.axis == rules::GuideAxis::node_normal || guide_.axis == rules::GuideAxis::attractor_normal;
}

const ShownField::Start* ShownField::startNear(sim::Vec3 place_vx) const {
  const auto nearest = std::min_element(starts_.begin(), starts_.end(), [&](const Start& a, const Start& b) {
    return rules::distance2(a.at_vx, place_vx) < rules::distance2(b.at_vx, place_vx);
  });
  return nearest == starts_.end() ? nullptr : &*nearest;
}

sim::Vec3 ShownField::normalIn(const Set& set, sim::Vec3 place_vx) const {
  const std::int32_t nearest = rules::nearestOfAll(set.sorted, place_vx);
  if (nearest == rules::kNobody || set.normals->empty()) return sim::Vec3(0.0);
  return (*set.normals)[static_cast<std::size_t>(set.sorted.number[static_cast<std::size_t>(nearest)])];
}

sim::Vec3 ShownField::normalAt(sim::Vec3 place_vx) const {
  const Start* const start = startNear(place_vx);
  return start == nullptr ? sim::Vec3(0.0) : normalIn(sets_[start->set], place_vx);
}

sim::Vec3 ShownField::at(sim::Vec3 place_vx) const {
  const Start* const start = startNear(place_vx);
  if (start == nullptr) return sim::Vec3(0.0);
  const sim::Vec3 normal = onSurfaces() ? normalIn(sets_[start->set], place_vx) : sim::Vec3(0.0);
  return rules::guideAt(guide_, {place_vx, start->at_vx, start->farthest_vx, normal, guide_.orders[0]});
}

std::vector<sim::Vec3> ShownField::attractors_vx() const {
  std::vector<sim::Vec3> all;
  for (const Set& set : sets_) all.insert(all.end(), set.places_vx->begin(), set.places_vx->end());
  return all;
}

std::vector<sim::Vec3> ShownField::starts_vx() const {
  std::vector<sim::Vec3> all;
  for (const Start& start : starts_) all.push_back(start.at_vx);
  return all;
}

}  // namespace espalier::scenes
