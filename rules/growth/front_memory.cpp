#include "rules/growth/front_memory.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "sim/base/error.h"

namespace espalier::rules {
namespace {

using Whole = std::vector<std::int32_t>;

/// Calls visit(name, vector) for every array of a front.
template <typename Front_, typename Visit>
void forEachArray(Front_& front, Visit visit) {
  auto& a = front.attractors;
  visit("front_x", a.x);
  visit("front_y", a.y);
  visit("front_z", a.z);
  visit("front_nearest2", a.nearest2);
  visit("front_nearest", a.nearest);
  visit("front_number", a.number);
  visit("front_fate", a.fate);
  visit("front_let_go", a.let_go);
  visit("front_ended", a.ended);
  visit("front_place", a.place);
  visit("tree_first", a.first);
  visit("tree_last", a.last);
  visit("tree_waiting", a.waiting);
  visit("tree_child", a.child);
  visit("tree_children", a.children);
  visit("tree_low", a.low);
  visit("tree_high", a.high);
  visit("tree_farthest2", a.farthest2);
  visit("node_at", front.nodes);
  visit("node_pull_x", front.pulls.x);
  visit("node_pull_y", front.pulls.y);
  visit("node_pull_z", front.pulls.z);
  visit("node_pulled_by", front.pulls.count);
  visit("node_tried", front.tried);
  visit("node_gait", front.gait);
  visit("node_order", front.order);
  visit("node_sent", front.sent);
  visit("pick_node", front.picker);
  visit("pick_nearest2", front.picked2);
  visit("front_moved", front.moved);
}

/// Calls visit(name, vector) for what only some fronts have: others are saved and hashed without it.
template <typename Front_, typename Visit>
void forEachLink(Front_& front, Visit visit) {
  auto& links = front.links;
  visit("link_attractor", links.attractor);
  visit("link_node", links.node);
  visit("link_state", links.state);
  visit("link_arrived_at", links.arrived_at);
  visit("link_arrived", links.arrived);
  visit("link_arrived_from", links.arrived_from);
  visit("link_meet_from", links.meetings.from);
  visit("link_meet_to", links.meetings.to);
}

void require(bool sound, const char* what) {
  if (!sound) throw sim::BrokenContract(std::string("a front with ") + what);
}

void requireLengths(const Front& front) {
  const Attractors& a = front.attractors;
  const auto same = [](std::size_t size, std::initializer_list<std::size_t> others) {
    return std::all_of(others.begin(), others.end(), [&](std::size_t other) { return other == size; });
  };
  require(same(a.x.size(), {a.y.size(), a.z.size(), a.nearest2.size(), a.nearest.size(), a.number.size(),
                            a.fate.size(), a.let_go.size(), a.ended.size(), a.place.size()}),
          "attractors whose columns differ in length");
  require(same(a.first.size(), {a.last.size(), a.waiting.size(), a.child.size(), a.children.size(),
                                a.low.size(), a.high.size(), a.farthest2.size()}),
          "a tree whose columns differ in length");
  require(same(front.nodes.size(),
               {front.pulls.x.size(), front.pulls.y.size(), front.pulls.z.size(), front.pulls.count.size(),
                front.tried.size(), front.gait.size(), front.order.size(), front.sent.size()}),
          "nodes whose columns differ in length");
  require(front.picker.size() == front.picked2.size() &&
              (front.picker.empty() || front.picker.size() == a.x.size()),
          "picks whose columns differ in length");
  const Links& links = front.links;
  require(same(links.attractor.size(), {links.node.size(), links.state.size()}) &&
              same(links.arrived_at.size(), {links.arrived.size(), links.arrived_from.size()}) &&
              links.meetings.from.size() == links.meetings.to.size(),
          "links whose columns differ in length");
  require(front.moved.size() == 1, "no word of when it last moved");
}

bool holds(const Attractors& a, std::size_t t, sim::Vec3 p) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(a.low[t][axis] <= p[axis] && p[axis] <= a.high[t][axis])) return false;
  }
  return true;
}

bool between(std::int32_t value, std::int32_t low, std::size_t end) {
  return value >= low && value < static_cast<std::int32_t>(end);
}

