#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "rules/language/rule_set.h"
#include "sim/grow/plant.h"
#include "sim/world/world.h"

namespace espalier::rules {

/// Calls visit(set, path) for a rule set and every one that it may lead to, each once; `path` is empty, or
/// such as "otherwise.regions.brick".
void forEachSet(const RuleSet& rules,
                const std::function<void(const RuleSet& set, const std::string& path)>& visit);

/// The set that holds near a region; null where nothing may grow. A region's rule set may have something to
/// say of regions itself, and so on. `path` becomes that of the last rule that was followed, such as
/// "regions.brick.regions.others"; empty where there was none.
const RuleSet* setNear(const RuleSet& rules, const std::string& region, std::string* path = nullptr);

/// A rule set with all that it may lead to: the sets of regions, and those that are tried where one fails. A
/// process asks it which set holds where, and knows nothing of how sets refer to each other.
class RuleBook {
 public:
  explicit RuleBook(std::shared_ptr<const RuleSet> rules);

  /// The set of limbs of an order: 0 the trunk, 1 its branches, 2 and more twigs.
  const RuleSet& ofOrder(int order) const;
  /// Whether limbs are told apart by their orders.
  bool hasOrders() const { return rules_->branches || rules_->twigs; }
  /// Whether limbs meet: then their plants have sim::kJoinsColumn.
  bool limbsMeet() const {
    return rules_->propagate == Propagate::colonization &&
           rules_->colonization.acts == Acts::on_all_neighbours;
  }
  /// Whether elements stand in an order along limbs.
  bool hasPhyllotaxis() const { return has_phyllotaxis_; }
  /// The set that a site in this voxel tries first: of what has an order, the nearest region's, or that
  /// order's own where it says nothing of that one; null where nothing may grow.
  const RuleSet* first(const sim::World& world, sim::Voxel v, int order = 0) const;
  /// The set to try where this one has failed; null where there is none, or nothing may grow.
  const RuleSet* next(const RuleSet& failed, const sim::World& world, sim::Voxel v) const;

  const RuleSet& top() const { return *rules_; }
  /// The shapes of every set: what a plant may carry.
  const std::vector<sim::ElementShape>& shapes() const { return shapes_; }
  /// The number of a set's first shape.
  std::int32_t firstShape(const RuleSet& set) const { return first_shape_.at(&set); }

 private:
  std::shared_ptr<const RuleSet> rules_;
  std::vector<sim::ElementShape> shapes_;
  std::map<const RuleSet*, std::int32_t> first_shape_;
  bool has_phyllotaxis_ = false;
};

}  // namespace espalier::rules
