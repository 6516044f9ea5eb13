#include "sim/grow/grow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/stop.h"
#include "sim/grow/claims.h"
#include "sim/grow/faults.h"
#include "sim/grow/pieces.h"
#include "sim/grow/retiled.h"
#include "sim/grow/seeded.h"

namespace espalier::sim {

/// A site that is due, on its way through one iteration.
struct Growing::Asked {
  std::size_t planting = 0;
  std::size_t plant = 0;  // of all plants
  Site site;
  Proposal proposal = {};
  NodeId node = kNoNode;                        // that grew
  std::size_t first_element = 0, elements = 0;  // of the plant's: those that were placed
};

namespace {

/// What the process of a planting did against its contract.
[[noreturn]] void broken(const Planting& planting, const std::string& what) {
  throw BrokenContract(fmt::format("the growth process of '{}' {}", planting.name, what));
}

void requireSites(const World& world, const Planting& planting, std::span<const Plant> plants,
                  const std::vector<Site>& sites) {
  const auto place = [](const Site& site) { return std::tie(site.plant, site.node, site.number); };
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Site& site = sites[i];
    if (i > 0 && !(place(sites[i - 1]) < place(site))) broken(planting, "named sites out of their order");
    if (site.plant < 0 || static_cast<std::size_t>(site.plant) >= plants.size() || site.node < 0 ||
        site.node >= plants[static_cast<std::size_t>(site.plant)].skeleton.size())
      broken(planting, "named a site on a node that is not there");
    if (site.number >= Slots::kNumbers) broken(planting, "numbered a site beyond what can be told apart");
    if (!holds(world.frame().size, site.at_vx)) broken(planting, "named a site outside the world");
  }
}

/// Room for one more: a quarter at a time, where a vector alone would double.
template <typename T>
void makeRoom(std::vector<T>& values) {
  if (values.size() == values.capacity()) values.reserve(values.size() + values.size() / 4 + 16);
}

void occupyWith(std::vector<TiledVoxel>& edit, std::span<const Voxel> voxels, const Surface& surface) {
  for (const Voxel v : voxels) edit.push_back({v, surface});
}

}  // namespace

Growing::Growing(World& world, std::vector<Planting> plantings, GrowthSettings settings, Growth grown)
    : world_(world),
      plantings_(std::move(plantings)),
      settings_(std::move(settings)),
      growth_(std::move(grown)),
      claims_(std::make_unique<Claims>(world.frame().size)),
      pieces_(std::make_unique<PieceGrid>(world.frame().size)),
      nearby_(std::make_unique<Nearby>()),
      facets_(std::make_unique<Facets>()),
      fits_(settings_.memory) {
  if (growth_.stands.size() != plantings_.size())
    throw BrokenContract("what was grown before has other plantings than those that shall go on");
  for (const auto& [name, columns] : settings_.commons) {
    if (!growth_.commons.contains(name))
      throw BrokenContract(fmt::format("what was grown before lacks what its plantings share: {}", name));
  }
  requireProcesses(plantings_);
  Wants wants;
  for (const Planting& planting : plantings_) {
    wants.light = wants.light || planting.process->wants().light;
    wants.sky_table = wants.sky_table || planting.process->wants().sky_table;
  }
  first_ = growth_.iterations;
  if (wants.light) sensor_.emplace(world.opaque(), settings_.light);
  if (wants.sky_table) {
    if (!settings_.sky_table)
      throw InputError("a growth process wants a table of the sky; expected one in the settings");
    sky_sensor_.emplace(world.opaque(), settings_.sky_table());
  }
  for (std::size_t i = 0; i < plantings_.size(); ++i) {
    std::vector<std::shared_ptr<const FacetShape>> shapes;
    for (const ElementShape& shape : plantings_[i].process->seedling().shapes)
      shapes.push_back(std::make_shared<FacetShape>(facetShape(shape.polygons)));
    for (std::size_t k = 0; k < growth_.stands[i].count; ++k) {
      const std::size_t number = growth_.stands[i].first + k;
      const Plant& plant = growth_.plants[number];
      addPlant(plant, static_cast<int>(number), shapes, *pieces_);
      streams_.push_back(streamOf(settings_.seed, plantings_[i].name, plant.key));
      kin_.emplace_back(plant.skeleton);
      segments_ += static_cast<std::size_t>(plant.skeleton.size()) - 1;
      elements_ += plant.elements.size();
    }
  }
}

