#include "render/files/flat_mesh.h"

#include <algorithm>

namespace espalier::render {
namespace {

constexpr float kFlatFacet = 0.98f;  // cosine between a facet and its corners' normals

bool isFlat(const ModelMesh& mesh) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    const auto& p = mesh.positions_m;
    const sim::Vec3f area = glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    const float wanted = kFlatFacet * glm::length(area);
    return std::all_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return glm::dot(area, mesh.normals[v]) >= wanted; });
  });
}

}  // namespace

ModelMesh withoutFlatNormals(const ModelMesh& mesh) {
  ModelMesh flat;
  if (!isFlat(mesh)) return flat;
  flat.name = mesh.name;
  flat.base_colour = mesh.base_colour;
  flat.picture = mesh.picture;
  std::vector<std::uint32_t> number(mesh.positions_m.size());
  std::size_t piece_begins = 0;  // among those kept
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (v > 0 && mesh.pieces[v] != mesh.pieces[v - 1]) piece_begins = flat.positions_m.size();
    std::size_t same = piece_begins;
    while (same < flat.positions_m.size() &&
           !(flat.positions_m[same] == mesh.positions_m[v] && flat.uvs[same] == mesh.uvs[v] &&
             (mesh.tints.empty() || flat.tints[same] == mesh.tints[v])))
      ++same;
    number[v] = static_cast<std::uint32_t>(same);
    if (same < flat.positions_m.size()) continue;
    flat.positions_m.push_back(mesh.positions_m[v]);
    flat.uvs.push_back(mesh.uvs[v]);
    if (!mesh.tints.empty()) flat.tints.push_back(mesh.tints[v]);
    flat.exposures.push_back(mesh.exposures[v]);
    flat.youths.push_back(mesh.youths[v]);
    flat.orders.push_back(mesh.orders[v]);
  }
  flat.triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) flat.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
  return flat;
}

}  // namespace espalier::render
