#include "scenes/inspect/inspected.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "scenes/import/mesh_import.h"
#include "scenes/import/placing.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

bool isGltf(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return ending == ".glb" || ending == ".gltf";
}

std::vector<std::pair<std::string, double>> materialAreas(const sim::Mesh& mesh) {
  std::vector<std::pair<std::string, double>> areas;
  for (const sim::Material& material : mesh.materials) areas.emplace_back(material.name, 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) areas[mesh.material[t]].second += areaOf(mesh, t);
  return areas;
}

/// Makes the regions those that importMesh makes of materials.
void takeRegionsFromMaterials(sim::Mesh& mesh, const std::string& stem) {
  std::vector<std::uint32_t> region_of;
  mesh.regions.clear();
  for (const sim::Material& material : mesh.materials) {
    const std::string& name = material.name.empty() ? stem : material.name;
    const auto at = std::find(mesh.regions.begin(), mesh.regions.end(), name);
    region_of.push_back(static_cast<std::uint32_t>(at - mesh.regions.begin()));
    if (at == mesh.regions.end()) mesh.regions.push_back(name);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) mesh.region[t] = region_of[mesh.material[t]];
}

}  // namespace

Inspection inspectMesh(const std::filesystem::path& file) {
  constexpr double kSolid = 0.9, kFar = 20.0;
  MeshSources sources;
  const auto began = std::chrono::steady_clock::now();
  sim::Mesh mesh = importMesh(file, RegionsFrom::group, std::nullopt, &sources);
  const std::chrono::duration<double> reading = std::chrono::steady_clock::now() - began;
  Inspected found;
  found.file = file;
  found.warnings = std::move(sources.warnings);
  found.groups = mesh.regions.size();
  if (mesh.regions.size() == 1 && mesh.materials.size() > 1) {
    found.regions = RegionsFrom::material;
    takeRegionsFromMaterials(mesh, file.stem().string());
  }
  found.triangles = mesh.triangles.size();
  found.degenerate = mesh.degenerate_dropped;
  found.shape = shapeOf(mesh);
  if (!isOfALength(found.shape)) {
    throw sim::InputError(fmt::format("{}: it is {:.3g} long in its own numbers; expected {:.0g} to {:.0g}",
                                      file.string(), found.shape.longest(), kLeastLength, kMostLength));
  }
  found.up = upOf(found.shape, isGltf(file));
  found.unit = unitOf(found.shape, found.up.up, isGltf(file));
  found.surface = surfaceOf(mesh);
  found.materials = materialAreas(mesh);
  found.line.file = file;
  found.line.name = file.stem().string();
  found.line.regions_from = found.regions;
  if (std::abs(found.surface.winding) >= kSolid) found.line.solid = true;
  if (found.unit.unit != LengthUnit::m) found.line.placement.unit = found.unit.unit;
  found.line.placement.up = found.up.up;
  const auto place = [&] {
    const Placing placing(found.line.placement);
    const sim::Vec3 a = placing.point(found.shape.low), b = placing.point(found.shape.high);
    found.low_m = glm::min(a, b);
    found.high_m = glm::max(a, b);
  };
  place();
  const sim::Vec3 foot(0.5 * (found.low_m.x + found.high_m.x), found.low_m.y,
                       0.5 * (found.low_m.z + found.high_m.z));
  if (glm::length(foot) > kFar * glm::length(found.high_m - found.low_m)) {
    found.line.placement.translate_m = -glm::round(foot);
    found.from_origin_m = glm::length(foot);
    place();
  }
  mesh = placeMesh(std::move(mesh), found.line.placement);
  return {std::move(found), std::move(mesh), reading.count()};
}

}  // namespace espalier::scenes
