#pragma once
#include <cstdint>
#include <vector>

#include "scenes/import/gltf_json.h"

namespace espalier::scenes::gltf {

/// How many triangles the document's scene has, instances counted each time: `triangles` by mesh. Takes time
/// in proportion to the document, however often nodes are shared. Throws sim::InputError, naming the node,
/// for indices of what is not there, nodes that lie below themselves, more than 1000 deep or shared more than
/// a million times, and transforms that are none.
std::uint64_t trianglesInScene(const Json& document, const std::vector<std::uint64_t>& triangles);

}  // namespace espalier::scenes::gltf