void requireSoundTree(const Attractors& a) {
  require(a.first.empty() == a.x.empty(), "a tree of nothing");
  if (a.first.empty()) return;
  require(a.first[0] == 0 && a.last[0] == a.size(), "a tree that does not hold all attractors");
  std::vector<bool> reached(a.first.size());
  reached[0] = true;
  for (std::size_t t = 0; t < a.first.size(); ++t) {
    require(reached[t], "a part of its tree that nothing leads to");
    require(a.first[t] < a.last[t], "an empty part of its tree");
    if (a.children[t] == 0) {
      require(a.waiting[t] >= 0 && a.waiting[t] <= a.last[t] - a.first[t],
              "a leaf in which more wait than are");
      require(a.last[t] - a.first[t] <= kMostInLeaf, "a leaf that is too large");
      for (std::int32_t i = a.first[t]; i < a.last[t]; ++i) {
        const bool waits = a.fate[static_cast<std::size_t>(i)] == static_cast<std::int32_t>(Fate::waiting);
        require(waits == (i < a.first[t] + a.waiting[t]), "attractors out of their order");
        require(holds(a, t, a.at(i)), "an attractor outside of its leaf");
        require(!waits || a.farthest2[t] >= a.nearest2[static_cast<std::size_t>(i)],
                "an attractor that is farther than its leaf says");
      }
      continue;
    }
    require(a.waiting[t] == 0 && a.children[t] > 0 && a.children[t] <= 8 &&
                a.child[t] > static_cast<std::int32_t>(t) && between(a.child[t], 1, a.first.size()) &&
                a.child[t] + a.children[t] <= static_cast<std::int32_t>(a.first.size()),
            "children that are not there");
    std::int32_t at = a.first[t];
    for (std::int32_t c = a.child[t]; c < a.child[t] + a.children[t]; ++c) {
      const auto n = static_cast<std::size_t>(c);
      require(!reached[n] && a.first[n] == at, "children that do not follow each other");
      require(holds(a, t, a.low[n]) && holds(a, t, a.high[n]), "a part that sticks out of its parent");
      require(a.farthest2[t] >= a.farthest2[n], "a part that is farther than its parent says");
      reached[n] = true;
      at = a.last[n];
    }
    require(at == a.last[t], "children that do not hold what their parent does");
  }
}

void requireSoundLinks(const Front& front) {
  const Links& links = front.links;
  const auto all = [](const std::vector<std::int32_t>& numbers, std::size_t end) {
    return std::all_of(numbers.begin(), numbers.end(),
                       [end](std::int32_t number) { return between(number, 0, end); });
  };
  const std::size_t attractors = front.attractors.x.size(), nodes = front.nodes.size();
  require(all(links.attractor, attractors) && all(links.arrived_at, attractors), "links of no attractor");
  require(all(links.node, nodes) && all(links.arrived, nodes) && all(links.arrived_from, nodes) &&
              all(links.meetings.from, nodes) && all(links.meetings.to, nodes) && all(links.state, 3),
          "links of a node that is not there");
  require(std::is_sorted(links.attractor.begin(), links.attractor.end()) &&
              std::is_sorted(links.arrived_at.begin(), links.arrived_at.end()),
          "links out of their order");
}

void requireSoundNumbers(const Front& front) {
  const Attractors& a = front.attractors;
  const auto isPlace = [](double x) { return std::abs(x) < 1e9; };
  for (const sim::Vec3& at : front.nodes)
    require(isPlace(at.x) && isPlace(at.y) && isPlace(at.z), "a node that is nowhere");
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    require(isPlace(a.x[i]) && isPlace(a.y[i]) && isPlace(a.z[i]), "an attractor that is nowhere");
    require(between(a.number[i], 0, a.x.size()) &&
                a.place[static_cast<std::size_t>(a.number[i])] == static_cast<std::int32_t>(i),
            "attractors that are not where they say");
    require(between(a.fate[i], 0, 5), "an attractor of no known fate");
    require(between(a.nearest[i], kNobody, front.nodes.size()), "an attractor of a node that is not there");
  }
  std::vector<std::int32_t> pulled(front.nodes.size());
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    if (a.nearest[i] != kNobody && a.fate[i] == static_cast<std::int32_t>(Fate::waiting))
      ++pulled[static_cast<std::size_t>(a.nearest[i])];
  }
  for (std::size_t i = 0; i < front.links.node.size(); ++i) {
    if (front.links.state[i] == static_cast<std::int32_t>(Link::pulls))
      ++pulled[asIndex(front.links.node[i])];
  }
  require(pulled == front.pulls.count, "nodes that others pull than say so");
  for (const std::int32_t gait : front.gait) require(between(gait, 0, 4), "a node of no known gait");
  for (const std::int32_t order : front.order)
    require(between(order, 0, front.nodes.size()), "a node of no order");
  for (const std::int32_t node : front.picker)
    require(between(node, kNobody, front.nodes.size()), "a pick of a node that is not there");
  // Of nodes that pick an attractor its number, of others how many pulled: plants of both kinds may share it.
  const std::size_t most = a.x.size() + 1;
  for (const std::int32_t tried : front.tried)
    require(between(tried, kNobody, most), "a node that tried what is not there");
}

