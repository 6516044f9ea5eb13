#include "rules/language/wander_keys.h"

#include <fmt/format.h>

#include "rules/language/key_builder.h"

namespace espalier::rules {
namespace {

std::string wrongWith(const std::vector<glm::dvec2>& table) {
  if (table.size() < 2) return "a table of one point; expected two or more, such as [[0, 1], [1, 0]]";
  bool any = false;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double share = table[i].x;
    if (!(share >= 0.0 && share <= kMostOfWander)) {
      return fmt::format("a table with the share {} of the angle; expected shares from 0 to {}", share,
                         kMostOfWander);
    }
    if (i == 0) continue;
    if (!(share > table[i - 1].x)) {
      return fmt::format("a table with the share {} after {}; expected shares that rise", share,
                         table[i - 1].x);
    }
    any = any || (table[i - 1].y + table[i].y) * (share - table[i - 1].x) > 0.0;
  }
  return any ? "" : "a table of weights 0, by which no angle is drawn; expected one above 0 somewhere";
}

}  // namespace

std::shared_ptr<const Table> wanderKeys() {
  return TableOf<RandomTree>()
      .value("angle", &RandomTree::wander_deg,
             {.unit = "degrees",
              .limits = {0.0, 180.0},
              .meaning = "The farthest that a trial turns, or what else the distribution makes of it."})
      .choice<AngleDistribution>(
          "distribution", &RandomTree::wander_distribution,
          {{"cone", AngleDistribution::cone},
           {"gaussian", AngleDistribution::gaussian},
           {"table", AngleDistribution::table}},
          {.meaning = "cone: even within the angle, as where nothing is said; gaussian: that is the "
                      "deviation to either side."})
      .custom(
          "table", Kind::pairs,
          [](RandomTree& tree, const Datum& d) {
            tree.wander_table = std::get<Pairs>(d);
            // Over a base of another distribution a table speaks for itself.
            if (tree.wander_distribution != AngleDistribution::table) tree.wander_distribution.reset();
          },
          [](const RandomTree& tree) {
            const bool holds = tree.distribution() == AngleDistribution::table && !tree.wander_table.empty();
            return holds ? Datum{tree.wander_table} : Datum{};
          },
          {.limits = {0.0, 1e6},
           .meaning = "How often which angle is drawn: [share of the angle, weight], straight between.",
           .most = kMostAngles})
      .shared();
}

void checkWander(const RuleSet& rules, const Check::Given& given, const Check::Complain& complain) {
  const RandomTree& tree = rules.random_tree;
  const std::string at = "random_tree.wander.table", named = "random_tree.wander.distribution";
  const int written = given(at);
  if (written == 0 && given(named) == 0) return;  // told where it was written
  // By either of the two a file may replace what its base says, but it may not say both itself.
  if (written == given(named) && tree.wander_distribution != AngleDistribution::table)
    complain(at, "a table beside another distribution; expected one of them, or distribution: table");
  if (tree.distribution() != AngleDistribution::table) return;
  if (tree.wander_table.empty()) {
    complain(named, "a table that is not there; expected table: [[share of the angle, weight], ...]");
  } else if (const std::string wrong = wrongWith(tree.wander_table); !wrong.empty()) {
    complain(at, wrong);
  }
}

}  // namespace espalier::rules
