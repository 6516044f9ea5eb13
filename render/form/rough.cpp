#include "render/form/rough.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <span>
#include <vector>

#include "render/form/fbm.h"
#include "render/form/reshaped.h"
#include "render/model/radii.h"
#include "render/model/stem_curves.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/sense/proximity.h"
#include "sim/tile/tiling.h"

namespace espalier::render {
namespace {

using sim::NodeId;
using sim::Vec3;
using Rough = sim::StemForm::Rough;

constexpr double kMostPieces = 4e6;
constexpr double kSamples = 2.0;  // of the noise, in a piece
constexpr double kEased = 8.0;    // pieces over which a way that may stray goes over to one that may not
constexpr double kLeastShare = 0.0625;  // of the displacement; less is none
constexpr double kLattice = 0x1p20;  // displacements are whole parts of a voxel width: alike on all machines

std::size_t at(NodeId n) {
  return static_cast<std::size_t>(n);
}

/// Where old nodes and their pieces are among the new ones.
struct Pieces {
  std::vector<NodeId> of;           ///< an old node's own place
  std::vector<std::int32_t> count;  ///< of its segment; 0: a seed

  /// The k-th place along an old node's segment, 0 where it begins.
  NodeId place(const sim::Skeleton& old, NodeId n, std::int32_t k) const {
    return k == 0 ? of[at(old.parent[at(n)])] : of[at(n)] - count[at(n)] + k;
  }
};

Pieces piecesOf(const sim::Skeleton& skeleton, double detail_vx) {
  Pieces pieces;
  double sum = 0.0;
  for (NodeId n = 0; n < skeleton.size(); ++n) {
    const NodeId parent = skeleton.parent[at(n)];
    double count = 0.0;
    if (parent != sim::kNoNode) {
      const double length = glm::distance(skeleton.position_vx[at(n)], skeleton.position_vx[at(parent)]);
      count = std::max(1.0, std::round(length / detail_vx));
    }
    sum += std::max(count, 1.0);
    if (!(sum <= kMostPieces)) {
      throw sim::InputError(fmt::format(
          "ways that are rough in pieces of {:.3g} voxel widths have more than {:g} of them; expected longer "
          "ones (detail)",
          detail_vx, kMostPieces));
    }
    pieces.count.push_back(static_cast<std::int32_t>(count));
    pieces.of.push_back(static_cast<NodeId>(sum) - 1);
  }
  return pieces;
}

/// The same ways, cut.
sim::Skeleton cut(const sim::Skeleton& old, const Pieces& pieces) {
  sim::Skeleton skeleton;
  for (const auto& [name, values] : old.columns) skeleton.columns[name];
  for (NodeId n = 0; n < old.size(); ++n) {
    const std::int32_t count = std::max(pieces.count[at(n)], 1);
    for (std::int32_t k = 1; k <= count; ++k) {
      const NodeId parent = old.parent[at(n)];
      const Vec3 to = old.position_vx[at(n)];
      const Vec3 from = parent == sim::kNoNode ? to : old.position_vx[at(parent)];
      skeleton.position_vx.push_back(k == count ? to : glm::mix(from, to, static_cast<double>(k) / count));
      skeleton.parent.push_back(parent == sim::kNoNode ? parent
                                : k > 1                ? static_cast<NodeId>(skeleton.parent.size()) - 1
                                                       : pieces.of[at(parent)]);
      skeleton.born.push_back(old.born[at(n)]);
      for (const auto& [name, values] : old.columns) skeleton.columns[name].push_back(values[at(n)]);
    }
  }
  renumberJoins(
      old, [&](NodeId n) { return pieces.of[at(n)]; }, skeleton);
  return skeleton;
}

/// How far limbs stray, by the distance along each.
class Straying {
 public:
  Straying(const sim::Plant& plant, const Rough& rough)
      : curves_(stemCurves(plant.skeleton, stemRadii(plant.skeleton, plant.girth))) {
    limbs_.resize(curves_.stems.size());
    std::map<std::size_t, FractionalMotion> motions;  // by their number of steps
    for (std::size_t i = 0; i < limbs_.size(); ++i) {
      Limb& limb = limbs_[i];
      const std::vector<NodeId>& nodes = curves_.stems[i].nodes;
      limb.arcs_vx.assign(1, 0.0);
      for (std::size_t k = 1; k < nodes.size(); ++k) {
        limb.arcs_vx.push_back(limb.arcs_vx.back() +
                               glm::distance(plant.skeleton.position_vx[at(nodes[k])],
                                             plant.skeleton.position_vx[at(nodes[k - 1])]));
      }
      limb.steps = static_cast<std::size_t>(std::ceil(kSamples * limb.arcs_vx.back() / rough.detail_vx));
      limb.steps = std::max<std::size_t>(limb.steps, 2);
      const std::size_t most = std::bit_ceil(limb.steps);
      if (!motions.contains(most)) motions.emplace(most, FractionalMotion(rough.hurst, most));
    }
    sim::parallelFor(limbs_.size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto first = static_cast<std::uint32_t>(curves_.stems[i].nodes[1]);
        limbs_[i].bridge =
            bridge(limbs_[i], motions.at(std::bit_ceil(limbs_[i].steps)), rough, {plant.key, first});
      }
    });
    for (std::size_t i = 0; i < limbs_.size(); ++i) {
      const NodeId fork = curves_.stems[i].nodes[0];
      if (!curves_.stems[i].from_seed) limbs_[i].from = of(curves_.stem_of[at(fork)], arcOf(fork));
    }
  }

