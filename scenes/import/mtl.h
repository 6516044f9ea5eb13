#pragma once
#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <string_view>

#include "sim/tile/mesh.h"

namespace espalier::scenes {

/// A material of an MTL file: its colour, and the picture by which that is multiplied.
struct MtlMaterial {
  sim::Material material;
  std::string picture;                  ///< a file, by its path from the MTL file's folder; empty: none
  bool clamps = false;                  ///< it does not repeat beyond 0..1
  glm::vec2 scale{1.0f}, offset{0.0f};  ///< of the UVs by which it lies: uv * scale + offset
};

/// Materials by the names that an OBJ file calls them by.
using MtlMaterials = std::map<std::string, MtlMaterial>;

/// What an MTL file does not say the look of: grey.
sim::Material unknownMaterial(const std::string& name);

/// Adds an MTL file's materials with their diffuse colours and pictures, how much they hide, and what they
/// emit (`newmtl`, `Kd`, `d`, `Ke`, `map_Kd` with its options -clamp, -s and -o), light as linear; the format
/// does not say what its values are, so they are taken as display values (IEC 61966-2-1), as a colour picker
/// shows them. All else in the file is not read, `Tr` among it, which means one thing here and its contrary
/// there. Read here as Assimp 5.2.5 takes 33 kB for each material. Gives the line of the first `Kd` or `Ke`
/// back that is no colour, or `d` that is no number, and is left out; 0: there is none.
int readMtl(std::string_view mtl, MtlMaterials& materials);

}  // namespace espalier::scenes
