#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "sim/base/random.h"
#include "sim/grow/plant.h"
#include "sim/light/brightest.h"
#include "sim/light/light.h"
#include "sim/world/world.h"

namespace espalier::sim {

/// Why a bud did or did not grow, and why a trial was rejected.
enum class Outcome {
  grown,
  resting,  ///< dimmer light, slower growth: not this iteration
  blocked,  ///< intersects something
  too_far,  ///< from the scene
  too_near,
  too_dark,
  too_bright,
  out_of_world,
  forbidden,  ///< the nearest region allows no growth
  claimed,    ///< another bud took a voxel first in the same iteration
  no_trial    ///< none of a bud's trials met the rules
};
inline constexpr std::size_t kOutcomes = 11;
std::string_view nameOf(Outcome outcome);

using OutcomeCounts = std::array<std::uint64_t, kOutcomes>;

/// A place on a plant that may still grow: the tip of a limb, or the side of a node where a branch may leave.
struct Bud {
  std::int32_t plant = 0;
  NodeId node = 0;
  bool side = false;
  std::int32_t due = 0;  ///< the iteration in which it next tries
};

/// What a rule may read while it proposes: frozen for the iteration.
struct GrowthView {
  const World& world;
  const Plant& plant;
  const std::vector<std::vector<NodeId>>& children;  ///< of each of the plant's nodes
  const Light& light;                                ///< at the bud
  const SkyTable& sky_table;                         ///< for those who look for the brightest spot
  int iteration = 0;
  bool record_attempts = false;
};

struct Attempt {
  Vec3 from_vx{0.0}, to_vx{0.0};
  bool taken = false;
};

struct ProposedElement {
  PlacedElement element;
  std::vector<Voxel> voxels;  ///< free ones that it would occupy
  float coverage = 0.0f;      ///< of each of them
};

/// A bud that a new node brings with it.
struct Sprout {
  bool side = false;
  int wait = 1;  ///< iterations from now
};

/// A bud's best trial, or why there is none.
struct Proposal {
  Outcome outcome = Outcome::no_trial;
  bool retire = true;  ///< if it does not grow: never try again
  Vec3 to_vx{0.0};
  float exposure = 0.0f, sky_exposure = 0.0f, sun_exposure = 0.0f;  ///< at the bud
  float proximity_vx = 0.0f;                                        ///< mean along the segment
  std::vector<Voxel> voxels;  ///< free ones that the segment would occupy
  std::vector<ProposedElement> elements;
  std::vector<Sprout> sprouts;
  OutcomeCounts trials{};         ///< trials by what became of them
  std::vector<Attempt> attempts;  ///< if they are recorded
};

/// A growth process. Const: proposals are made in parallel.
class Rule {
 public:
  virtual ~Rule() = default;
  /// A plant without nodes: its shapes and colours.
  virtual Plant seedling() const = 0;
  virtual Proposal propose(const GrowthView& view, const Bud& bud, const RandomKey& key) const = 0;
};

}  // namespace espalier::sim
