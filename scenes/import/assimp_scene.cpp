#include "scenes/import/assimp_scene.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "scenes/clean_text.h"
#include "scenes/import/triangulate.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

/// The names that Assimp makes up where a file gives none: `nodes[3]`, `<STL_BINARY>`.
bool isMadeUp(std::string_view name) {
  return name == "defaultobject" || name == AI_DEFAULT_MATERIAL_NAME || name.starts_with("nodes[") ||
         name.starts_with("meshes[") || (name.front() == '<' && name.back() == '>');
}

std::string nameIn(const aiString& raw) {
  return givenName({raw.data, std::min<std::size_t>(raw.length, MAXLEN - 1)});
}

glm::dmat4 matrixOf(const aiMatrix4x4& m) {
  return {
      {m.a1, m.b1, m.c1, m.d1}, {m.a2, m.b2, m.c2, m.d2}, {m.a3, m.b3, m.c3, m.d3}, {m.a4, m.b4, m.c4, m.d4}};
}

std::string groupOf(const aiNode& node, const aiMesh& mesh) {
  std::string name = nameIn(node.mName);
  if (!name.empty()) return name;
  name = nameIn(mesh.mName);
  // Assimp splits a glTF mesh by its primitives and numbers them: wall-0, wall-1.
  if (node.mNumMeshes > 1) name.resize(std::min(name.size(), name.find_last_of('-')));
  return name;
}

class MeshBuilder {
 public:
  explicit MeshBuilder(const std::string& stem) { mesh_.name = stem; }

  void add(const MeshInstance& instance, const std::string& region_name, const sim::Material& material) {
    const auto& from = *instance.mesh;
    const auto base = static_cast<std::uint32_t>(mesh_.vertices_m.size()) - instance.first_vertex;
    for (unsigned v = instance.first_vertex; v < instance.end_vertex; ++v) {
      const auto& p = from.mVertices[v];
      mesh_.vertices_m.emplace_back(instance.world_from_mesh * glm::dvec4(p.x, p.y, p.z, 1.0));
    }
    addLooks(instance, base);
    std::vector<sim::Vec3> corners;
    std::optional<std::uint32_t> region_of_all, material_of_all;  // those of triangles alone get a number
    for (unsigned f = instance.first_face; f < instance.end_face; ++f) {
      const aiFace& face = from.mFaces[f];
      if (face.mNumIndices < 3) continue;  // points and lines
      if (!region_of_all) {
        region_of_all = regionIndex(region_name);
        material_of_all = materialIndex(instance.material, material);
      }
      corners.clear();
      for (unsigned c = 0; c < face.mNumIndices; ++c)
        corners.push_back(mesh_.vertices_m[base + face.mIndices[c]]);
      for (const auto& [a, b, c] : triangulate(corners)) {
        mesh_.triangles.push_back(
            {base + face.mIndices[a], base + face.mIndices[b], base + face.mIndices[c]});
        mesh_.region.push_back(*region_of_all);
        mesh_.material.push_back(*material_of_all);
      }
    }
  }

  sim::Mesh take() { return std::move(mesh_); }