  /// A node's own place along the limb on which its segment lies.
  double arcOf(NodeId n) const {
    const auto limb = curves_.stem_of[at(n)];
    return limb < 0 ? 0.0 : limbs_[at(limb)].arcs_vx[static_cast<std::size_t>(curves_.parameter_of[at(n)])];
  }
  Vec3 of(std::int32_t limb, double arc_vx) const {
    return limb < 0 ? Vec3(0.0) : limbs_[at(limb)].of(arc_vx);
  }
  /// So far before a node.
  Vec3 before(NodeId n, double far_vx) const { return of(curves_.stem_of[at(n)], arcOf(n) - far_vx); }

 private:
  struct Limb {
    std::vector<double> arcs_vx;  // of its nodes
    std::size_t steps = 0;
    std::vector<Vec3> bridge;  // at even steps
    Vec3 from{0.0};            // the displacement that it starts with

    Vec3 of(double arc_vx) const {
      const double share = arcs_vx.back() > 0.0 ? std::clamp(arc_vx / arcs_vx.back(), 0.0, 1.0) : 1.0;
      const double step = share * static_cast<double>(steps);
      const std::size_t low = std::min(static_cast<std::size_t>(step), steps - 1);
      return (1.0 - share) * from + glm::mix(bridge[low], bridge[low + 1], step - static_cast<double>(low));
    }
  };

  /// Fractional Brownian motion that is known to come back to 0 in the end: each value less what the end lets
  /// expect of it.
  static std::vector<Vec3> bridge(const Limb& limb, const FractionalMotion& motion, const Rough& rough,
                                  const sim::RandomKey& key) {
    const auto last = static_cast<double>(limb.steps);
    const double step_vx = limb.arcs_vx.back() / last;
    const double scale_vx = rough.amplitude_vx * std::pow(step_vx / rough.over_vx, rough.hurst);
    std::vector<Vec3> bridge(limb.steps + 1, Vec3(0.0));
    std::vector<double> follows;
    for (std::size_t k = 0; k <= limb.steps; ++k) {
      follows.push_back(motionCovariance(rough.hurst, static_cast<double>(k), last) /
                        motionCovariance(rough.hurst, last, last));
    }
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<double> way = motion(key, static_cast<unsigned>(axis));
      for (std::size_t k = 0; k <= limb.steps; ++k)
        bridge[k][axis] = scale_vx * (way[k] - follows[k] * way[limb.steps]);
    }
    return bridge;
  }

  StemCurves curves_;
  std::vector<Limb> limbs_;
};

/// A displacement without what leads to or from a surface that is near.
Vec3 alongSurface(const sim::World& world, Vec3 place_vx, Vec3 displacement) {
  const sim::Voxel voxel = sim::voxelAt(place_vx);
  if (world.layers() == 0 || !sim::contains(world.frame().size, voxel)) return displacement;
  const auto near = world.nearnessAt(voxel);
  if (!near) return displacement;
  const double beyond = world.layers() + 1.0;
  const double share =
      std::clamp((beyond - static_cast<double>(near->distance_vx)) / std::max(beyond - 2.0, 1.0), 0.0, 1.0);
  const Vec3 away = sim::awayFromScene(world, voxel);
  return displacement - share * glm::dot(displacement, away) * away;
}

/// How much of its displacement each place may have, so that no piece enters what its straight one does not.
class Room {
 public:
  Room(const sim::Skeleton& straight, const std::vector<Vec3>& displacement, sim::Voxel size,
       const KeptFree& kept_free, double eased_vx)
      : straight_(straight),
        displacement_(displacement),
        size_(size),
        kept_free_(kept_free),
        eased_vx_(eased_vx) {
    shares_.assign(at(straight.size()), 1.0);
  }

