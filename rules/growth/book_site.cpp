#include "rules/growth/book_site.h"

#include <algorithm>

#include "rules/growth/element_places.h"
#include "rules/growth/elements.h"
#include "rules/language/rule_values.h"

namespace espalier::rules {
namespace {

using sim::Outcome;

/// Whether the limb that ends here has as many segments near one region as a set lets it have.
bool stayedTooLong(const sim::SiteView& view, const sim::Site& site, const RuleSet& rules) {
  if (rules.require.in_region_max == kNoAge) return false;
  const sim::Skeleton& skeleton = view.plant.skeleton;
  const auto regionAt = [&](sim::NodeId node) -> const std::string* {
    const auto near =
        view.world.nearnessAt(sim::voxelAt(skeleton.position_vx[static_cast<std::size_t>(node)]));
    return near ? &view.world.part(near->part).region : nullptr;
  };
  const std::string* const here = regionAt(site.node);
  if (here == nullptr) return false;
  int segments = 0;
  for (sim::NodeId node = skeleton.parent[static_cast<std::size_t>(site.node)];
       node != sim::kNoNode && segments < rules.require.in_region_max;
       node = skeleton.parent[static_cast<std::size_t>(node)]) {
    const std::string* const there = regionAt(node);
    if (there == nullptr || *there != *here) break;
    ++segments;
  }
  return segments >= rules.require.in_region_max;
}

/// Why a set does not grow here; grown if it does, and then the proposal says what.
Outcome tryToGrow(const sim::SiteView& view, const RuleSet& rules, const sim::Site& site,
                  const sim::RandomKey& key, unsigned set, const Try& attempt, sim::Proposal& proposal) {
  if (view.iteration < rules.require.age_min) return Outcome::resting;
  if (view.iteration > rules.require.age_max || stayedTooLong(view, site, rules)) return Outcome::unmet;
  const Vigour light = vigourOf(seenAt(view), rules);
  if (light.exposure < rules.require.exposure_min) return Outcome::too_dark;
  if (light.exposure > rules.require.exposure_max) return Outcome::too_bright;
  const double chance = sim::Slots(key, sim::Purpose::rate, set).uniform(0);
  if (chance * std::max(1.0, rules.light.boost) >= light.vigour) return Outcome::resting;

  const Surroundings around = lookAround(view, site);
  const Senses senses = sense(view, around, light, rules);
  if (!readsAsRequired(rules, senses)) return Outcome::unmet;
  return attempt(rules, around, senses, set, proposal) ? Outcome::grown : Outcome::no_trial;
}

}  // namespace

Exposure seenAt(const sim::SiteView& view) {
  return view.light != nullptr ? exposureOf(*view.light) : Exposure{1.0, 1.0};
}

std::vector<float> quantitiesOf(const sim::SiteView& view, const RuleBook& book, const sim::Site& site,
                                sim::Vec3 to_vx, const Exposure& seen, double exposure, int order,
                                double proximity_vx, std::optional<float> radius_vx, sim::NodeId joins) {
  // exposure, joins, limb_turn, limb_vx, order, proximity_vx, radius_vx, sky_exposure, sun_exposure: in the
  // order of their names.
  std::vector<float> quantities;
  if (view.light != nullptr) quantities.push_back(static_cast<float>(exposure));
  if (book.limbsMeet()) quantities.push_back(static_cast<float>(std::max(joins, 0)));
  if (book.hasPhyllotaxis()) {
    const double length_vx = glm::distance(to_vx, site.at_vx);
    const sim::Vec3 way = glm::normalize(to_vx - site.at_vx);
    const LimbQuantities end = atEnd(limbPlace(view.plant.skeleton, site.node, way), way, length_vx);
    quantities.insert(quantities.end(), {end.turn, end.length_vx});
  }
  if (book.hasOrders()) quantities.push_back(static_cast<float>(order));
  quantities.push_back(static_cast<float>(proximity_vx));
  if (radius_vx) quantities.push_back(*radius_vx);
  if (view.light != nullptr) {
    quantities.push_back(static_cast<float>(seen.sky));
    quantities.push_back(static_cast<float>(seen.sun));
  }
  return quantities;
}

sim::Proposal proposeBySets(const sim::SiteView& view, const sim::Site& site, const sim::RandomKey& key,
                            const RuleBook& book, const RuleSet* first, const Try& attempt) {
  sim::Proposal proposal;
  const sim::Voxel at = sim::voxelAt(site.at_vx);
  proposal.outcome = Outcome::forbidden;
  const RuleSet* rules = first;
  for (unsigned set = 0; rules != nullptr; ++set, rules = book.next(*rules, view.world, at)) {
    const Outcome outcome = tryToGrow(view, *rules, site, key, set, attempt, proposal);
    // What is told of a site that did not grow is why its first set failed, unless a later one got as far as
    // trials.
    if (set == 0 || outcome == Outcome::no_trial || outcome == Outcome::grown || outcome == Outcome::resting)
      proposal.outcome = outcome;
    if (outcome == Outcome::grown || outcome == Outcome::resting) break;
  }
  return proposal;
}

sim::Proposal proposeByBook(const sim::SiteView& view, const sim::Site& site, const sim::RandomKey& key,
                            const RuleBook& book, int order, const Step& step, sim::NodeId joins) {
  const auto grow = [&](const RuleSet& rules, const Surroundings& around, const Senses& senses, unsigned set,
                        sim::Proposal& proposal) {
    std::optional<Candidate> best = step(rules, around, senses, set, proposal);
    if (!best) return false;
    proposal.elements = proposeElements(view, site, rules, around, senses, best->to_vx, best->passes,
                                        book.firstShape(rules), key);
    proposal.segment = {best->to_vx, std::move(best->takes), best->passage,
                        quantitiesOf(view, book, site, best->to_vx, seenAt(view), senses.exposure, order,
                                     best->proximity_vx, std::nullopt, joins)};
    return true;
  };
  return proposeBySets(view, site, key, book, book.first(view.world, sim::voxelAt(site.at_vx), order), grow);
}

namespace {

/// Whether anything that a set says depends on light. Leaves turn to it; what diffusion lays does not, unless
/// its pose says so.
bool asksForLight(const RuleSet& set) {
  const bool leaves = set.propagate != Propagate::diffusion;
  bool asks = set.require.exposure_min > 0.0 || set.require.exposure_max < 1.0 || set.light.boost != 1.0 ||
              !(set.bias.light == Value(0.0));
  for (const Element& element : set.elements) asks = asks || leaves || element.pose == Pose::light;
  forEachValue(set, [&](const std::string& path, const Value& value) {
    const bool follows = value.kind == Value::Kind::curve && value.over == Over::exposure;
    asks = asks || (follows && (!leaves || path.starts_with("bias.")));
  });
  return asks;
}

}  // namespace

int orderOf(const sim::Plant& plant, sim::NodeId node) {
  const std::vector<float>* const order = sim::find(plant.skeleton, "order");
  return order == nullptr ? 0 : static_cast<int>((*order)[static_cast<std::size_t>(node)]);
}

sim::Plant seedlingOf(const RuleBook& book) {
  sim::Plant plant;
  plant.shapes = book.shapes();
  plant.stem_colour = book.top().stem.colour;
  const Stem& stem = book.top().stem;
  plant.shoot_colour = stem.shoots;
  if (stem.emits) {
    plant.stem_emits = stem.emits->light();
    plant.stem_emits_share = static_cast<float>(stem.emits->order_share);
  }
  plant.stem_alpha = static_cast<float>(stem.alpha);
  plant.bark = stem.picture ? "" : stem.texture;
  plant.bark_picture = stem.picture;
  plant.girth = {
      stem.by,         stem.radius.number, stem.exponent, stem.thickens.number, stem.thickest.number,
      stem.order_share};
  if (stem.rough) {
    plant.form.rough = {stem.rough->hurst, stem.rough->amplitude.number, stem.rough->over.number,
                        stem.rough->detail.number};
  }
  plant.form.forks = stem.forks;
  plant.skeleton.columns["proximity_vx"];
  if (book.limbsMeet()) plant.skeleton.columns[sim::kJoinsColumn];
  if (book.hasOrders()) plant.skeleton.columns["order"];
  if (book.hasPhyllotaxis()) {
    for (const char* name : {kLimbTurnColumn, kLimbLengthColumn}) plant.skeleton.columns[name];
  }
  if (!wantsOf(book).light) return plant;
  for (const char* name : {"exposure", "sky_exposure", "sun_exposure"}) plant.skeleton.columns[name];
  return plant;
}

sim::Wants wantsOf(const RuleBook& book) {
  // A walk's report and colours show the light that it grew in; fronts grow several times as fast without.
  sim::Wants wants{.light = book.top().propagate == Propagate::random_tree};
  forEachSet(book.top(), [&](const RuleSet& set, const std::string&) {
    wants.light = wants.light || asksForLight(set);
    wants.sky_table = wants.sky_table || readsSkyTable(set);
  });
  return wants;
}

}  // namespace espalier::rules