 private:
  /// UVs and normals of the vertices that were just added; zero where the file has none.
  void addLooks(const MeshInstance& instance, std::uint32_t base) {
    const aiMesh& from = *instance.mesh;
    const std::size_t end = mesh_.vertices_m.size();
    if (instance.uvs != nullptr || from.HasTextureCoords(0)) {
      mesh_.uvs.resize(end, glm::vec2(0.0f));
      for (unsigned v = instance.first_vertex; v < instance.end_vertex; ++v)
        mesh_.uvs[base + v] = finite(instance.uvs != nullptr ? (*instance.uvs)[v] : uvOf(from, v));
    } else if (!mesh_.uvs.empty()) {
      mesh_.uvs.resize(end, glm::vec2(0.0f));
    }
    if (instance.normals != nullptr || from.HasNormals()) {
      mesh_.normals.resize(end, sim::Vec3f(0.0f));
      const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(instance.world_from_mesh)));
      for (unsigned v = instance.first_vertex; v < instance.end_vertex; ++v) {
        const sim::Vec3f normal = instance.normals != nullptr ? (*instance.normals)[v] : normalOf(from, v);
        mesh_.normals[base + v] = sim::unitOrNone(turn * sim::Vec3(normal));
      }
    } else if (!mesh_.normals.empty()) {
      mesh_.normals.resize(end, sim::Vec3f(0.0f));
    }
  }
  static glm::vec2 uvOf(const aiMesh& mesh, unsigned v) {
    return {mesh.mTextureCoords[0][v].x, mesh.mTextureCoords[0][v].y};
  }
  static sim::Vec3f normalOf(const aiMesh& mesh, unsigned v) {
    return {mesh.mNormals[v].x, mesh.mNormals[v].y, mesh.mNormals[v].z};
  }
  static glm::vec2 finite(glm::vec2 uv) {
    return std::isfinite(uv.x) && std::isfinite(uv.y) ? uv : glm::vec2(0.0f);
  }

  std::uint32_t regionIndex(const std::string& name) {
    const auto [at, is_new] =
        region_index_.try_emplace(name, static_cast<std::uint32_t>(mesh_.regions.size()));
    if (is_new) mesh_.regions.push_back(name);
    return at->second;
  }
  std::uint32_t materialIndex(std::size_t index_in_file, const sim::Material& material) {
    const auto [at, is_new] =
        material_index_.try_emplace(index_in_file, static_cast<std::uint32_t>(mesh_.materials.size()));
    if (is_new) mesh_.materials.push_back(material);
    return at->second;
  }

  std::map<std::string, std::uint32_t> region_index_;
  std::map<std::size_t, std::uint32_t> material_index_;
  sim::Mesh mesh_;
};

}  // namespace

std::string givenName(std::string_view raw) {
  const std::string name = cleanText(raw);
  return name.empty() || isMadeUp(name) ? std::string() : name;
}

std::vector<MeshInstance> instancesOf(const aiScene& scene) {
  struct Open {
    const aiNode* node;
    glm::dmat4 world_from_parent;
  };
  std::vector<MeshInstance> instances;
  std::vector<Open> open{{scene.mRootNode, glm::dmat4(1.0)}};
  std::size_t corners = 0;
  while (!open.empty()) {
    const Open next = open.back();
    open.pop_back();
    const glm::dmat4 world_from_mesh = next.world_from_parent * matrixOf(next.node->mTransformation);
    for (unsigned i = 0; i < next.node->mNumMeshes; ++i) {
      const aiMesh* mesh = scene.mMeshes[next.node->mMeshes[i]];
      for (unsigned f = 0; f < mesh->mNumFaces; ++f) corners += mesh->mFaces[f].mNumIndices;
      if (corners > 3 * kMostTriangles) {
        throw sim::InputError(
            fmt::format("there are more than {} triangles; make the mesh simpler first", kMostTriangles));
      }
      instances.push_back({world_from_mesh, mesh, 0, mesh->mNumFaces, 0, mesh->mNumVertices,
                           groupOf(*next.node, *mesh), mesh->mMaterialIndex});
    }
    for (unsigned i = next.node->mNumChildren; i-- > 0;)
      open.push_back({next.node->mChildren[i], world_from_mesh});
  }
  return instances;
}

sim::Mesh meshOf(const std::vector<MeshInstance>& instances, const std::vector<sim::Material>& materials,
                 RegionsFrom regions_from, const std::string& stem) {
  const bool has_groups =
      std::any_of(instances.begin(), instances.end(), [](const MeshInstance& i) { return !i.group.empty(); });
  const bool by_group = regions_from == RegionsFrom::group && has_groups;
  MeshBuilder builder(stem);
  for (const auto& instance : instances) {
    const sim::Material& material = materials.at(instance.material);
    const std::string& region = by_group ? instance.group : material.name;
    builder.add(instance, region.empty() ? stem : region, material);
  }
  return builder.take();
}

}  // namespace espalier::scenes
