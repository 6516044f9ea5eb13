#pragma once
#include <cstdint>
#include <vector>

#include "scenes/inspect/surface.h"
#include "sim/tile/mesh.h"

namespace espalier::scenes {

/// Internal to the wing: the winding number of a mesh about triangles of its own, without their own share,
/// and twice: on the surface of a body that is 1. Jacobson, Kavan and Sorkine-Hornung, Robust Inside-Outside
/// Segmentation using Generalized Winding Numbers (2013). Each asked triangle sees each of the mesh.
std::vector<double> windingAbout(const sim::Mesh& mesh, const std::vector<std::uint32_t>& triangles);

/// How many triangles may be asked for in a second or so.
std::size_t affordableWindings(std::size_t triangles);

}  // namespace espalier::scenes
