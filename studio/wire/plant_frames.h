#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/base/frame.h"
#include "sim/grow/plant.h"

namespace espalier::studio {

/// Which plant of which version a frame is of.
struct OfPlant {
  std::uint32_t version = 0;
  std::uint32_t plant = 0;  ///< in the order of Growth::plants
  std::uint32_t iteration = 0;
};

/// What of a plant was sent already, or is to be left out: so many of its first nodes and elements.
struct Sent {
  std::size_t nodes = 0, elements = 0;
};

/// The nodes from the first that was not sent on, with the radii of all. Throws InputError as
/// render::stemRadii does.
std::string nodesFrame(const OfPlant& of, const sim::Plant& plant, const sim::Frame& frame,
                       std::size_t first);

/// A frame for each shape of which there are elements that were not sent; from 0, one for every shape, so
/// that the page forgets those that it has.
std::vector<std::string> elementFrames(const OfPlant& of, const sim::Plant& plant, const sim::Frame& frame,
                                       std::size_t first);

}  // namespace espalier::studio
