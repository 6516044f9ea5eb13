#include "render/files/surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "sim/base/error.h"

namespace espalier::render {
namespace {

constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

template <class To, class From>
std::vector<To> pick(const std::vector<From>& values, const std::vector<std::uint32_t>& vertices) {
  std::vector<To> picked;
  if (values.empty()) return picked;
  picked.reserve(vertices.size());
  for (const std::uint32_t v : vertices) picked.emplace_back(values[v]);
  return picked;
}

}  // namespace

std::vector<MaterialSurface> surfacesOf(const sim::Mesh& mesh) {
  std::vector<std::vector<std::size_t>> triangles_of(mesh.materials.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.material[t] < triangles_of.size()) triangles_of[mesh.material[t]].push_back(t);
  }
  std::vector<MaterialSurface> surfaces;
  std::vector<std::uint32_t> number(mesh.vertices_m.size(), kUnused), vertices;
  for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
    if (triangles_of[m].empty()) continue;
    MaterialSurface& surface = surfaces.emplace_back();
    surface.material = m;
    vertices.clear();
    for (const std::size_t t : triangles_of[m]) {
      auto& corners = surface.triangles.emplace_back(mesh.triangles[t]);
      for (std::uint32_t& corner : corners) {
        if (corner >= number.size()) {
          throw sim::InputError(fmt::format("mesh '{}': triangle {} uses vertex {} of {}", mesh.name, t,
                                            corner, number.size()));
        }
        if (number[corner] == kUnused) {
          number[corner] = static_cast<std::uint32_t>(vertices.size());
          vertices.push_back(corner);
        }
        corner = number[corner];
      }
    }
    for (const std::uint32_t vertex : vertices) number[vertex] = kUnused;
    surface.positions_m = pick<sim::Vec3f>(mesh.vertices_m, vertices);
    surface.uvs = pick<glm::vec2>(mesh.uvs, vertices);
    surface.normals = pick<sim::Vec3f>(mesh.normals, vertices);
    if (std::find(surface.normals.begin(), surface.normals.end(), sim::Vec3f(0.0f)) != surface.normals.end())
      surface.normals.clear();
  }
  return surfaces;
}

std::string kindOf(const PlantModel& plant, const ModelMesh& mesh) {
  const std::string prefix = plant.name + " ";
  return mesh.name.starts_with(prefix) ? mesh.name.substr(prefix.size()) : mesh.name;
}

void forEachSurface(
    const PlantModel& plant,
    const std::function<void(const ModelMesh& mesh, const std::string& kind, PlantSurface surface)>& visit) {
  if (!plant.stems.empty()) visit(plant.stems, "stems", PlantSurface::stems);
  if (!plant.stalks.empty()) visit(plant.stalks, "stalks", PlantSurface::stalks);
  for (const ModelMesh& element : plant.elements)
    if (!element.empty()) visit(element, kindOf(plant, element), PlantSurface::blades);
}

}  // namespace espalier::render
