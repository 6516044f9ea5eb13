#include "scenes/import/assimp_reader.h"

#include <assimp/BaseImporter.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <functional>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/import/assimp_scene.h"
#include "scenes/import/gltf_check.h"
#include "scenes/import/mesh_folder_io.h"
#include "scenes/import/obj_reader.h"
#include "scenes/import/ply_check.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

constexpr unsigned kMostCorners = 4096;  // triangulation takes time by the square

enum class Format { obj, gltf, ply, stl };

Format formatOf(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (ending == ".obj") return Format::obj;
  if (ending == ".gltf" || ending == ".glb") return Format::gltf;
  if (ending == ".ply") return Format::ply;
  if (ending == ".stl") return Format::stl;
  throw sim::InputError(
      fmt::format("'{}' is not a mesh format that can be read: use .obj, .gltf, .glb, .ply or .stl", ending));
}

/// Leaves one reader: hostile text must not be tried as any of the fifty other formats that Assimp knows.
void keepOnlyReaderOf(Assimp::Importer& importer, Format format) {
  static constexpr std::array<std::string_view, 4> kNames{"Wavefront Object Importer", "glTF2 Importer",
                                                          "Stanford Polygon Library (PLY) Importer",
                                                          "Stereolithography (STL) Importer"};
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    if (kNames[static_cast<std::size_t>(format)] == importer.GetImporterInfo(i)->mName) continue;
    Assimp::BaseImporter* const other = importer.GetImporter(i);
    importer.UnregisterLoader(other);
    delete other;  // unregistering hands it over
  }
  if (importer.GetImporterCount() != 1) {
    throw sim::InputError("this build of Assimp has no reader for this format");
  }
}

/// What building the mesh relies on.
void requireSoundMesh(const aiMesh& mesh) {
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    const auto& p = mesh.mVertices[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw sim::InputError(fmt::format("vertex {} of '{}' is not a finite number ({}, {}, {})", v,
                                        mesh.mName.C_Str(), p.x, p.y, p.z));
    }
  }
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices > kMostCorners) {
      throw sim::InputError(fmt::format("a polygon has {} corners, more than {}; split it into triangles",
                                        face.mNumIndices, kMostCorners));
    }
    for (unsigned c = 0; c < face.mNumIndices; ++c) {
      if (face.mIndices[c] >= mesh.mNumVertices) {
        throw sim::InputError(fmt::format("face {} asks for vertex {} (counted from 0), but there are {}", f,
                                          face.mIndices[c], mesh.mNumVertices));
      }
    }
  }
}

void requireAll(std::uint64_t promised, std::uint64_t read, const char* what) {
  if (promised == read) return;
  throw sim::InputError(fmt::format(
      "the file promises {} {} and {} could be read: it is cut, or asks for vertices that are not there",
      promised, what, read));
}

[[noreturn]] void failWith(const char* assimps_words) {
  const std::string_view words(assimps_words);
  if (words.find("alloc") != std::string_view::npos) throw std::bad_alloc();
  throw sim::InputError(fmt::format("cannot be read: {}", words.empty() ? "Assimp gives no reason" : words));
}

}  // namespace

void requireSound(const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    requireSoundMesh(*scene.mMeshes[m]);
    if (scene.mMeshes[m]->mMaterialIndex >= scene.mNumMaterials)
      throw sim::InputError("cannot be read: a mesh has a material that is not there");
  }
  std::vector<const aiNode*> open{scene.mRootNode};
  while (!open.empty()) {
    const aiNode& node = *open.back();
    open.pop_back();
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] >= scene.mNumMeshes)
        throw sim::InputError("cannot be read: a node has a mesh that is not there");
    }
    open.insert(open.end(), node.mChildren, node.mChildren + node.mNumChildren);
  }
}

