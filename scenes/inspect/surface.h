#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/tile/mesh.h"

namespace espalier::scenes {

/// What something is the surface of.
enum class Body {
  solid,       ///< something with an inside, faces outwards
  inside_out,  ///< the same, faces inwards
  open,        ///< something with an inside that lies wide open
  sheet        ///< nothing: it has two sides and no inside
};

/// Twice the winding number by which a surface sees the whole mesh, without itself: 1 on a solid, -1 inside
/// out, 0 on a sheet, on the mean over its area.
Body bodyOf(double winding);

/// A connected piece of a mesh, or a region of it.
struct SurfacePart {
  std::string name;  ///< of a region
  std::size_t triangles = 0;
  double area = 0.0;
  std::optional<double> winding;  ///< none where there are too many parts to look at each
};

/// How sound a mesh's surface is. Corners at one place are one, to the last bit; areas are in squares of the
/// mesh's own unit.
struct Surface {
  std::size_t corners = 0;           ///< at different places
  std::size_t open_edges = 0;        ///< with one triangle
  std::size_t rims = 0;              ///< that these hang together in: around a hole, or a sheet
  std::size_t crowded_edges = 0;     ///< with three triangles or more
  std::size_t flipped = 0;           ///< least number of triangles to be turned for neighbours to agree
  std::size_t duplicates = 0;        ///< triangles on the corners of another
  double winding = 0.0;              ///< of all
  std::vector<SurfacePart> pieces;   ///< largest first
  std::vector<SurfacePart> regions;  ///< as the mesh has them
};

/// For a mesh that isOfALength(). Of winding numbers as many are found as take a second or so.
Surface surfaceOf(const sim::Mesh& mesh);

}  // namespace espalier::scenes
