#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>

#include "sim/scatter/point_set.h"
#include "sim/tile/mesh.h"

namespace espalier::sim {

/// Points on a mesh's triangles, even by area, each with its triangle's unit normal. Each point follows from
/// the stream and its number alone, so that more of them begin with the same ones. Throws InputError for a
/// mesh whose triangles have no area, for no points, and for more than 2^32 - 1.
PointSet scatterOn(const Mesh& mesh, std::size_t count, std::uint64_t stream);

/// Poisson-disc points: of those that scatterOn has, in their order, each that keeps `spacing` (in straight
/// line, the mesh's units) from all before it (dart throwing: Cook 1986). At most `count`, fewer where the
/// surface is full: when as many were tried as would lie there thirty times over. In several waves, from
/// sparse to dense: each keeps half the spacing of the wave before it from all, and the last `spacing`.
/// Throws as scatterOn, and for a spacing that is not above 0.
PointSet scatterApart(const Mesh& mesh, std::size_t count, double spacing, std::uint64_t stream,
                      int waves = 1);

}  // namespace espalier::sim
