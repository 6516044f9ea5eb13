#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/tile/mesh.h"

namespace espalier::sim {

/// A side of a triangle, on corners a < b.
struct Side {
  std::uint32_t a, b, triangle;
  bool forward;  ///< the triangle goes from a to b
};

/// How a mesh's triangles hang together: vertices in one place, to the last bit, count as one.
struct Joined {
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< on corners at different places
  std::size_t places = 0;   ///< as many as numbers of corners, of corners of no triangle too
  std::size_t corners = 0;  ///< of triangles
  std::vector<Side> sides;  ///< those on the same edge beside each other
};

Joined joined(const Mesh& mesh);

/// Calls for each edge with its sides.
template <class Visit>
void forEachEdge(const Joined& mesh, Visit visit) {
  const std::vector<Side>& sides = mesh.sides;
  for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
    for (end = first + 1;
         end < sides.size() && sides[end].a == sides[first].a && sides[end].b == sides[first].b;)
      ++end;
    visit(sides.data() + first, end - first);
  }
}

/// Triangles that hang together by edges of just two of them, in ascending order. What lies across other
/// edges tells nothing of how a triangle should be wound.
struct WoundPatches {
  std::vector<std::vector<std::uint32_t>> triangles;
  std::vector<bool> against;  ///< by triangle: wound the other way round than the first of its patch
};

WoundPatches woundPatches(const Joined& mesh);

}  // namespace espalier::sim
