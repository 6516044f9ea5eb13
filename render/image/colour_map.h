#pragma once
#include <string>
#include <vector>

#include "sim/base/vec.h"

namespace espalier::render {

/// A perceptual colour map, read off OpenImageIO's into a table: equal steps of the value look equally large.
/// Names: inferno, viridis, magma, plasma, turbo. Throws InputError for another.
class ColourMap {
 public:
  explicit ColourMap(const std::string& name);
  /// Linear light for a value 0..1; values outside take the ends' colours.
  sim::Colour operator()(float value) const;

 private:
  std::vector<sim::Colour> table_;
};

}  // namespace espalier::render
