#include "render/files/needed.h"

#include <algorithm>
#include <limits>

namespace espalier::render {
namespace {

constexpr float kFlatFacet = 0.98f;  // cosine between a facet and its corners' normals
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

bool isFlat(const ModelMesh& mesh) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    const auto& p = mesh.positions_m;
    const sim::Vec3f area = glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    const float wanted = kFlatFacet * glm::length(area);
    return std::all_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return glm::dot(area, mesh.normals[v]) >= wanted; });
  });
}

/// Of each vertex the first that is like it but for its normal, within its piece.
std::vector<std::uint32_t> alikeButForNormals(const ModelMesh& mesh) {
  std::vector<std::uint32_t> first(mesh.positions_m.size()), kept;  // kept: of the piece
  for (std::uint32_t v = 0; v < first.size(); ++v) {
    if (v > 0 && mesh.pieces[v] != mesh.pieces[v - 1]) kept.clear();
    const auto same = std::find_if(kept.begin(), kept.end(), [&](std::uint32_t other) {
      return mesh.positions_m[other] == mesh.positions_m[v] && mesh.uvs[other] == mesh.uvs[v] &&
             (mesh.tints.empty() || mesh.tints[other] == mesh.tints[v]);
    });
    first[v] = same != kept.end() ? *same : v;
    if (same == kept.end()) kept.push_back(v);
  }
  return first;
}

/// Of each vertex the first at its point.
std::vector<std::uint32_t> atOnePoint(const ModelMesh& mesh) {
  std::vector<std::uint32_t> first_at(mesh.points.size(), kNone), first;
  first.reserve(mesh.points.size());
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    std::uint32_t& at = first_at[mesh.points[v]];
    if (at == kNone) at = v;
    first.push_back(at);
  }
  return first;
}

}  // namespace

Needed neededOf(const ModelMesh& mesh, PlantSurface kind) {
  if (kind == PlantSurface::stalks) return {false, false, {}};
  if (kind == PlantSurface::blades && isFlat(mesh)) return {false, true, alikeButForNormals(mesh)};
  if (kind == PlantSurface::stems && mesh.picture == nullptr && !mesh.points.empty())
    return {true, false, atOnePoint(mesh)};
  return {true, !mesh.uvs.empty(), {}};
}

}  // namespace espalier::render
