#pragma once
#include <string>
#include <string_view>

#include "scenes/import/mesh_import.h"
#include "sim/tile/mesh.h"

namespace espalier::scenes {

/// A mesh, and what it was read from, as bytes, for the pipe between the importing child and its
/// parent: counts, then arrays, in this machine's own byte order. Not a file format.
std::string packMesh(const sim::Mesh& mesh, const MeshSources& sources = {});

/// The mesh again, and its sources. The bytes are not trusted (a damaged file may
/// have overwritten the child's memory): every count is held against the bytes that are there and every index
/// against its array. Throws std::runtime_error.
sim::Mesh unpackMesh(std::string_view bytes, MeshSources& sources);

}  // namespace espalier::scenes
