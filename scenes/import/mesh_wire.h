#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/provenance.h"
#include "sim/tile/mesh.h"

namespace espalier::scenes {

/// A mesh, and the files that it was read from, as bytes, for the pipe between the importing child and its
/// parent: counts, then arrays, in this machine's own byte order. Not a file format.
std::string packMesh(const sim::Mesh& mesh, const std::vector<sim::InputFile>& files = {});

/// The mesh again, and its files where somebody wants them. The bytes are not trusted (a damaged file may
/// have overwritten the child's memory): every count is held against the bytes that are there and every index
/// against its array. Throws std::runtime_error.
sim::Mesh unpackMesh(std::string_view bytes, std::vector<sim::InputFile>* files = nullptr);

}  // namespace espalier::scenes
