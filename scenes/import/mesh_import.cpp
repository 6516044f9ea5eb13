#include "scenes/import/mesh_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/clean_text.h"
#include "scenes/import/assimp_reader.h"
#include "scenes/import/guarded_file.h"
#include "scenes/import/mesh_wire.h"
#include "scenes/import/placing.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

constexpr double kThinnest = 1e-7;

sim::Mesh unpacked(std::string_view bytes, MeshSources& sources) {
  try {
    return unpackMesh(bytes, sources);
  } catch (const std::exception& error) {
    throw sim::InputError(fmt::format("the file is damaged: it confused the mesh reader ({})", error.what()));
  }
}

void requireFinite(const sim::Mesh& mesh) {
  for (std::size_t v = 0; v < mesh.vertices_m.size(); ++v) {
    const sim::Vec3& p = mesh.vertices_m[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw sim::InputError(fmt::format("vertex {} of {} does not lie at a finite place ({}, {}, {})", v,
                                        mesh.name, p.x, p.y, p.z));
    }
  }
}

void requireIndices(const sim::Mesh& mesh) {
  for (const auto& triangle : mesh.triangles) {
    for (const auto corner : triangle) {
      if (corner >= mesh.vertices_m.size()) {
        throw sim::InputError(
            fmt::format("a triangle asks for vertex {} of {}", corner, mesh.vertices_m.size()));
      }
    }
  }
}

/// Twice the area against the longest edge squared is the height against that edge.
bool isDegenerate(const sim::Vec3& a, const sim::Vec3& b, const sim::Vec3& c) {
  const sim::Vec3 ab = b - a;
  const sim::Vec3 ac = c - a;
  const sim::Vec3 bc = c - b;
  const double longest2 = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
  return !(glm::length(glm::cross(ab, ac)) > kThinnest * longest2);
}

void dropDegenerate(sim::Mesh& mesh) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    if (isDegenerate(mesh.vertices_m[a], mesh.vertices_m[b], mesh.vertices_m[c])) continue;
    mesh.triangles[kept] = mesh.triangles[t];
    mesh.region[kept] = mesh.region[t];
    mesh.material[kept] = mesh.material[t];
    ++kept;
  }
  mesh.degenerate_dropped += mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  mesh.region.resize(kept);
  mesh.material.resize(kept);
}

sim::Mesh checked(sim::Mesh mesh) {
  requireFinite(mesh);
  requireIndices(mesh);
  dropDegenerate(mesh);
  if (!mesh.triangles.empty()) return mesh;
  if (mesh.degenerate_dropped == 0) throw sim::InputError("there are no triangles in the file");
  throw sim::InputError(fmt::format("all {} triangles in the file are degenerate", mesh.degenerate_dropped));
}

}  // namespace

std::string packedMesh(const std::filesystem::path& file, RegionsFrom regions_from) {
  MeshSources sources;
  const sim::Mesh mesh = readWithAssimp(file, regions_from, sources);
  return packMesh(mesh, sources);
}

sim::Mesh meshFromChild(std::string_view bytes, MeshSources& sources) {
  return checked(unpacked(bytes, sources));
}

sim::Mesh importMesh(const std::filesystem::path& file, RegionsFrom regions_from,
                     std::optional<ChildLimits> limits, MeshSources* sources) {
  try {
    const std::uintmax_t bytes = sizeOfFile(file, "mesh");
    requireMeshFormat(file);
    const FileReading reading{"mesh",
                          {file.string(), regions_from == RegionsFrom::material ? "material" : "group"}};
    MeshSources read;
    sim::Mesh mesh = meshFromChild(readInChild(reading, limits.value_or(limitsFor(bytes)), "mesh"), read);
    for (Problem& warning : read.warnings) {
      warning.path = file.string();
      warning.text = cleanText(warning.text);
    }
    if (sources != nullptr) *sources = std::move(read);
    return mesh;
  } catch (const sim::InputError& error) {
    throw sim::InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

sim::Mesh placeMesh(sim::Mesh mesh, const Placement& placement) {
  const Placing placing(placement);
  for (auto& p : mesh.vertices_m) p = placing.point(p);
  for (auto& normal : mesh.normals) normal = sim::unitOrNone(placing.direction(sim::Vec3(normal)));
  requireFinite(mesh);
  return mesh;
}

}  // namespace espalier::scenes