Growing::Growing(World& world, std::vector<Planting> plantings, GrowthSettings settings)
    : Growing(world, plantings, settings, seeded(world, plantings, settings)) {
  std::vector<PlantingFault> faults;
  for (std::size_t i = 0; i < plantings_.size(); ++i) {
    try {
      plantings_[i].process->begin(view(i), growth_.stands[i].memory, growth_.commons);
    } catch (const InputError& error) {
      faults.push_back({i, std::nullopt, error.what()});
    }
  }
  if (!faults.empty()) throw PlantingFaults(std::move(faults));
}

Growing::~Growing() = default;

StandView Growing::view(std::size_t planting) const {
  const Stand& stand = growth_.stands[planting];
  return {world_, std::span(growth_.plants).subspan(stand.first, stand.count),
          std::span(kin_).subspan(stand.first, stand.count), growth_.iterations};
}

std::vector<Site> Growing::dueOf(std::size_t planting, Columns& memory, Commons& commons) const {
  const StandView stand = view(planting);
  std::vector<Site> sites = plantings_[planting].process->due(stand, memory, commons);
  requireSites(world_, plantings_[planting], stand.plants, sites);
  return sites;
}

Due Growing::due() const {
  Due due;
  due.commons = growth_.commons;
  for (std::size_t i = 0; i < plantings_.size(); ++i) {
    due.memories.push_back(growth_.stands[i].memory);
    due.sites.push_back(dueOf(i, due.memories.back(), due.commons));
  }
  return due;
}

Proposal Growing::proposeAt(std::size_t planting, const Site& site, const Light* light, const SkyInside* sky,
                            const Columns& memory, const Commons& commons, bool record) const {
  const std::size_t plant = growth_.stands[planting].first + static_cast<std::size_t>(site.plant);
  const SiteView view{world_,
                      growth_.plants[plant],
                      kin_[plant],
                      memory,
                      commons,
                      *pieces_,
                      light,
                      sky,
                      growth_.iterations,
                      record,
                      this->view(planting).plants};
  const RandomKey key{streams_[plant], static_cast<std::uint32_t>(site.node), site.number,
                      static_cast<std::uint32_t>(growth_.iterations)};
  return plantings_[planting].process->propose(view, site, key);
}

Proposal Growing::propose(const Due& due, std::size_t planting, const Site& site) const {
  if (planting >= plantings_.size()) throw InputError(fmt::format("there is no planting {}", planting));
  requireSites(world_, plantings_[planting], view(planting).plants, {site});
  const Wants wants = plantings_[planting].process->wants();
  const Voxel place = voxelAt(site.at_vx);
  ClearAhead clear, sky_clear;
  std::optional<Light> light;
  if (wants.light) light = sensor_->at(world_.opaque(), {&place, 1}, clear, &world_.opaqueBricks()).front();
  std::optional<SkyInside> sky;
  if (wants.sky_table) sky.emplace(*sky_sensor_, world_.opaque(), sky_clear, &world_.opaqueBricks());
  return proposeAt(planting, site, light ? &*light : nullptr, sky ? &*sky : nullptr,
                   due.memories.at(planting), due.commons, true);
}

void Growing::proposeAll(std::vector<Asked>& asked) {
  std::vector<Voxel> places;                      // of those that want light
  std::vector<std::size_t> lit(asked.size(), 0);  // number of its place, from 1; 0: wants no light
  bool sky_wanted = false;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const Wants wants = plantings_[asked[i].planting].process->wants();
    sky_wanted = sky_wanted || wants.sky_table;
    if (!wants.light) continue;
    places.push_back(voxelAt(asked[i].site.at_vx));
    lit[i] = places.size();
  }
  const Bricks* const filled = &world_.opaqueBricks();
  const auto lights = sensor_ ? sensor_->at(world_.opaque(), places, clear_, filled) : std::vector<Light>();
  std::optional<SkyInside> sky;
  if (sky_wanted) sky.emplace(*sky_sensor_, world_.opaque(), sky_clear_, filled);
  parallelFor(asked.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      throwIfStopped();
      const Asked& a = asked[i];
      asked[i].proposal =
          proposeAt(a.planting, a.site, lit[i] > 0 ? &lights[lit[i] - 1] : nullptr, sky ? &*sky : nullptr,
                    growth_.stands[a.planting].memory, growth_.commons, growth_.recorded);
    }
  });
}

