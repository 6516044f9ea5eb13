#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rules/language/key.h"
#include "tests/support/numbers.h"

/// Legal texts for keys of any kind, from what the registry says of them.
namespace espalier::fuzz {

/// Where the numbers of a key usually lie, if that is narrower than what it may be; by its path.
std::optional<rules::Limits> usualLimits(const std::string& path);

/// Draws values of a file whose world has voxels of one size, and so many of them along its longest side.
class ValueDrawer {
 public:
  ValueDrawer(tests::Numbers& numbers, double voxel_m, double longest_vx)
      : numbers_(numbers), voxel_m_(voxel_m), longest_vx_(longest_vx) {}

  /// A number within the limits, often one of their ends. `usual`: where most of them lie; only every
  /// fiftieth may lie beyond.
  double number(const rules::Limits& limits, const rules::Limits& usual);
  /// A text for a key of a kind that needs nothing but its limits and choices; for all others empty.
  std::string text(const rules::Key& key, const rules::Limits& usual);
  /// [x, y, z], each number written in full.
  static std::string point(double x, double y, double z);
  std::string name();
  /// Whether a number beyond what is usual was drawn so far: what takes long.
  bool beyondUsual() const { return beyond_usual_; }

 private:
  std::string length(const rules::Key& key, const rules::Limits& usual, bool metres);
  std::string varying(const rules::Key& key, const rules::Limits& usual);
  std::string polygons(const rules::Limits& limits, std::size_t most);
  std::string colour();
  std::string date();
  std::string phrase(std::size_t most);

  tests::Numbers& numbers_;
  double voxel_m_, longest_vx_;
  bool beyond_usual_ = false;
};

}  // namespace espalier::fuzz
