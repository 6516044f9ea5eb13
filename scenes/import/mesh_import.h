#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/import/child_process.h"
#include "scenes/import/guarded_file.h"
#include "scenes/problem.h"
#include "scenes/scene.h"
#include "sim/tile/mesh.h"

namespace espalier::scenes {

/// What a mesh was read from.
struct MeshSources {
  std::vector<sim::InputFile> files;  ///< each once: the mesh file and those that it names, called by their
                                      ///< paths from its folder
  std::vector<Problem> warnings;  ///< what was asked for and is not there, with its place in the mesh file
};

/// Reads an OBJ (with its MTL), glTF 2 (.gltf, .glb), PLY or STL file.
///
/// Node transforms are applied and polygons triangulated; points and lines are left out. Regions are the
/// file's groups (OBJ: `g` and `o`; glTF: the node's name, or its mesh's; STL: the solid's) or its materials,
/// in the order of first use. Where groups are asked for and the file names none, its materials stand in;
/// what has no name at all becomes a region named after the file. Materials carry base colours as linear RGB:
/// glTF's are linear; Kd of an MTL file, of which its format says nothing, is taken as a display value
/// (sRGB), as a colour picker shows it. A material that no MTL file has, as where the file is missing, is
/// grey, with a warning.
///
/// What a model of the scene is to look like is handed on: UVs and normals where the file has them, base
/// colour textures (PNG and JPEG files, undecoded, of 256 MB together at most; map_Kd of an MTL file), and
/// what else a glTF material says of its surface. One warning tells of pictures that are left out. Vertex
/// colours are not read.
///
/// Triangles with two equal corners or a height below 1e-7 of their longest edge are dropped and counted, at
/// any size.
///
/// The file is read in a child process (scenes/import/child_process.h) that sees regular files in the mesh's
/// folder only: one that makes the reader crash, hang or eat memory is an error like any other. Throws
/// sim::InputError that begins with the file's path: missing, not a regular file, above 256 MB, of an unknown
/// format, damaged, without triangles, with more than 8 million, with a vertex that is not finite, or with an
/// index that is out of range.
///
/// `limits` are by default what suits the file's size.
sim::Mesh importMesh(const std::filesystem::path& file, RegionsFrom regions_from,
                     std::optional<ChildLimits> limits = std::nullopt, MeshSources* sources = nullptr);

/// The work of the child.
std::string packedMesh(const std::filesystem::path& file, RegionsFrom regions_from);
/// What the reading child sent (scenes/import/mesh_wire.h), unpacked and checked as importMesh does; the
/// bytes are not trusted. Throws sim::InputError, without the file's name.
sim::Mesh meshFromChild(std::string_view bytes, MeshSources& sources);

/// The mesh in world space. Throws sim::InputError where the result is not finite.
sim::Mesh placeMesh(sim::Mesh mesh, const Placement& placement);

}  // namespace espalier::scenes
