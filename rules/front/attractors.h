#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/vec.h"

/// Attractors, sorted in space so that only those are looked at that a new node can reach. Distances are in
/// whatever unit the places have.
namespace espalier::rules {

/// What became of an attractor.
enum class Fate : std::int32_t {
  waiting,   ///< it pulls, or would if a node came within reach
  reached,   ///< a node came within its kill distance
  given_up,  ///< it pulled where no step led nearer
  taken,     ///< a node stands on it
  later      ///< it comes with a later wave
};

inline constexpr std::int32_t kNobody = -1;

/// Of a number that is not kNobody.
inline std::size_t asIndex(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

/// The most attractors in a leaf of their tree.
inline constexpr std::int32_t kMostInLeaf = 32;

/// A squared distance whose bits do not change when axes are exchanged or turned round.
double distance2(sim::Vec3 a, sim::Vec3 b);

/// Arrays by attractor, sorted along a space-filling curve, and an octree over them whose leaves are runs of
/// a few; in each leaf those that wait come first. Each remembers the nearest of the nodes so far that were
/// within reach, and how far that is: nodes are only added and attractors only end, so nothing else changes
/// it.
struct Attractors {
  std::vector<double> x, y, z;
  std::vector<double> nearest2;       ///< squared distance from its node; infinite where it has none
  std::vector<std::int32_t> nearest;  ///< that node, or kNobody
  std::vector<std::int32_t> number;   ///< as which it was given
  std::vector<std::int32_t> fate;     ///< Fate
  std::vector<std::int32_t> let_go;   ///< how often a node let go of it
  std::vector<std::int32_t> ended;    ///< Reach::iteration in which it stopped waiting; -1 while it waits
  std::vector<std::int32_t> place;    ///< by number: where it lies now; they move within their leaves

  // The tree, parents before their children.
  std::vector<std::int32_t> first, last;      ///< the run of a tree node: first, and one behind its end
  std::vector<std::int32_t> waiting;          ///< of a leaf: how many wait; of others 0
  std::vector<std::int32_t> child, children;  ///< number of its first child, and how many; 0 for a leaf
  std::vector<sim::Vec3> low, high;           ///< of a box around all in it
  std::vector<double> farthest2;              ///< greatest nearest2 of those that wait; below 0: none waits

  std::int32_t size() const { return static_cast<std::int32_t>(x.size()); }
  sim::Vec3 at(std::int32_t i) const {
    const auto n = static_cast<std::size_t>(i);
    return {x[n], y[n], z[n]};
  }
};

/// Sorts them, all waiting for nobody. The places must be finite.
Attractors sortedAttractors(std::span<const sim::Vec3> places);

/// How the nodes that came last act: on attractors nearer than `influence`; those nearer than `kill` are
/// reached.
struct Reach {
  double influence = 0.0, kill = 0.0;
  int iteration = 0;  ///< in which they grew
};

/// One unit of pull, in the whole numbers that pulls are summed in: so that a sum needs no order.
inline constexpr double kPullOne = 0x1p40;

/// What pulls each node: the sum of the unit vectors to the attractors whose nearest it is, and how many they
/// are.
struct Pulls {
  std::vector<std::int64_t> x, y, z;
  std::vector<std::int32_t> count;
};

/// New nodes take over the attractors to which they are nearer than all before and than their reach; of
/// equally near ones the first has it. Those within the kill distance end. `fresh`: their numbers, ascending.
/// Parallel inside.
void meet(Attractors& attractors, std::span<const sim::Vec3> nodes, std::span<const std::int32_t> fresh,
          Reach reach, Pulls& pulls);

/// The nearest attractor that waits, nearer than `within`; of those of one node alone, if it is not kNobody.
/// Equally near ones by their places: the least x, then y, then z. Its index, or kNobody.
std::int32_t nearestWaiting(const Attractors& attractors, sim::Vec3 to, double within,
                            std::int32_t of_node = kNobody);

/// The nearest attractor, whatever became of it; equally near ones as above. kNobody where there is none.
std::int32_t nearestOfAll(const Attractors& attractors, sim::Vec3 to);

/// The attractor that is nearest to one of them, whatever became of it. Indices; kNobody where there is but
/// one.
std::int32_t nearestOther(const Attractors& attractors, std::int32_t at);

/// The attractors that wait for a node which stands at `at`, nearer to it than `within`, by their places: the
/// least x first, then y, then z. Their indices.
std::vector<std::int32_t> waitingFor(const Attractors& attractors, std::int32_t node, sim::Vec3 at,
                                     double within);

/// Ends an attractor, and its pull; `at` is its index, and after this another's.
void end(Attractors& attractors, std::int32_t at, Fate fate, int iteration, std::span<const sim::Vec3> nodes,
         Pulls& pulls);

/// One of a later wave comes, and waits for nobody. `at` is its index, and may be another's after this.
void bring(Attractors& attractors, std::int32_t at);

/// Adds an attractor's pull to what pulls a node, or takes it away: sign 1 or -1. Several threads may do so
/// at once.
void addPull(Pulls& pulls, std::int32_t node, sim::Vec3 node_at, sim::Vec3 attractor_at, int sign);

/// How often an attractor waits for another node before it is given up: where none can come to it, those that
/// try would go on for ever.
inline constexpr std::int32_t kMostLetGo = 16;

/// An attractor's node, if it has one, lets go of it: it waits for the next that comes within reach. `at` is
/// its index, and may be another's after this.
void letGoOf(Attractors& attractors, std::int32_t at, std::span<const sim::Vec3> nodes, int iteration,
             Pulls& pulls);

/// A node lets go of all its attractors: they wait for the next that comes within reach.
void letGo(Attractors& attractors, std::int32_t node, std::span<const sim::Vec3> nodes, Reach reach,
           Pulls& pulls);

}  // namespace espalier::rules
