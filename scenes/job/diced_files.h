#pragma once
#include <string>
#include <vector>

#include "scenes/job/model_files.h"
#include "scenes/prepare/site.h"

namespace espalier::scenes {

/// diced.glb and diced.obj, as far as they are wanted.
std::vector<std::string> dicedFileNames(const ModelsWanted& wanted);

/// Bytes that the largest of a site's meshes takes while it is diced for the files that are wanted: they are
/// written side by side, and each dices one mesh after the other. 0 where none is wanted. Throws InputError
/// where that is more than there is.
double dicedBytes(const ModelsWanted& wanted, const Site& site);

/// The files, the second where models are wanted as OBJ too: the scene's meshes and the plants' stems, stalks
/// and elements cut to the grid of voxels, in the colours of these (Greene 1989, figures 5 and 9A). Throws
/// InputError where a plant's would not fit into memory while it is cut; dicedBytes asks for the scene's.
std::vector<OutputFile> dicedFiles(const ModelsWanted& wanted, const ModelSources& sources);

}  // namespace espalier::scenes
