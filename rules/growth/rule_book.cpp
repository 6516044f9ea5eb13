#include "rules/growth/rule_book.h"

#include <set>

#include "rules/growth/elements.h"
#include "rules/language/key.h"

namespace espalier::rules {
namespace {

using Visit = std::function<void(const RuleSet&, const std::string&)>;

void visitFrom(const RuleSet& rules, const std::string& path, std::set<const RuleSet*>& met,
               const Visit& visit) {
  if (!met.insert(&rules).second) return;
  visit(rules, path);
  const std::string prefix = path.empty() ? "" : path + ".";
  for (const auto& [region, rule] : rules.regions) {
    if (rule.rules) visitFrom(*rule.rules, prefix + "regions." + region, met, visit);
  }
  if (rules.others && rules.others->rules)
    visitFrom(*rules.others->rules, prefix + "regions.others", met, visit);
  if (rules.branches) visitFrom(*rules.branches, prefix + "branches", met, visit);
  if (rules.twigs) visitFrom(*rules.twigs, prefix + "twigs", met, visit);
  if (rules.otherwise) visitFrom(*rules.otherwise, prefix + "otherwise", met, visit);
}

const RuleSet* holding(const RuleSet& rules, const sim::World& world, sim::Voxel v) {
  if (rules.regions.empty() && !rules.others) return &rules;
  const auto nearness = world.nearnessAt(v);
  return nearness ? setNear(rules, world.part(nearness->part).region) : &rules;
}

}  // namespace

void forEachSet(const RuleSet& rules, const Visit& visit) {
  std::set<const RuleSet*> met;
  visitFrom(rules, "", met, visit);
}

const RuleSet* setNear(const RuleSet& rules, const std::string& region, std::string* path) {
  const RuleSet* set = &rules;
  if (path) path->clear();
  while (const RegionRule* rule = ruleFor(*set, region)) {
    if (path) {
      *path += path->empty() ? "regions." : ".regions.";
      *path += set->regions.contains(region) ? region : kOthers;
    }
    if (rule->forbidden) return nullptr;
    if (!rule->rules) break;
    set = rule->rules.get();
  }
  return set;
}

RuleBook::RuleBook(std::shared_ptr<const RuleSet> rules) : rules_(std::move(rules)) {
  forEachSet(*rules_, [&](const RuleSet& set, const std::string&) {
    first_shape_[&set] = static_cast<std::int32_t>(shapes_.size());
    for (auto& shape : shapesOf(set)) shapes_.push_back(std::move(shape));
    for (const Element& element : set.elements)
      has_phyllotaxis_ = has_phyllotaxis_ || element.phyllotaxis.has_value();
  });
}

const RuleSet& RuleBook::ofOrder(int order) const {
  if (order >= 2 && rules_->twigs) return *rules_->twigs;
  return order >= 1 && rules_->branches ? *rules_->branches : *rules_;
}

const RuleSet* RuleBook::first(const sim::World& world, sim::Voxel v, int order) const {
  return holding(ofOrder(order), world, v);
}

const RuleSet* RuleBook::next(const RuleSet& failed, const sim::World& world, sim::Voxel v) const {
  return failed.otherwise ? holding(*failed.otherwise, world, v) : nullptr;
}

}  // namespace espalier::rules
