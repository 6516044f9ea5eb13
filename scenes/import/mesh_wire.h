#pragma once
#include <string>
#include <string_view>

#include "scenes/import/mesh_import.h"
#include "sim/tile/mesh.h"

namespace espalier::scenes {

/// A mesh, and what it was read from, as bytes (scenes/import/wire.h).
std::string packMesh(const sim::Mesh& mesh, const MeshSources& sources = {});

/// The mesh again, and its sources; every index is held against its array. Throws std::runtime_error.
sim::Mesh unpackMesh(std::string_view bytes, MeshSources& sources);

}  // namespace espalier::scenes
