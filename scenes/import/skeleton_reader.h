#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/import/skeleton_forest.h"
#include "scenes/scene.h"
#include "sim/base/provenance.h"

namespace espalier::scenes {

/// Reads skeletons: the program's own skeleton.json, a plain list of nodes in JSON, or the lines of a
/// Wavefront OBJ file; docs/scene-files.md describes them. All trees have radii, or none has. The file is
/// read in a child process, as meshes are (scenes/import/guarded_file.h). `read` takes its hash. Throws
/// sim::InputError that begins with the file's path and names the node, the line or the byte: missing, no
/// regular file, empty, above 256 MB or kMostSkeletonNodes, no JSON or of another form, a parent that is not
/// there, a ring, a number that is none or is beyond 1e9, a radius that is not positive, a line that asks for
/// a vertex that is not there or joins what is joined already, no segment in all the file.
std::vector<FileTree> readSkeletons(const std::filesystem::path& file, sim::InputFile& read);

/// The work of the child.
std::string packedSkeletons(const std::filesystem::path& file);
/// The same by the text alone.
std::vector<FileTree> skeletonsInJson(std::string_view text);
std::vector<FileTree> skeletonsInObj(std::string_view text);

/// What the child sends; `hash` of the file.
std::string packSkeletons(const std::vector<FileTree>& trees, std::uint64_t hash);
/// What the reading child sent, unpacked and checked; the bytes are not trusted. Throws std::runtime_error.
std::vector<FileTree> skeletonsFromChild(std::string_view bytes, sim::InputFile& read);

/// In world space, as scenes place meshes; radii with them.
void placeSkeletons(std::vector<FileTree>& trees, const Placement& placement);

}  // namespace espalier::scenes