namespace {

/// Has Assimp read a file that the handler serves. By its name alone, so that all that the file asks for
/// comes to the handler as a name in its folder.
const aiScene& readScene(Assimp::Importer& importer, const MeshFolderIo& io, const std::string& name) {
  const aiScene* scene = importer.ReadFile(name, 0);
  if (!io.refused().empty()) {
    throw sim::InputError(fmt::format(
        "it names the file '{}', which is not there as a regular file in its folder", io.refused().front()));
  }
  if (scene == nullptr || scene->mRootNode == nullptr) failWith(importer.GetErrorString());
  requireSound(*scene);
  return *scene;
}

using ReadScene = std::function<const aiScene&(const std::string& name)>;

sim::Mesh readGltf(MeshFolderIo& io, const std::string& name, RegionsFrom regions_from,
                   const std::string& stem, const ReadScene& read_scene, std::vector<Problem>& warnings) {
  constexpr const char* kShown = "checked.gltf";
  const std::string* const file = io.read(name);
  if (file == nullptr) throw sim::InputError("cannot be read");
  gltf::Checked checked = gltf::check(*file, [&](const std::string& part) { return io.read(part); });
  io.show(kShown, checked.json);
  for (std::size_t i = 0; i < checked.buffers.count(); ++i)
    io.show(gltf::bufferName(i), checked.buffers.of(i));
  const aiScene& scene = read_scene(kShown);
  const auto instances = instancesOf(scene);
  std::uint64_t triangles = 0;
  for (const MeshInstance& instance : instances) {
    for (unsigned f = 0; f < instance.mesh->mNumFaces; ++f)
      triangles += std::max(instance.mesh->mFaces[f].mNumIndices, 2U) - 2;
  }
  requireAll(checked.triangles, triangles, "triangles");
  warnings.insert(warnings.end(), checked.warnings.begin(), checked.warnings.end());
  for (sim::Material& material : checked.materials) {
    material.name = givenName(material.name);
    if (material.name.empty()) material.name = stem;
  }
  checked.materials.push_back({.name = stem});  // for primitives that have none
  return meshOf(instances, checked.materials, regions_from, stem);
}

/// Materials of formats that have none.
std::vector<sim::Material> unnamed(const aiScene& scene, const std::string& stem) {
  return std::vector<sim::Material>(scene.mNumMaterials, sim::Material{.name = stem});
}

sim::Mesh readPly(const std::filesystem::path& file, RegionsFrom regions_from, const std::string& stem,
                  const ReadScene& read_scene) {
  const PlyCounts declared = checkPly(file);
  const aiScene& scene = read_scene(file.filename().string());
  const auto instances = instancesOf(scene);
  std::uint64_t vertices = 0, faces = 0;
  for (const MeshInstance& instance : instances) {
    vertices += instance.mesh->mNumVertices;
    faces += instance.mesh->mNumFaces;
  }
  requireAll(declared.vertices, vertices, "vertices");
  requireAll(declared.faces, faces, "faces");
  return meshOf(instances, unnamed(scene, stem), regions_from, stem);
}

sim::Mesh readStl(const std::filesystem::path& file, RegionsFrom regions_from, const std::string& stem,
                  const ReadScene& read_scene) {
  const aiScene& scene = read_scene(file.filename().string());
  return meshOf(instancesOf(scene), unnamed(scene, stem), regions_from, stem);
}

}  // namespace

void requireMeshFormat(const std::filesystem::path& file) {
  formatOf(file);
}

sim::Mesh readWithAssimp(const std::filesystem::path& file, RegionsFrom regions_from, MeshSources& sources) {
  const Format format = formatOf(file);
  const auto real = std::filesystem::canonical(file);
  const std::string name = real.filename().string(), stem = file.stem().string();
  Assimp::Importer importer;
  keepOnlyReaderOf(importer, format);
  auto* io = new MeshFolderIo(real);
  importer.SetIOHandler(io);  // and owns it
  const ReadScene read_scene = [&](const std::string& shown) -> const aiScene& {
    return readScene(importer, *io, shown);
  };
  const auto read = [&] {
    switch (format) {
      case Format::obj:
        return readObj(*io, name, regions_from, stem, read_scene, sources.warnings);
      case Format::gltf:
        return readGltf(*io, name, regions_from, stem, read_scene, sources.warnings);
      case Format::ply:
        return readPly(real, regions_from, stem, read_scene);
      case Format::stl:
        break;
    }
    return readStl(real, regions_from, stem, read_scene);
  };
  sim::Mesh mesh = read();
  sources.files = io->files();
  return mesh;
}

}  // namespace espalier::scenes
