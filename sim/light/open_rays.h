#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/base/bits.h"
#include "sim/base/bricks.h"
#include "sim/sweep/directions.h"

namespace espalier::sim {

namespace looking {
struct Group;
}

class ClearBricks;
class FilledAhead;
class RaysInside;

/// What is clear along the rays' ways in a volume, kept from question to question: asking again costs as much
/// as has changed in between. Of one OpenRays alone.
class ClearAhead {
 public:
  ClearAhead();
  ~ClearAhead();
  ClearAhead(ClearAhead&&) noexcept;
  ClearAhead& operator=(ClearAhead&&) noexcept;

  bool known() const { return filled_ahead_ != nullptr || !of_groups_.empty(); }
  /// Counts places whose rays were cast while nothing was known. Returns their sum.
  std::size_t cast(std::size_t places) { return cast_ += places; }

 private:
  friend class OpenRays;
  friend class RaysInside;
  std::vector<ClearBricks> of_groups_;         // unless the world is coarse,
  std::unique_ptr<FilledAhead> filled_ahead_;  // and else this
  std::size_t cast_ = 0;
};

/// Directions made ready to be looked along from many places, again and again in worlds of one shape. The
/// answer is that of reachesEdge for each of them; what is near is found for many directions at once, and
/// rays end where nothing lies ahead any more.
class OpenRays {
 public:
  OpenRays(const BitVolume& shape, const DirectionSet& directions);

  const DirectionSet& directions() const { return *directions_; }
  /// Of a place's row of bits.
  std::size_t words() const { return (directions_->size() + 63) / 64; }
  /// A row of bits for each place, one after another: bit i says whether direction i reaches the world's
  /// edge. `occupied` must have the shape that was given, and the places must lie in it. `filled`: its
  /// bricks, from who keeps them; else the volume is scanned for them.
  std::vector<std::uint64_t> from(const BitVolume& occupied, std::span<const Voxel> places, ClearAhead& ahead,
                                  const Bricks* filled = nullptr) const;

 private:
  friend class RaysInside;
  /// Makes it true of the volume.
  void look(const BitVolume& occupied, ClearAhead& ahead, const Bricks* filled) const;
  /// Once it is, for rows of words() each.
  void look(const BitVolume& occupied, const ClearAhead& ahead, std::span<const Voxel> places,
            std::uint64_t* open) const;

  std::shared_ptr<const DirectionSet> directions_;  // the groups refer to them
  std::shared_ptr<const std::vector<looking::Group>> groups_;
};

/// The same for single places, in a volume that stands still meanwhile: nothing is found for places of which
/// nobody asks. May be asked from any number of threads. Borrows the first three.
class RaysInside {
 public:
  RaysInside(const OpenRays& rays, const BitVolume& occupied, ClearAhead& ahead,
             const Bricks* filled = nullptr);

  /// A place's row of bits.
  std::vector<std::uint64_t> from(Voxel place) const;

 private:
  const OpenRays& rays_;
  const BitVolume& occupied_;
  const ClearAhead& ahead_;
};

}  // namespace espalier::sim
