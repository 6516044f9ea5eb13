#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "sim/base/random.h"
#include "sim/grow/columns.h"
#include "sim/grow/kin.h"
#include "sim/grow/plant.h"
#include "sim/light/brightest.h"
#include "sim/light/light.h"
#include "sim/sense/intersection.h"
#include "sim/sense/piece_grid.h"
#include "sim/world/world.h"

/// What a growth process is: how random walk, diffusion, colonization or cracks tell the house what they want
/// to place, and how they hear what came of it. docs/house.md has a worked example.
namespace espalier::sim {

/// What became of a site, and why a trial was rejected.
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
  claimed,    ///< another site took a voxel first in the same iteration
  no_trial,   ///< none of a site's trials met the rules
  unmet       ///< what a site senses is not what its rules require
};
inline constexpr std::size_t kOutcomes = 12;
std::string_view nameOf(Outcome outcome);

using OutcomeCounts = std::array<std::uint64_t, kOutcomes>;
inline std::uint64_t timesOf(const OutcomeCounts& counts, Outcome outcome) {
  return counts[static_cast<std::size_t>(outcome)];
}

/// A place where something may grow: the tip of a limb, the side of a node, a spot beside a paving tile.
struct Site {
  std::int32_t plant = 0;    ///< within its planting
  NodeId node = 0;           ///< to which a segment would be joined, and on which an element would stand
  std::uint32_t number = 0;  ///< below 2^24: which of the node's sites: as many as the process likes
  Vec3 at_vx{0.0};           ///< where light is sensed and segments begin; inside the world

  friend bool operator==(const Site&, const Site&) = default;
};

/// A trial of which somebody may want to know.
struct Attempt {
  Vec3 from_vx{0.0}, to_vx{0.0};
  Outcome outcome = Outcome::grown;  ///< grown: it met the rules, but perhaps another one was better
  bool taken = false;                ///< it became a segment
};

struct ProposedSegment {
  Vec3 to_vx{0.0};                    ///< where the new node would stand
  std::vector<Voxel> takes;           ///< what sim::fit gave
  Passage passage = Passage::around;  ///< through: what was accepted earlier does not hinder it
  std::vector<float> quantities;  ///< of the new node: one a column of the plant, in the order of their names
};

struct ProposedElement {
  PlacedElement element;  ///< node and born are filled in when it is placed
  /// Voxels inside the world that it adds its coverage to: those that its polygons lie in and that are not of
  /// the scene, whatever of plants stands there. They hinder nobody of its plant.
  std::vector<Voxel> takes;
  Passage passage = Passage::around;  ///< through: what was accepted earlier does not hinder it
  float coverage = 0.0f;              ///< of each voxel that it takes
};

/// A site that a new node brings with it. The house does nothing with it: the process finds it in the verdict
/// and takes it up in settle().
struct Sprout {
  std::uint32_t number = 0;
  int wait = 1;  ///< iterations from now
};

/// What a site would place, or why it would not.
struct Proposal {
  Outcome outcome = Outcome::no_trial;
  bool retire = true;  ///< if it does not grow: never try again; for settle(), as sprouts are
  std::optional<ProposedSegment> segment = std::nullopt;
  /// On the segment, or on the site's node where there is none. Those that clash with what was accepted
  /// earlier in the iteration are left out.
  std::vector<ProposedElement> elements = {};
  std::vector<Sprout> sprouts = {};
  OutcomeCounts trials{};              ///< trials by what became of them
  std::vector<Attempt> attempts = {};  ///< if they are recorded
};

/// What became of a proposal.
struct Verdict {
  Site site;
  const Proposal* proposal = nullptr;
  Outcome outcome = Outcome::no_trial;  ///< the proposal's own, or claimed if nothing of it could be placed
  NodeId node = kNoNode;                ///< the new one, if a segment grew
  std::size_t first_element = 0;        ///< in Plant::elements: the first of those that were placed
  std::size_t elements = 0;             ///< how many were
};

/// What plantings share: attractors, fields, by the names that the scene gives them. They belong to none.
/// begin, due and settle of each planting see what those of the plantings before it left.
using Commons = std::map<std::string, Columns, std::less<>>;