  const std::vector<double>& shares() {
    std::vector<char> blocked(shares_.size());
    for (bool any = true; any;) {
      sim::parallelFor(shares_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) blocked[n] = enters(n);
      });
      any = false;
      const std::vector<double> before = shares_;
      for (std::size_t n = 0; n < blocked.size(); ++n) {
        if (blocked[n] == 0) continue;
        any = true;
        for (const std::size_t end : {n, at(straight_.parent[n])})
          shares_[end] = before[end] > kLeastShare ? 0.5 * before[end] : 0.0;
      }
      if (any) ease();
    }
    return shares_;
  }

  Vec3 place(std::size_t n) const {
    const Vec3 strays = glm::round(kLattice * shares_[n] * displacement_[n]) / kLattice;
    return straight_.position_vx[n] + strays;
  }

 private:
  bool enters(std::size_t n) const {
    if (straight_.parent[n] == sim::kNoNode) return false;
    const std::size_t parent = at(straight_.parent[n]);
    if (shares_[n] == 0.0 && shares_[parent] == 0.0) return false;
    const Vec3 from = place(parent), to = place(n);
    if (!sim::holds(size_, from) || !sim::holds(size_, to)) return true;
    std::vector<sim::Voxel> voxels, grown;
    sim::tileSegment(from, to, voxels);
    for (const sim::Voxel voxel : voxels) {
      if (sim::contains(size_, voxel) && !kept_free_(voxel)) continue;
      if (grown.empty()) sim::tileSegment(straight_.position_vx[parent], straight_.position_vx[n], grown);
      if (std::find(grown.begin(), grown.end(), voxel) == grown.end()) return true;
    }
    return false;
  }

  /// Shares rise from a low one no faster than from 0 to 1 in the length that it takes.
  void ease() {
    const auto rise = [&](std::size_t n) {
      const Vec3 way = straight_.position_vx[n] - straight_.position_vx[at(straight_.parent[n])];
      return glm::length(way) / eased_vx_;
    };
    for (std::size_t n = shares_.size(); n-- > 0;) {
      if (straight_.parent[n] == sim::kNoNode) continue;
      double& below = shares_[at(straight_.parent[n])];
      below = std::min(below, shares_[n] + rise(n));
    }
    for (std::size_t n = 0; n < shares_.size(); ++n) {
      if (straight_.parent[n] == sim::kNoNode) continue;
      shares_[n] = std::min(shares_[n], shares_[at(straight_.parent[n])] + rise(n));
    }
  }

  const sim::Skeleton& straight_;
  const std::vector<Vec3>& displacement_;
  sim::Voxel size_;
  const KeptFree& kept_free_;
  double eased_vx_;
  std::vector<double> shares_;
};

/// Moves what is placed on a segment with the piece on which it stands.
void move(sim::PlacedElement& element, const sim::Skeleton& old, const Pieces& pieces,
          const sim::Skeleton& straight, const sim::Skeleton& strayed) {
  const NodeId n = element.node;
  if (n < 0 || n >= old.size()) return;
  const std::int32_t count = pieces.count[at(n)];
  element.node = pieces.of[at(n)];
  if (count == 0) return;
  const Vec3 from = old.position_vx[at(old.parent[at(n)])], way = old.position_vx[at(n)] - from;
  const double length2 = glm::dot(way, way);
  const double share =
      length2 > 0.0 ? std::clamp(glm::dot(element.position_vx - from, way) / length2, 0.0, 1.0) : 1.0;
  const std::int32_t piece = std::clamp(static_cast<std::int32_t>(share * count) + 1, 1, count);
  element.node = pieces.place(old, n, piece);
  const auto moved = [&](std::int32_t k) {
    const std::size_t place = at(pieces.place(old, n, k));
    return strayed.position_vx[place] - straight.position_vx[place];
  };
  element.position_vx += glm::mix(moved(piece - 1), moved(piece), share * count - (piece - 1));
}

}  // namespace

sim::Plant roughened(const sim::Plant& plant, const Rough& rough, const sim::World& world,
                     const KeptFree& kept_free) {
  if (!(rough.amplitude_vx >= 0.0 && rough.over_vx > 0.0 && rough.detail_vx > 0.0))
    throw sim::InputError("how rough a way is must be 0 or more, over a length, in pieces of a length");
  const sim::Skeleton& old = plant.skeleton;
  const Pieces pieces = piecesOf(old, rough.detail_vx);
  const Straying straying(plant, rough);
  sim::Plant result = plant;
  result.skeleton = cut(old, pieces);
  const sim::Skeleton straight = result.skeleton;
  std::vector<Vec3> displacement(straight.position_vx.size(), Vec3(0.0));
  sim::parallelFor(old.parent.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto n = static_cast<NodeId>(i);
      const std::int32_t count = pieces.count[i];
      if (count == 0) continue;
      const double length_vx = glm::distance(old.position_vx[i], old.position_vx[at(old.parent[i])]);
      for (std::int32_t k = 1; k <= count; ++k) {
        const std::size_t place = at(pieces.place(old, n, k));
        const double before_vx = length_vx * static_cast<double>(count - k) / count;
        displacement[place] = alongSurface(world, straight.position_vx[place], straying.before(n, before_vx));
      }
    }
  });
  Room room(straight, displacement, world.frame().size, kept_free, kEased * rough.detail_vx);
  room.shares();
  for (std::size_t n = 0; n < displacement.size(); ++n) result.skeleton.position_vx[n] = room.place(n);
  meetAgain(result.skeleton);
  for (sim::PlacedElement& element : result.elements) move(element, old, pieces, straight, result.skeleton);
  return result;
}

}  // namespace espalier::render
