#pragma once
#include <string>

#include "scenes/inspect/mesh_shape.h"
#include "scenes/scene.h"

namespace espalier::scenes {

/// What a file is meant to be, as it looks: nothing in it says so. Where nothing speaks for anything else it
/// is what the language takes it for, metres and y.
struct UnitLooks {
  LengthUnit unit = LengthUnit::m;
  std::string why;
};
struct UpLooks {
  UpAxis up = UpAxis::y;
  bool sure = false;  ///< more speaks for it than against it
  std::string why;
};

/// `defined`: the format says y, as glTF does; a file has to look very different to be taken for anything
/// else.
UpLooks upOf(const MeshShape& shape, bool defined);

/// `shape` in the file's own numbers; `defined`: the format says metres.
UnitLooks unitOf(const MeshShape& shape, UpAxis up, bool defined);

}  // namespace espalier::scenes