void Growing::addNode(std::size_t plant, NodeId parent, Vec3 at_vx, std::span<const float> quantities) {
  Skeleton& skeleton = growth_.plants[plant].skeleton;
  skeleton.parent.push_back(parent);
  skeleton.position_vx.push_back(at_vx);
  skeleton.born.push_back(growth_.iterations);
  std::size_t i = 0;
  for (auto& [name, values] : skeleton.columns) values.push_back(quantities[i++]);
  kin_[plant].add(parent);
}

/// Whether what was accepted earlier in the iteration, pieces from number `before` on, stands in the way of a
/// proposal's segment.
bool Growing::hindered(const Asked& asked, std::uint32_t before) {
  const auto& segment = asked.proposal.segment;
  if (segment && !holds(world_.frame().size, segment->to_vx))
    broken(plantings_[asked.planting], "put a node outside the world");
  if (!segment || segment->passage == Passage::through) return false;
  if (segment->passage == Passage::past_own
          ? !claims_->allow(segment->takes, asked.plant)
          : !claims_->allow(segment->takes, {asked.plant, asked.site.node}, voxelAt(asked.site.at_vx)))
    return true;
  const Limb limb{latticePoint(asked.site.at_vx), latticePoint(segment->to_vx)};
  pieces_->gather(boxOf(limb.from, limb.to), before, static_cast<int>(asked.plant), *nearby_);
  return nearby_->clash(limb);
}

/// Places a proposal's segment and those of its elements that clash with none of the pieces from number
/// `before` on.
void Growing::place(Asked& asked, std::uint32_t before, std::vector<TiledVoxel>& edit) {
  Plant& plant = growth_.plants[asked.plant];
  const Planting& planting = plantings_[asked.planting];
  const Claims::Node from{asked.plant, asked.site.node};
  NodeId carrier = asked.site.node;
  if (auto& segment = asked.proposal.segment) {
    if (segment->quantities.size() != plant.skeleton.columns.size())
      broken(planting, "gave a node other quantities than its plant has columns");
    if (segment->passage != Passage::around) claims_->keepFree(segment->takes);
    claims_->take(segment->takes, from);
    occupyWith(edit, segment->takes, stemSurface(plant));
    carrier = asked.node = plant.skeleton.size();
    addNode(asked.plant, asked.site.node, segment->to_vx, segment->quantities);
    pieces_->add(limbTo(plant, carrier));
    ++segments_;
  }
  asked.first_element = plant.elements.size();
  for (ProposedElement& proposed : asked.proposal.elements) {
    if (proposed.element.shape < 0 || static_cast<std::size_t>(proposed.element.shape) >= plant.shapes.size())
      broken(planting, "proposed an element of a shape that its plant has not");
    proposed.element.node = carrier;
    proposed.element.born = growth_.iterations;
    const auto shape = static_cast<std::size_t>(proposed.element.shape);
    const PartId part = plant.element_parts[shape];
    if (!sim::place(proposed.element, pieces_->shapeOf(part), *facets_))
      broken(planting, "put an element beyond all worlds");
    if (proposed.passage == Passage::around) {
      pieces_->gather(facets_->box, before, -1, *nearby_);
      if (nearby_->clash(*facets_, attachmentOf(plant, proposed.element))) continue;
    }
    pieces_->add(part, static_cast<std::uint32_t>(plant.elements.size()), *facets_);
    for (const Voxel v : proposed.takes) {
      if (!contains(world_.frame().size, v)) broken(planting, "proposed a voxel outside the world");
    }
    occupyWith(edit, proposed.takes,
               {part, plant.shapes[shape].colour, proposed.coverage, Vec3f(proposed.element.z)});
    makeRoom(plant.elements);
    plant.elements.push_back(proposed.element);
  }
  asked.elements = plant.elements.size() - asked.first_element;
  elements_ += asked.elements;
}

