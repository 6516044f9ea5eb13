#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rules/front/attractors.h"
#include "rules/language/rule_set.h"

/// The front of space colonization (Runions et al. 2007; Tanaka et al. 2022, section 3; ours where they leave
/// it open). In each iteration every node that attractors act on sends a new one a step their way; then
/// attractors go over to nodes that have come nearer, and those that were reached end.
///
/// No stalls: a node that was pulled by the same attractors when it last grew would only grow the same again.
/// So would one that is pulled evenly from all sides. Such a node goes straight for its nearest attractor; if
/// even so the same ones pull it still, or no step leads nearer as it is within half a step, that attractor
/// is given up.
///
/// Veins that meet (Acts::on_all_neighbours; Runions et al. 2005, section 3.3; ours where they leave it
/// open): a relative neighbour of an attractor s is a node v within reach of it such that no other node u is
/// nearer to s and to v than they are to each other: max(|u - s|, |u - v|) < |v - s|. An attractor pulls all
/// of its relative neighbours that are not within their kill distance of it. A node that stands within its
/// kill distance of s, sent by one that s pulled, has arrived. An attractor ends when it pulls none and one
/// of its relative neighbours is within the kill distance. Then those that arrived meet: the one of the
/// lowest number stays, and in the next iteration each of the others sends a node to the place where that one
/// stands, but where one is the other's parent or both have the same. On such nodes nothing acts. What stalls
/// or finds no way lets go of an attractor by itself: others are pulled on, and after kMostLetGo times it is
/// given up.
///
/// Waves: attractors may come later. When nothing has moved for an iteration, those of the next wave come,
/// and all nodes meet them as if they had just grown.
///
/// The trunk: a plant that no attractor has been in reach of yet grows straight up (or down) as long as that
/// leads nearer to the nearest attractor, and else towards it.
namespace espalier::rules {

struct FrontRules {
  double step = 1.0;       ///< D, above 0
  double influence = 1.0;  ///< R_m: an attractor acts on nodes that are nearer than this
  double kill = 0.0;       ///< D_k: an attractor ends when a node is nearer than this
  Acts acts = Acts::on_nearest_node;
  bool onto = false;  ///< new nodes stand on attractors, which are used up by it (Tanaka 4.2)
  /// A node is a start again and again (Tanaka, figure 6): it grows towards each attractor that acts on it;
  /// with on_every_node, all that pick an attractor grow towards it, which is many.
  bool repeated = false;
  int iteration = 0;  ///< for noting when attractors end
};

/// A segment's order: 0 where it goes on from the start, and one more than its limb's where it leaves a node
/// from which another went on before. Rules are told apart for trunk, branches and twigs.
inline constexpr std::int32_t kTwig = 2;

/// Rules by order; `acts`, `onto` and `repeated` are the trunk's.
struct OrderRules {
  std::array<FrontRules, kTwig + 1> of_order;

