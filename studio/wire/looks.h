#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sim/base/frame.h"
#include "sim/grow/growth.h"

namespace espalier::studio {

/// How plants look: the event `looks`, and the pictures that it names.
struct Looks {
  std::string event;
  std::map<std::string, std::string> textures;  ///< PNG files, by their IDs
};

/// Of all of growth's plants, whose plantings are called so; plants of one have the shapes of its first, and
/// null in their place. Throws InputError where pictures cannot be drawn.
Looks looksOf(std::uint32_t version, const sim::Growth& growth, const std::vector<std::string>& plantings,
              const sim::Frame& frame);

}  // namespace espalier::studio