/// All that a process may read of its planting when it is asked or told something serially.
struct StandView {
  const World& world;
  std::span<const Plant> plants;  ///< its own, one a seed
  std::span<const Kin> kin;       ///< of each of them
  int iteration = 0;              ///< this one, from 0
};

/// What a process may read while it proposes: frozen for the iteration.
struct SiteView {
  const World& world;
  const Plant& plant;
  const Kin& kin;
  const Columns& memory;
  const Commons& commons;
  const PieceGrid& pieces;         ///< limbs and elements of all plants, to be tested exactly
  const Light* light = nullptr;    ///< at the site, if the process wants it
  const SkyInside* sky = nullptr;  ///< who knows the sky's brightest spot, if the process wants its table
  int iteration = 0;
  bool record_attempts = false;
  std::span<const Plant> stand = {};  ///< all plants of its planting
};

/// What must be sensed for a process: nobody pays for what nobody asks for.
struct Wants {
  bool light = false;
  bool sky_table = false;  ///< the brightest way by a table of the sky
};

/// A growth process, with all its parameters: const, and one for a planting. What it knows from one iteration
/// to the next is in `memory`, which is its own and empty before begin(), and in `commons`; nowhere else, as
/// nothing else is hashed, saved and gone on with.
///
/// In each iteration (design: the tick) the house calls
///   due        serially, planting by planting; may be parallel inside;
///   propose    in parallel over all sites of all plantings, with world, plants, memory and commons frozen;
///   settle     serially, planting by planting, after the proposals were accepted one by one in the order
///              (planting, plant, node, number) against what was claimed before them; may be parallel inside;
///   goesOn     those that have more to place in this iteration are asked all of it again.
class Process {
 public:
  virtual ~Process() = default;

  virtual Wants wants() const = 0;
  /// A plant without nodes: its shapes, its colours, and its columns, empty. The seed's own row of them is 0.
  virtual Plant seedling() const = 0;
  /// Plants have been seeded, and nothing has grown: the beginning of memory. Not called for growth that goes
  /// on from a state.
  virtual void begin(const StandView& stand, Columns& memory, Commons& commons) const = 0;
  /// The sites that propose in this iteration, in ascending order of (plant, node, number), each once.
  virtual std::vector<Site> due(const StandView& stand, Columns& memory, Commons& commons) const = 0;
  /// What one of them would place. Random numbers must follow from the key alone. A segment's voxels are
  /// those that sim::fit gave, in the world as it is frozen. What stands is the process's own concern: it
  /// asks sim::fit, and view.pieces for what must be exact. What is accepted before it in the same iteration
  /// is the house's: of pieces that do not go through, a segment is left out (and all of its proposal with
  /// it) where it shares a voxel with a segment (of another plant, if it goes past its own) or pierces an
  /// element of another plant, an element where its polygons cross another's or a segment pierces them.
  virtual Proposal propose(const SiteView& view, const Site& site, const RandomKey& key) const = 0;
  /// Whether a proposal may stand beside those of its planting that were accepted before it in the same
  /// iteration, `accepted`, when its segment is not hindered: for what the house does not know of.
  virtual bool agrees(const Proposal& proposal, std::span<const Proposal* const> accepted) const {
    return static_cast<void>(proposal), static_cast<void>(accepted), true;
  }
  /// What became of each proposal, in the sites' order. The stand has already grown, new nodes and elements
  /// of a plant in this order too; its iteration is still the one in which they were proposed.
  virtual void settle(const StandView& stand, std::span<const Verdict> verdicts, Columns& memory,
                      Commons& commons) const = 0;
  /// Whether it would place more within this very iteration, on what has just grown: then the house asks it
  /// again, due, propose and settle, before the iteration ends. Its due must then name a site.
  virtual bool goesOn(const StandView& stand, const Columns& memory) const {
    return static_cast<void>(stand), static_cast<void>(memory), false;
  }
  /// Sites that may still grow, now or later. Growth ends when no process has any.
  virtual std::size_t alive(const Columns& memory, const Commons& commons) const = 0;
};

}  // namespace espalier::sim
