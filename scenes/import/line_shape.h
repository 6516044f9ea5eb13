#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/scene.h"
#include "sim/base/provenance.h"
#include "sim/tile/build_world.h"

namespace espalier::scenes {

/// The most lines of a file, and the most of its vertices.
inline constexpr std::size_t kMostLines = 1'000'000;

/// Lines and points, as a file has them or as a scene says them in place.
struct LineArt {
  std::vector<std::string> regions;
  std::vector<sim::Line> lines;  ///< their places in the file's space until they are placed
};

/// What an OBJ file's `l` and `p` statements say; regions are its groups (`g` and `o`) or materials, and
/// where it has none one that is called `stem`. Throws sim::InputError, with the line, for a vertex that is
/// not there or no number, and for more than kMostLines.
LineArt linesIn(std::string_view obj, RegionsFrom regions_from, const std::string& stem);

/// An OBJ file that has lines or points and no faces. Nothing where it has none; throws as linesIn does, with
/// the file's path.
std::optional<LineArt> readLineFile(const std::filesystem::path& file, RegionsFrom regions_from,
                                    sim::InputFile& read);

/// The lines that a scene says in place: one region, called as the mesh.
LineArt linesOf(const SceneMesh& spec);

/// Placed and ready to be tiled: with tubes of the mesh's thickness around lines, and a corner of that size
/// at points, to be looked at.
sim::TiledMesh lineShape(const SceneMesh& spec, LineArt art);

}  // namespace espalier::scenes
