#pragma once
#include <string>
#include <utility>
#include <vector>

#include "sim/light/lighting.h"

namespace espalier::scenes {

/// What the numbers of a light are, as names and texts, for tables and headers.
std::vector<std::pair<std::string, std::string>> texts(const sim::LightAbout& about);

}  // namespace espalier::scenes
