#pragma once
#include <map>
#include <string>
#include <string_view>

#include "sim/tile/mesh.h"

namespace espalier::scenes {

/// Materials by the names that an OBJ file calls them by.
using MtlMaterials = std::map<std::string, sim::Material>;

/// What an MTL file does not say the look of: grey.
sim::Material unknownMaterial(const std::string& name);

/// Adds an MTL file's materials with their diffuse colours (`newmtl`, `Kd`) as linear light; the format does
/// not say what its values are, so they are taken as display values (IEC 61966-2-1), as a colour picker shows
/// them. All else in the file is about looks that are not read. Read here as Assimp 5.2.5 takes 33 kB for
/// each material. Gives the line of the first `Kd` back that is no colour, and is left out; 0: there is none.
int readMtl(std::string_view mtl, MtlMaterials& materials);

}  // namespace espalier::scenes
