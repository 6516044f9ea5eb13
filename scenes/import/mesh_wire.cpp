#include "scenes/import/mesh_wire.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "scenes/import/wire.h"

namespace espalier::scenes {
namespace {

void requireBelow(const std::vector<std::uint32_t>& indices, std::size_t limit) {
  if (std::any_of(indices.begin(), indices.end(), [&](std::uint32_t i) { return i >= limit; })) {
    throw std::runtime_error("an index is out of range");
  }
}

}  // namespace

std::string packMesh(const sim::Mesh& mesh, const MeshSources& sources) {
  Packer out;
  out.putText(mesh.name);
  out.putArray(mesh.vertices_m.data(), mesh.vertices_m.size());
  out.putArray(mesh.triangles.data(), mesh.triangles.size());
  out.putArray(mesh.region.data(), mesh.region.size());
  out.putArray(mesh.material.data(), mesh.material.size());
  out.put(static_cast<std::uint64_t>(mesh.regions.size()));
  for (const auto& name : mesh.regions) out.putText(name);
  out.put(static_cast<std::uint64_t>(mesh.materials.size()));
  for (const auto& material : mesh.materials) {
    out.putText(material.name);
    out.put(material.colour);
  }
  out.put(static_cast<std::uint64_t>(mesh.degenerate_dropped));
  out.put(static_cast<std::uint64_t>(sources.files.size()));
  for (const auto& file : sources.files) {
    out.putText(file.name);
    out.putText(file.kind);
    out.put(file.hash);
  }
  out.put(static_cast<std::uint64_t>(sources.warnings.size()));
  for (const auto& warning : sources.warnings) {
    out.put(warning.line);
    out.put(warning.column);
    out.putText(warning.text);
  }
  return out.take();
}

sim::Mesh unpackMesh(std::string_view bytes, MeshSources& sources) {
  Unpacker in(bytes);
  sim::Mesh mesh;
  mesh.name = in.getText();
  mesh.vertices_m = in.getArray<sim::Vec3>();
  mesh.triangles = in.getArray<std::array<std::uint32_t, 3>>();
  mesh.region = in.getArray<std::uint32_t>();
  mesh.material = in.getArray<std::uint32_t>();
  mesh.regions.resize(in.getCount(sizeof(std::uint64_t)));
  for (auto& name : mesh.regions) name = in.getText();
  mesh.materials.resize(in.getCount(sizeof(std::uint64_t) + sizeof(sim::Colour)));
  for (auto& material : mesh.materials) {
    material.name = in.getText();
    material.colour = in.get<sim::Colour>();
  }
  mesh.degenerate_dropped = static_cast<std::size_t>(in.get<std::uint64_t>());
  sources.files.resize(in.getCount(3 * sizeof(std::uint64_t)));
  for (auto& file : sources.files) {
    file.name = in.getText();
    file.kind = in.getText();
    file.hash = in.get<std::uint64_t>();
  }
  sources.warnings.resize(in.getCount(2 * sizeof(int) + sizeof(std::uint64_t)));
  for (auto& warning : sources.warnings) {
    warning.line = in.get<int>();
    warning.column = in.get<int>();
    warning.text = in.getText();
  }
  in.requireEnd();
  if (mesh.region.size() != mesh.triangles.size() || mesh.material.size() != mesh.triangles.size()) {
    throw std::runtime_error("not every triangle has a region and a material");
  }
  requireBelow(mesh.region, mesh.regions.size());
  requireBelow(mesh.material, mesh.materials.size());
  return mesh;
}

}  // namespace espalier::scenes
