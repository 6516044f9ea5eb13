#pragma once
#include <string>

#include "scenes/prepare/site.h"

namespace espalier::studio {

/// A site's meshes as a .glb file. Throws InputError where they do not fit into one.
std::string siteModel(const scenes::Site& site);

}  // namespace espalier::studio
