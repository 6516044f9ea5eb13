#pragma once
#include <string>
#include <string_view>

#include "sim/tile/mesh.h"

namespace espalier::scenes {

/// A mesh as bytes, for the pipe between the importing child and its parent: counts, then arrays, in this
/// machine's own byte order. Not a file format.
std::string packMesh(const sim::Mesh& mesh);

/// The mesh again. The bytes are not trusted (a damaged file may have overwritten the child's memory): every
/// count is held against the bytes that are there and every index against its array. Throws
/// std::runtime_error.
sim::Mesh unpackMesh(std::string_view bytes);

}  // namespace espalier::scenes
