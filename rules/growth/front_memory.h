#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "rules/front/front.h"
#include "sim/grow/process.h"

/// What colonization remembers from one iteration to the next, as columns.
namespace espalier::rules {

/// Where the scene's attractors of a name lie among the commons.
std::string attractorsNamed(const std::string& name);
/// Their columns (sim::Vec3): places in voxel space, and the unit normals of the surface that each was strewn
/// on, zero elsewhere.
inline constexpr const char* kAttractorPlace = "at_vx";
inline constexpr const char* kAttractorNormal = "normal";
/// Where they come in waves: of each, as it was given, in which (std::int32_t).
inline constexpr const char* kAttractorWave = "wave";

/// A front out of columns and back: nothing is copied. While it is lent the columns lack it.
class LentFront {
 public:
  /// Throws BrokenContract where the columns do not fit together.
  explicit LentFront(sim::Columns& columns);
  /// A new one, to be put there.
  LentFront(sim::Columns& columns, Front fresh) : front(std::move(fresh)), columns_(columns) {}
  ~LentFront();
  LentFront(const LentFront&) = delete;
  LentFront& operator=(const LentFront&) = delete;

  Front front;

 private:
  sim::Columns& columns_;
};

/// Whether the columns hold a front already.
bool holdsFront(const sim::Columns& columns);
/// What became of the attractors there; all wait where none has begun.
Fates fatesIn(const sim::Columns& columns);
/// Why growth to them ended after so many iterations, in words. `by_itself`: nothing at all was alive then.
std::string endingIn(const sim::Columns& columns, int iterations, bool by_itself);
/// Throws BrokenContract where a front among the commons is none that growth could have left there: numbers
/// out of their bounds, a tree that is none.
void requireSoundFronts(const sim::Commons& commons);

/// A node that something may still act on, or in which a trunk ends.
struct FrontNode {
  std::int32_t front = 0;  ///< its number in the front
  std::int32_t plant = 0;  ///< within the planting
  sim::NodeId node = 0;
};

/// A way that a site is to go in this iteration.
struct Errand {
  FrontNode from;
  std::uint32_t number = 0;  ///< which of the node's ways
  Gait gait = Gait::none;
  bool trunk = false;
  sim::Vec3 direction{0.0};              ///< unit
  sim::Vec3 end_vx{0.0};                 ///< where it leads if nothing in its way bends it
  std::int32_t attractor = kNobody;      ///< the number of the one that it goes for alone
  sim::NodeId meets = sim::kNoNode;      ///< the node whose place it goes to, if it closes a loop
  std::int32_t meets_another = kNobody;  ///< that node's number in the front, if it is another plant's

  bool isMeeting() const { return meets != sim::kNoNode || meets_another != kNobody; }
};

/// A planting's own part.
struct FrontMemory {
  std::vector<FrontNode> active;  ///< ascending
  std::vector<FrontNode> trunks;  ///< tips of plants that no attractor was in reach of yet
  std::vector<Errand> errands;    ///< in the order of sites
  std::int32_t wave = 0;          ///< of the attractors, the last that its nodes met
};
/// Throws BrokenContract for numbers of nodes that are not there.
FrontMemory frontMemory(const sim::Columns& memory, const sim::StandView& stand);
void keep(const FrontMemory& memory, sim::Columns& columns);
/// The errand of a site. Throws BrokenContract where it has none.
Errand errandOf(const sim::Columns& memory, const sim::Site& site);
/// How many nodes may still grow.
std::size_t countFront(const sim::Columns& memory);

}  // namespace espalier::rules
