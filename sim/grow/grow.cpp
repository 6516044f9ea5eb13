#include "sim/grow/grow.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/sense/intersection.h"

namespace espalier::sim {
namespace {

/// Voxels that were taken earlier in the same iteration, and by the limb of which node.
class Claims {
 public:
  explicit Claims(Voxel size) : taken_(size) {}

  /// A branch and its limb leave their node through the same voxels: beside it they do not hinder each other.
  bool allow(std::span<const Voxel> voxels, const Bud& bud, Voxel start) const {
    return std::none_of(voxels.begin(), voxels.end(), [&](Voxel v) {
      return taken_.at(v) && !(besides(v, start) && owner_.at(key(v)) == nodeOf(bud));
    });
  }
  void takeForLimb(std::span<const Voxel> voxels, const Bud& bud) { take(voxels, nodeOf(bud)); }
  void takeForElement(std::span<const Voxel> voxels) { take(voxels, {-1, kNoNode}); }
  void clear() {
    for (const auto& [packed, owner] : owner_) taken_.clear(unpack(packed));
    owner_.clear();
  }

 private:
  using Node = std::pair<std::int32_t, NodeId>;
  static Node nodeOf(const Bud& bud) { return {bud.plant, bud.node}; }
  void take(std::span<const Voxel> voxels, Node owner) {
    for (const Voxel v : voxels) {
      if (!contains(taken_.size(), v)) throw BrokenContract("a process proposed a voxel outside the world");
      taken_.set(v);
      owner_.emplace(key(v), owner);
    }
  }
  static std::uint64_t key(Voxel v) {
    return (static_cast<std::uint64_t>(v.y) << 42) | (static_cast<std::uint64_t>(v.z) << 21) |
           static_cast<std::uint64_t>(v.x);
  }
  static Voxel unpack(std::uint64_t k) {
    constexpr std::uint64_t kMask = (1u << 21) - 1;
    return {static_cast<int>(k & kMask), static_cast<int>(k >> 42), static_cast<int>((k >> 21) & kMask)};
  }

