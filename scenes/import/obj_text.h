#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/vec.h"

namespace espalier::scenes {

/// The text of an OBJ file taken apart: shapes for Assimp to read, and what they belong to.
///
/// Assimp 5.2.5 takes time by the square of the number of groups, and by the number of `usemtl` times the
/// number of materials. It cuts the name of an object at its first space, adds the faces of an object that is
/// taken up again to the one before, and leaves out vertices that begin with a decimal point, so that the
/// faces after them ask for others. It does nothing of that with shapes alone.
struct ObjText {
  /// A name and where it stands.
  struct Named {
    std::string name;
    int line = 0;    ///< from 1
    int column = 0;  ///< from 1
  };
  /// Polygons in a row, up to those of the next stretch, that are of one group and one material.
  struct Stretch {
    std::uint64_t first_polygon = 0;
    std::string group;  ///< the last `g` or `o` before them; empty: none
    Named material;     ///< the last `usemtl` before them; empty: none
  };

  std::string shapes;  ///< `v` and `f` statements, one a line, that ask for vertices that are there
  std::uint64_t polygons = 0;
  std::vector<Stretch> stretches;
  /// Of each corner of the polygons, one after the other; empty: the file has none. Zero: a corner has none.
  std::vector<glm::vec2> uvs;
  std::vector<sim::Vec3f> normals;
  std::size_t odd_corners = 0;   ///< that ask for UVs or normals that are not there, and have none
  std::vector<Named> libraries;  ///< what stands behind `mtllib`: a file, or several; each once
};

/// Points and lines are left out. Names are as the file has them, without spaces at their ends.
/// Throws sim::InputError, with the line, for vertices without three numbers and for faces that ask for
/// vertices that are not there.
ObjText takeApart(std::string_view obj);

}  // namespace espalier::scenes
