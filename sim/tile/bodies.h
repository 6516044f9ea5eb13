#pragma once
// Internal to the room: which voxels of a volume hang together.
#include <cstddef>
#include <vector>

#include "sim/base/bits.h"
#include "sim/base/sets.h"

namespace espalier::sim {

/// Voxels of a row that lie beside each other, first and last along x.
struct Run {
  int y, z, first, last;

  std::size_t voxels() const { return static_cast<std::size_t>(last - first + 1); }
};

/// The bodies that a volume's voxels make up where they touch by faces, as runs: there are few of them.
class Bodies {
 public:
  /// Of all but some voxels, from `foot` on along y.
  Bodies(const BitVolume& voxels, const BitVolume& but, int foot = 0);

  /// In (y, z, x) order.
  const std::vector<Run>& runs() const { return runs_; }
  /// The same number, of a run, for all runs of a body.
  std::size_t bodyOf(std::size_t run) { return bodies_.of(run); }

 private:
  void joinRows(std::size_t row, std::size_t other);

  std::vector<Run> runs_;
  std::vector<std::size_t> ends_;  // of each row's runs
  Sets bodies_;
};

/// How many voxels of a run are set.
std::size_t countIn(const BitVolume& voxels, const Run& run);
void setRun(BitVolume& voxels, const Run& run);

}  // namespace espalier::sim