  BitVolume taken_;
  std::unordered_map<std::uint64_t, Node> owner_;
};

std::uint32_t agentOf(const Bud& bud) {
  return (static_cast<std::uint32_t>(bud.node) << 1) | (bud.side ? 1u : 0u);
}

void requireFree(const World& world, const Planting& planting, Vec3 seed_vx) {
  const Voxel v = voxelAt(seed_vx);
  const Vec3 m = worldFromVoxel(world.frame(), seed_vx);
  if (!contains(world.frame().size, v)) {
    throw InputError(fmt::format("a seed of '{}' at [{:.3f}, {:.3f}, {:.3f}] lies outside the world",
                                 planting.name, m.x, m.y, m.z));
  }
  if (const PartId part = world.partAt(v); part != kFree) {
    throw InputError(
        fmt::format("a seed of '{}' at [{:.3f}, {:.3f}, {:.3f}] lies inside '{}' ({}); move it into the open",
                    planting.name, m.x, m.y, m.z, world.part(part).object, world.part(part).region));
  }
}

/// A plant while it grows.
struct Growing {
  Plant plant;
  const Rule* rule = nullptr;
  std::vector<std::vector<NodeId>> children;  // of each node
};

void addNode(Growing& growing, NodeId parent, int iteration, const Proposal& p) {
  Skeleton& s = growing.plant.skeleton;
  if (parent != kNoNode) growing.children[static_cast<std::size_t>(parent)].push_back(s.size());
  growing.children.emplace_back();
  s.parent.push_back(parent);
  s.position_vx.push_back(p.to_vx);
  s.born.push_back(iteration);
  s.exposure.push_back(p.exposure);
  s.sky_exposure.push_back(p.sky_exposure);
  s.sun_exposure.push_back(p.sun_exposure);
  s.proximity_vx.push_back(p.proximity_vx);
}

/// Everything that changes from one iteration to the next.
struct State {
  std::vector<Growing> plants;
  std::vector<Bud> buds;  // sorted by (plant, node, tip before side)
};

State plantSeeds(World& world, const std::vector<Planting>& plantings) {
  State state;
  for (const Planting& planting : plantings) {
    for (std::size_t i = 0; i < planting.seeds_vx.size(); ++i) {
      requireFree(world, planting, planting.seeds_vx[i]);
      const auto number = static_cast<std::int32_t>(state.plants.size());
      Growing growing{planting.rule->seedling(), planting.rule, {}};
      Plant& plant = growing.plant;
      plant.name = planting.seeds_vx.size() == 1 ? planting.name : fmt::format("{} {}", planting.name, i + 1);
      plant.stem_part = world.addPart({plant.name, "stem", PartKind::stem, number});
      for (const ElementShape& shape : plant.shapes) {
        plant.element_parts.push_back(world.addPart({plant.name, shape.name, PartKind::element, number}));
      }
      Proposal seed;
      seed.to_vx = planting.seeds_vx[i];
      addNode(growing, kNoNode, 0, seed);
      state.plants.push_back(std::move(growing));
      state.buds.push_back({number, 0, false, 0});
    }
  }
  return state;
}

Voxel voxelOf(const Bud& bud, const State& state) {
  const Skeleton& skeleton = state.plants[static_cast<std::size_t>(bud.plant)].plant.skeleton;
  return voxelAt(skeleton.position_vx[static_cast<std::size_t>(bud.node)]);
}

std::vector<Voxel> voxelsOf(const std::vector<Bud>& buds, const State& state) {
  std::vector<Voxel> voxels;
  for (const Bud& bud : buds) voxels.push_back(voxelOf(bud, state));
  return voxels;
}

void occupyWith(std::vector<TiledVoxel>& edit, std::span<const Voxel> voxels, const Surface& surface) {
  for (const Voxel v : voxels) edit.push_back({v, surface});
}

/// Grows a proposal's segment and those of its elements that nobody else's claim hinders.
void accept(Growing& growing, const Bud& bud, Proposal& proposal, int iteration, Claims& claims,
            std::vector<TiledVoxel>& edit) {
  Plant& plant = growing.plant;
  claims.takeForLimb(proposal.voxels, bud);
  occupyWith(edit, proposal.voxels,
             {plant.stem_part, plant.stem_colour,
              static_cast<float>(std::min(1.0, 2.0 * plant.stem_radius_vx)), Vec3f(0.0f)});
  const NodeId node = plant.skeleton.size();
  addNode(growing, bud.node, iteration, proposal);
  for (ProposedElement& leaf : proposal.elements) {
    const Voxel start = voxelAt(leaf.element.position_vx);
    if (!claims.allow(leaf.voxels, bud, start)) continue;
    claims.takeForElement(leaf.voxels);
    leaf.element.node = node;
    leaf.element.born = iteration;
    const auto shape = static_cast<std::size_t>(leaf.element.shape);
    occupyWith(
        edit, leaf.voxels,
        {plant.element_parts[shape], plant.shapes[shape].colour, leaf.coverage, Vec3f(leaf.element.z)});
    plant.elements.push_back(leaf.element);
  }
}

}  // namespace

Growth grow(World& world, const std::vector<Planting>& plantings, const GrowthSettings& settings) {
  Growth growth;
  State state = plantSeeds(world, plantings);
  Claims claims(world.frame().size);
  const LightSensor sensor(world.opaque(), settings.random_sky ? DirectionSet{} : settings.sky, settings.sun);
  std::size_t segments = 0;

  for (int iteration = 0; iteration < settings.iterations && !state.buds.empty(); ++iteration) {
    std::vector<Bud> due, next;
    for (const Bud& bud : state.buds) (bud.due <= iteration ? due : next).push_back(bud);

    const std::vector<Voxel> places = voxelsOf(due, state);
    std::vector<Light> lights = sensor.at(world.opaque(), places);
    if (settings.random_sky) {
      parallelFor(places.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          lights[i].sky = lookOut(world.opaque(), places[i], *settings.random_sky, settings.weighting);
      });
    }
    std::vector<Proposal> proposals(due.size());
    parallelFor(due.size(), 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end && !settings.stop.stop_requested(); ++i) {
        const Bud& bud = due[i];
        const Growing& growing = state.plants[static_cast<std::size_t>(bud.plant)];
        const GrowthView view{
            world,     growing.plant,           growing.children, lights[i], settings.sky_table,
            iteration, settings.record_attempts};
        const RandomKey key{settings.seed, static_cast<std::uint32_t>(bud.plant), agentOf(bud),
                            static_cast<std::uint32_t>(iteration)};
        proposals[i] = growing.rule->propose(view, bud, key);
      }
    });

    if (settings.stop.stop_requested()) throw Stopped();

    std::vector<TiledVoxel> edit;
    for (std::size_t i = 0; i < due.size(); ++i) {
      const Bud& bud = due[i];
      Proposal& proposal = proposals[i];
      Growing& growing = state.plants[static_cast<std::size_t>(bud.plant)];
      const Skeleton& skeleton = growing.plant.skeleton;
      const Voxel start = voxelOf(bud, state);
      if (proposal.outcome == Outcome::grown && !claims.allow(proposal.voxels, bud, start)) {
        proposal.outcome = Outcome::claimed;
        proposal.retire = false;
        for (Attempt& attempt : proposal.attempts) attempt.taken = false;
      }
      if (proposal.outcome == Outcome::grown) {
        accept(growing, bud, proposal, iteration, claims, edit);
        ++segments;
        for (const Sprout& sprout : proposal.sprouts) {
          next.push_back({bud.plant, skeleton.size() - 1, sprout.side, iteration + sprout.wait});
        }
      } else if (!proposal.retire) {
        next.push_back({bud.plant, bud.node, bud.side, iteration + 1});
      }
      ++growth.buds[static_cast<std::size_t>(proposal.outcome)];
      for (std::size_t k = 0; k < kOutcomes; ++k) growth.trials[k] += proposal.trials[k];
      growth.attempts.insert(growth.attempts.end(), proposal.attempts.begin(), proposal.attempts.end());
    }
    world.occupy(edit);
    claims.clear();
    std::sort(next.begin(), next.end(), [](const Bud& a, const Bud& b) {
      return std::tie(a.plant, a.node, a.side) < std::tie(b.plant, b.node, b.side);
    });
    state.buds = std::move(next);
    growth.iterations = iteration + 1;
    if (settings.progress)
      settings.progress({iteration + 1, settings.iterations, segments, state.buds.size()});
  }
  for (Growing& growing : state.plants) growth.plants.push_back(std::move(growing.plant));
  return growth;
}

}  // namespace espalier::sim