  OrderRules(const FrontRules& all) : of_order{all, all, all} {}  // NOLINT: one for all is the plain case
  const FrontRules& trunk() const { return of_order[0]; }
  const FrontRules& at(std::int32_t order) const {
    return of_order[static_cast<std::size_t>(std::min(order, kTwig))];
  }
};

/// How a node grew when it last did.
enum class Gait : std::int32_t {
  none,
  pulled,    ///< by all its attractors
  straight,  ///< for one of them
  spent      ///< with on_every_node: its pick cannot be come to from it, and it picks no other
};

/// Pairs of nodes that meet: which of them sends a node, and whereto.
struct Meetings {
  std::vector<std::int32_t> from, to;
};

/// What an attractor does to a relative neighbour.
enum class Link : std::int32_t {
  pulls,
  let_go,  ///< the node has let go of it
  near     ///< the node stood within its kill distance when it met it
};

/// Relative neighbours of attractors that wait, by the attractors' numbers and then by nodes.
struct Links {
  std::vector<std::int32_t> attractor, node;
  std::vector<std::int32_t> state;  ///< Link
  // Nodes that arrived at attractors that wait still, in the same order, and what sent them.
  std::vector<std::int32_t> arrived_at, arrived, arrived_from;
  Meetings meetings;  ///< that are to come
};

/// All that the front remembers, in plain arrays. A node's number is its place in `nodes`: the older, the
/// lower.
struct Front {
  Attractors attractors;
  std::vector<sim::Vec3> nodes;
  Pulls pulls;
  std::vector<std::int32_t> tried;  ///< how many attractors pulled it when it last grew; with on_every_node
                                    ///< the number of the one that it picks, or kNobody
  std::vector<std::int32_t> gait;   ///< Gait
  std::vector<std::int32_t> order;  ///< of the segment that ends in it
  std::vector<std::int32_t> sent;   ///< how many nodes it has sent out
  // With on_every_node, by the attractors' numbers: the nearest of those that pick it, and how far that is.
  std::vector<std::int32_t> picker;
  std::vector<double> picked2;
  std::vector<std::int32_t> moved;  ///< one: the last iteration in which anything was sent anywhere
  Links links;                      ///< with on_all_neighbours
};

/// Where a node would go.
struct Way {
  std::int32_t node = 0;
  std::uint32_t number = 0;          ///< which of its ways
  sim::Vec3 direction{0.0};          ///< unit
  std::int32_t attractor = kNobody;  ///< its number, if it goes for one alone
  bool trunk = false;                ///< towards a crown that is not in reach yet
};

Front frontOf(std::span<const sim::Vec3> attractors);

/// Those that are to come, each once, ascending; none is left.
Meetings takeMeetings(Front& front);

struct NewNode {
  sim::Vec3 at{0.0};
  std::int32_t from = kNobody;  ///< kNobody: a start
  bool meets = false;           ///< another stands there already: nothing acts on this one
};
/// Adds nodes, in their order, and lets the attractors meet them.
void join(Front& front, std::span<const NewNode> nodes, const OrderRules& rules);

/// Those of a wave above 0 do not wait yet. Waves by the attractors' numbers.
void holdBack(Front& front, std::span<const std::int32_t> waves);
/// The first wave that has not come; none where all have.
std::optional<std::int32_t> comingWave(const Front& front, std::span<const std::int32_t> waves);
/// Its attractors come.
void bringWave(Front& front, std::span<const std::int32_t> waves, std::int32_t wave);
/// By how many times influence and kill distance are longer while this is the last wave that has come.
double reachIn(std::span<const std::int32_t> waves, std::int32_t wave);
/// Nodes meet attractors that came after them. Numbers, ascending.
void meetAgain(Front& front, std::span<const std::int32_t> nodes, const OrderRules& rules);

/// Of what would grow from a node next.
inline std::int32_t nextOrder(const Front& front, std::int32_t node) {
  const auto n = static_cast<std::size_t>(node);
  return front.order[n] + (front.sent[n] > 0 ? 1 : 0);
}

/// The ways of those of the nodes on which something acts, in their order; `active`, ascending, loses the
/// others. Nodes that stall are dealt with.
std::vector<Way> waysOf(Front& front, std::vector<std::int32_t>& active, const OrderRules& rules);

/// The way of a plant that nothing was in reach of, from its newest node; none (node is kNobody) where an
/// attractor is in reach now, none waits any more, or no step leads nearer.
Way trunkWay(const Front& front, std::int32_t tip, const OrderRules& rules);

/// Where a way ends.
struct Goal {
  sim::Vec3 end{0.0};
  std::int32_t attractor = kNobody;  ///< the number of the one that it goes for, if it goes for one alone
};
/// That of a way which is gone in a direction of its own or another: a step farther, or with rules.onto on
/// the attractor of its node that is nearest to there.
Goal goalOf(const Front& front, const Way& way, sim::Vec3 direction, const OrderRules& rules);

/// A node stands at the end of a way: with rules.onto the attractor there is used up. To be called before the
/// new one joins.
void taken(Front& front, std::int32_t attractor, const OrderRules& rules);

/// A node cannot grow any more: what it was pulled by waits for the next that comes within reach.
void giveUp(Front& front, std::int32_t node, const OrderRules& rules);

/// A node could only grow aside, and what pulls it is no nearer to the new one: the new one has a try at all
/// of it that is within its reach. To be called after that has joined.
void handOver(Front& front, std::int32_t node, std::int32_t to, const OrderRules& rules);

/// A node went for an attractor alone and cannot come to it: that one waits for another. To be called after
/// all that grew has joined; nothing happens if another has it by then.
void giveUpOne(Front& front, std::int32_t node, std::int32_t attractor, const OrderRules& rules);

/// A node has not grown though it could: it will try the same again.
void keepForLater(Front& front, std::int32_t node);

/// Throws BrokenContract for a number that no node has.
void requireNodes(const Front& front, std::span<const std::int32_t> numbers);
/// Throws sim::InputError for lengths that are no numbers, a step and an influence radius of 0 or less, and a
/// kill distance below 0.
void requireSound(const FrontRules& rules);

/// How many attractors there are of each Fate.
struct Fates {
  std::size_t waiting = 0, reached = 0, given_up = 0, taken = 0;  ///< what comes later waits, too
};
Fates fatesOf(std::span<const std::int32_t> fate);

/// Why growth ended, in words. `moves`: it was still going on.
std::string endingOf(const Fates& fates, bool moves);

}  // namespace espalier::rules