void Growing::acceptAll(std::vector<Asked>& asked) {
  std::vector<TiledVoxel> edit;
  std::vector<const Proposal*> accepted;  // of one planting
  const std::uint32_t before = pieces_->size();
  for (std::size_t i = 0; i < asked.size(); ++i) {
    throwIfStopped();
    Asked& a = asked[i];
    Proposal& proposal = a.proposal;
    if (i > 0 && a.planting != asked[i - 1].planting) accepted.clear();
    if (proposal.outcome == Outcome::grown) {
      if (!hindered(a, before) && plantings_[a.planting].process->agrees(proposal, accepted))
        place(a, before, edit);
      const bool placed = a.node != kNoNode || a.elements > 0;
      if (!placed && (proposal.segment || !proposal.elements.empty())) {
        proposal.outcome = Outcome::claimed;
        for (Attempt& attempt : proposal.attempts) attempt.taken = false;
      } else {
        accepted.push_back(&proposal);
      }
    }
    Tally& tally = growth_.tallies[a.plant];
    ++tally.sites[static_cast<std::size_t>(proposal.outcome)];
    for (std::size_t k = 0; k < kOutcomes; ++k) tally.trials[k] += proposal.trials[k];
    growth_.attempts.insert(growth_.attempts.end(), proposal.attempts.begin(), proposal.attempts.end());
  }
  world_.occupy(edit);
  claims_->clear();
}

void Growing::settleAll(std::span<const std::size_t> plantings, const std::vector<Asked>& asked) {
  std::vector<Verdict> verdicts;
  for (const Asked& a : asked)
    verdicts.push_back({a.site, &a.proposal, a.proposal.outcome, a.node, a.first_element, a.elements});
  std::size_t first = 0;
  for (const std::size_t i : plantings) {
    std::size_t last = first;
    while (last < asked.size() && asked[last].planting == i) ++last;
    plantings_[i].process->settle(view(i), std::span(verdicts).subspan(first, last - first),
                                  growth_.stands[i].memory, growth_.commons);
    first = last;
  }
}

std::size_t Growing::alive() const {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < plantings_.size(); ++i)
    sum += plantings_[i].process->alive(growth_.stands[i].memory, growth_.commons);
  return sum;
}

/// Asks those plantings once; in a later round of an iteration those that said that they go on.
void Growing::round(std::span<const std::size_t> plantings, bool later) {
  std::vector<Asked> asked;
  for (const std::size_t i : plantings) {
    const std::size_t before = asked.size();
    for (const Site& site : dueOf(i, growth_.stands[i].memory, growth_.commons))
      asked.push_back({i, growth_.stands[i].first + static_cast<std::size_t>(site.plant), site});
    if (later && asked.size() == before) broken(plantings_[i], "goes on and names no site");
  }
  proposeAll(asked);
  proposals_ += asked.size();
  fits_.asked(asked.size());
  acceptAll(asked);
  settleAll(plantings, asked);
}

bool Growing::step() {
  const StopScope in_force(settings_.stop);
  throwIfStopped();
  if (growth_.iterations >= settings_.iterations || alive() == 0 || !nextFits()) return false;
  std::vector<std::size_t> turn(plantings_.size());
  std::iota(turn.begin(), turn.end(), std::size_t{0});
  for (bool later = false; !turn.empty(); later = true) {
    round(turn, later);
    std::erase_if(turn, [&](std::size_t i) {
      return !plantings_[i].process->goesOn(view(i), growth_.stands[i].memory);
    });
    // What goes on may do so many times: what does not fit is found by the next step.
    if (!turn.empty() && !nextFits()) break;
  }
  ++growth_.iterations;
  if (settings_.progress) {
    settings_.progress(
        {growth_.iterations, settings_.iterations, first_, segments_, elements_, alive(), proposals_});
  }
  return true;
}

Growth grow(World& world, const std::vector<Planting>& plantings, const GrowthSettings& settings) {
  Growing growing(world, plantings, settings);
  while (growing.step()) {
  }
  return growing.take();
}

}  // namespace espalier::sim
