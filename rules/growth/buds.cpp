#include "rules/growth/buds.h"

#include <algorithm>
#include <tuple>

#include "sim/base/error.h"

namespace espalier::rules {
namespace {

struct Bud {
  std::int32_t plant, node, number, due;
};
using Numbers = std::vector<std::int32_t>;

constexpr const char* kPlant = "bud_plant";
constexpr const char* kNode = "bud_node";
constexpr const char* kNumber = "bud_number";
constexpr const char* kDue = "bud_due";  // the iteration in which it next tries

std::vector<Bud> budsOf(const sim::Columns& memory) {
  const Numbers &plant = sim::column<std::int32_t>(memory, kPlant),
                &node = sim::column<std::int32_t>(memory, kNode),
                &number = sim::column<std::int32_t>(memory, kNumber),
                &due = sim::column<std::int32_t>(memory, kDue);
  if (node.size() != plant.size() || number.size() != plant.size() || due.size() != plant.size())
    throw sim::BrokenContract("the buds' columns differ in length");
  std::vector<Bud> buds(plant.size());
  for (std::size_t i = 0; i < buds.size(); ++i) buds[i] = {plant[i], node[i], number[i], due[i]};
  return buds;
}

bool before(const Bud& a, const Bud& b) {
  return std::tie(a.plant, a.node, a.number) < std::tie(b.plant, b.node, b.number);
}

/// Also of those whose time has not come: a state may hold anything, and should be refused before it is gone
/// on with.
void requireSound(const std::vector<Bud>& buds, const sim::StandView& stand) {
  for (std::size_t i = 0; i < buds.size(); ++i) {
    const Bud& bud = buds[i];
    if (bud.plant < 0 || static_cast<std::size_t>(bud.plant) >= stand.plants.size() || bud.node < 0 ||
        bud.node >= stand.plants[static_cast<std::size_t>(bud.plant)].skeleton.size())
      throw sim::BrokenContract("a bud on a node that is not there");
    if (bud.number < 0 || static_cast<std::uint32_t>(bud.number) >= sim::Slots::kNumbers)
      throw sim::BrokenContract("a bud with a number that no site has");
    if (i > 0 && !before(buds[i - 1], bud)) throw sim::BrokenContract("buds that are out of their order");
  }
}

void keep(std::vector<Bud>& buds, sim::Columns& memory) {
  std::sort(buds.begin(), buds.end(), before);
  const auto set = [&](const char* name, std::int32_t Bud::*field) {
    Numbers& values = sim::column<std::int32_t>(memory, name);
    values.clear();
    for (const Bud& bud : buds) values.push_back(bud.*field);
  };
  set(kPlant, &Bud::plant);
  set(kNode, &Bud::node);
  set(kNumber, &Bud::number);
  set(kDue, &Bud::due);
}

}  // namespace

void beginBuds(const sim::StandView& stand, sim::Columns& memory) {
  std::vector<Bud> buds;
  for (std::size_t i = 0; i < stand.plants.size(); ++i)
    buds.push_back({static_cast<std::int32_t>(i), 0, 0, 0});
  keep(buds, memory);
}

std::vector<sim::Site> dueBuds(const sim::StandView& stand, const sim::Columns& memory) {
  const std::vector<Bud> buds = budsOf(memory);
  requireSound(buds, stand);
  std::vector<sim::Site> sites;
  for (const Bud& bud : buds) {
    if (bud.due > stand.iteration) continue;
    const sim::Skeleton& skeleton = stand.plants[static_cast<std::size_t>(bud.plant)].skeleton;
    sites.push_back({bud.plant, bud.node, static_cast<std::uint32_t>(bud.number),
                     skeleton.position_vx[static_cast<std::size_t>(bud.node)]});
  }
  return sites;
}

namespace {

/// Whether a plant is a single segment that found no way on.
bool isStunted(const sim::StandView& stand, const sim::Verdict& verdict, const std::vector<Bud>& buds) {
  const std::int32_t plant = verdict.site.plant;
  return verdict.outcome == sim::Outcome::no_trial && verdict.proposal->retire &&
         stand.plants[static_cast<std::size_t>(plant)].skeleton.size() == 2 &&
         std::none_of(buds.begin(), buds.end(), [&](const Bud& bud) { return bud.plant == plant; });
}

}  // namespace

void settleBuds(const sim::StandView& stand, std::span<const sim::Verdict> verdicts, sim::Columns& memory) {
  std::vector<Bud> buds = budsOf(memory);
  std::erase_if(buds, [&](const Bud& bud) { return bud.due <= stand.iteration; });
  for (const sim::Verdict& verdict : verdicts) {
    const sim::Site& site = verdict.site;
    if (verdict.outcome == sim::Outcome::grown) {
      for (const sim::Sprout& sprout : verdict.proposal->sprouts) {
        buds.push_back({site.plant, verdict.node, static_cast<std::int32_t>(sprout.number),
                        stand.iteration + sprout.wait});
      }
    } else if (verdict.outcome == sim::Outcome::claimed || !verdict.proposal->retire) {
      buds.push_back({site.plant, site.node, static_cast<std::int32_t>(site.number), stand.iteration + 1});
    }
  }
  // A seed knows nothing of what lies beyond its first segment: it may have led where none can follow.
  for (const sim::Verdict& verdict : verdicts) {
    if (isStunted(stand, verdict, buds)) buds.push_back({verdict.site.plant, 0, 0, stand.iteration + 1});
  }
  keep(buds, memory);
}

std::size_t countBuds(const sim::Columns& memory) {
  return sim::column<std::int32_t>(memory, kPlant).size();
}

}  // namespace espalier::rules