void readNodes(const sim::Columns& memory, const std::string& what, const sim::StandView& stand,
               std::vector<FrontNode>& nodes) {
  const Whole& front = sim::column<std::int32_t>(memory, what + "_front");
  const Whole& plant = sim::column<std::int32_t>(memory, what + "_plant");
  const Whole& node = sim::column<std::int32_t>(memory, what + "_node");
  require(plant.size() == front.size() && node.size() == front.size(), "columns that differ in length");
  for (std::size_t i = 0; i < front.size(); ++i) {
    require(front[i] >= 0 && between(plant[i], 0, stand.plants.size()) &&
                between(node[i], 0,
                        static_cast<std::size_t>(
                            stand.plants[static_cast<std::size_t>(plant[i])].skeleton.size())),
            "a node that is not there");
    nodes.push_back({front[i], plant[i], node[i]});
  }
}

template <typename Get>
void write(sim::Columns& columns, const std::string& name, const auto& all, Get get) {
  using Number = std::decay_t<decltype(get(all.front()))>;
  auto& values = sim::column<Number>(columns, name);
  values.clear();
  for (const auto& one : all) values.push_back(get(one));
}

void writeNodes(sim::Columns& columns, const std::string& what, const std::vector<FrontNode>& nodes) {
  write(columns, what + "_front", nodes, [](const FrontNode& n) { return n.front; });
  write(columns, what + "_plant", nodes, [](const FrontNode& n) { return n.plant; });
  write(columns, what + "_node", nodes, [](const FrontNode& n) { return n.node; });
}

constexpr std::int32_t kTrunk = 8, kMeets = 16, kMeetsAnother = 32;  // beside the gait
constexpr const char* kWave = "front_wave";

/// An errand's last number is the attractor that it goes for, or of the node that it meets.
std::int32_t howOf(const Errand& errand) {
  return static_cast<std::int32_t>(errand.gait) | (errand.trunk ? kTrunk : 0) |
         (errand.meets != sim::kNoNode ? kMeets : 0) | (errand.meets_another != kNobody ? kMeetsAnother : 0);
}
std::int32_t goalNumberOf(const Errand& errand) {
  if (errand.meets_another != kNobody) return errand.meets_another;
  return errand.meets != sim::kNoNode ? errand.meets : errand.attractor;
}
Errand unpackedErrand(const FrontNode& from, std::int32_t number, std::int32_t how, sim::Vec3 direction,
                      sim::Vec3 end_vx, std::int32_t goal) {
  const bool meets = (how & kMeets) != 0, another = (how & kMeetsAnother) != 0;
  return {from,
          static_cast<std::uint32_t>(number),
          static_cast<Gait>(how & (kTrunk - 1)),
          (how & kTrunk) != 0,
          direction,
          end_vx,
          meets || another ? kNobody : goal,
          meets ? goal : sim::kNoNode,
          another ? goal : kNobody};
}

}  // namespace

std::string attractorsNamed(const std::string& name) {
  return "attractors " + name;
}

LentFront::LentFront(sim::Columns& columns) : columns_(columns) {
  forEachArray(front, [&](const char* name, auto& values) {
    values = std::move(sim::column<typename std::decay_t<decltype(values)>::value_type>(columns_, name));
  });
  forEachLink(front, [&](const char* name, auto& values) {
    if (columns_.contains(name)) values = std::move(sim::column<std::int32_t>(columns_, name));
  });
  requireLengths(front);
}

LentFront::~LentFront() {
  forEachArray(front, [&](const char* name, auto& values) { columns_[name] = std::move(values); });
  forEachLink(front, [&](const char* name, auto& values) {
    if (!values.empty() || columns_.contains(name)) columns_[name] = std::move(values);
  });
}

bool holdsFront(const sim::Columns& columns) {
  return columns.contains("front_x");
}

Fates fatesIn(const sim::Columns& columns) {
  if (holdsFront(columns)) return fatesOf(sim::column<std::int32_t>(columns, "front_fate"));
  return {.waiting = sim::column<sim::Vec3>(columns, kAttractorPlace).size()};
}

std::string endingIn(const sim::Columns& columns, int iterations, bool by_itself) {
  if (!holdsFront(columns)) return "nothing grows to them";
  const auto& moved = sim::column<std::int32_t>(columns, "front_moved");
  return endingOf(fatesIn(columns), !by_itself && !moved.empty() && moved.front() >= iterations - 1);
}

void requireSoundFronts(const sim::Commons& commons) {
  for (const auto& [name, columns] : commons) {
    if (!holdsFront(columns)) continue;
    sim::Columns copy = columns;
    const LentFront lent(copy);
    const std::size_t count = lent.front.attractors.x.size();
    const std::size_t normals = sim::column<sim::Vec3>(columns, kAttractorNormal).size();
    require(sim::column<sim::Vec3>(columns, kAttractorPlace).size() == count,
            "other attractors than are given");
    require(normals == 0 || normals == count, "normals of other attractors");
    const std::size_t waves = sim::column<std::int32_t>(columns, kAttractorWave).size();
    require(waves == 0 || waves == count, "waves of other attractors");
    requireSoundTree(lent.front.attractors);
    requireSoundLinks(lent.front);
    requireSoundNumbers(lent.front);
  }
}

FrontMemory frontMemory(const sim::Columns& memory, const sim::StandView& stand) {
  FrontMemory read;
  readNodes(memory, "active", stand, read.active);
  readNodes(memory, "trunk", stand, read.trunks);
  std::vector<FrontNode> from;
  readNodes(memory, "errand", stand, from);
  const Whole& number = sim::column<std::int32_t>(memory, "errand_number");
  const Whole& how = sim::column<std::int32_t>(memory, "errand_how");
  const auto& direction = sim::column<sim::Vec3>(memory, "errand_direction");
  const auto& end = sim::column<sim::Vec3>(memory, "errand_end");
  const Whole& attractor = sim::column<std::int32_t>(memory, "errand_attractor");
  require(attractor.size() == from.size() && number.size() == from.size() && how.size() == from.size() &&
              direction.size() == from.size() && end.size() == from.size(),
          "errands whose columns differ in length");
  for (std::size_t i = 0; i < from.size(); ++i) {
    read.errands.push_back(unpackedErrand(from[i], number[i], how[i], direction[i], end[i], attractor[i]));
  }
  if (const Whole& wave = sim::column<std::int32_t>(memory, kWave); !wave.empty()) {
    require(between(wave.front(), 0, 1000), "a wave that is none");
    read.wave = wave.front();
  }
  return read;
}

void keep(const FrontMemory& memory, sim::Columns& columns) {
  writeNodes(columns, "active", memory.active);
  writeNodes(columns, "trunk", memory.trunks);
  std::vector<FrontNode> from;
  for (const Errand& errand : memory.errands) from.push_back(errand.from);
  writeNodes(columns, "errand", from);
  write(columns, "errand_number", memory.errands,
        [](const Errand& e) { return static_cast<std::int32_t>(e.number); });
  write(columns, "errand_how", memory.errands, [](const Errand& e) { return howOf(e); });
  write(columns, "errand_direction", memory.errands, [](const Errand& e) { return e.direction; });
  write(columns, "errand_end", memory.errands, [](const Errand& e) { return e.end_vx; });
  write(columns, "errand_attractor", memory.errands, [](const Errand& e) { return goalNumberOf(e); });
  if (memory.wave > 0) sim::column<std::int32_t>(columns, kWave) = {memory.wave};
}

Errand errandOf(const sim::Columns& memory, const sim::Site& site) {
  const Whole& plant = sim::column<std::int32_t>(memory, "errand_plant");
  const Whole& node = sim::column<std::int32_t>(memory, "errand_node");
  const Whole& number = sim::column<std::int32_t>(memory, "errand_number");
  const auto wanted = std::tuple(site.plant, site.node, static_cast<std::int32_t>(site.number));
  std::size_t low = 0, high = plant.size();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (std::tuple(plant[middle], node[middle], number[middle]) < wanted) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  require(low < plant.size() && std::tuple(plant[low], node[low], number[low]) == wanted,
          "a site that was sent nowhere");
  return unpackedErrand({sim::column<std::int32_t>(memory, "errand_front")[low], site.plant, site.node},
                        static_cast<std::int32_t>(site.number),
                        sim::column<std::int32_t>(memory, "errand_how")[low],
                        sim::column<sim::Vec3>(memory, "errand_direction")[low],
                        sim::column<sim::Vec3>(memory, "errand_end")[low],
                        sim::column<std::int32_t>(memory, "errand_attractor")[low]);
}

std::size_t countFront(const sim::Columns& memory) {
  return sim::column<std::int32_t>(memory, "active_front").size() +
         sim::column<std::int32_t>(memory, "trunk_front").size();
}

}  // namespace espalier::rules
