#include "scenes/import/assimp_reader.h"

#include <assimp/BaseImporter.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/import/assimp_scene.h"
#include "scenes/import/mesh_checks.h"
#include "scenes/import/mesh_folder_io.h"
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

MeshColours coloursOf(Format format) {
  if (format == Format::gltf) return MeshColours::linear;
  return format == Format::obj ? MeshColours::display : MeshColours::none;
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

struct FaceCounts {
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  std::uint64_t triangles = 0;  ///< that the faces give
};

FaceCounts countFaces(const std::vector<MeshInstance>& instances) {
  FaceCounts counts;
  for (const auto& instance : instances) {
    counts.vertices += instance.mesh->mNumVertices;
    for (unsigned f = 0; f < instance.mesh->mNumFaces; ++f) {
      const unsigned corners = instance.mesh->mFaces[f].mNumIndices;
      ++counts.faces;
      counts.triangles += corners < 3 ? 0 : corners - 2;
    }
  }
  return counts;
}

/// What building the mesh relies on.
void requireSound(const aiMesh& mesh) {
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

void requireDeclared(const DeclaredCounts& declared, const FaceCounts& read, Format format) {
  const auto require = [](std::uint64_t promised, std::uint64_t got, const char* what) {
    if (promised == got) return;
    throw sim::InputError(fmt::format(
        "the file promises {} {} and {} could be read: it is cut, or asks for vertices that are not there",
        promised, what, got));
  };
  require(declared.vertices.value_or(read.vertices), read.vertices, "vertices");
  const auto faces = format == Format::gltf ? read.triangles : read.faces;
  require(declared.faces.value_or(faces), faces, format == Format::gltf ? "triangles" : "faces");
}

/// Assimp 5.2.5 puts the faces of an object that is taken up again (`o a`, `o b`, `o a`) into the object
/// before, and cuts an object's name at its first space. With groups it does neither.
void objectsAsGroups(std::string& obj) {
  bool line_begins = true;
  for (std::size_t at = 0; at + 1 < obj.size(); ++at) {
    if (line_begins && obj[at] == 'o' && (obj[at + 1] == ' ' || obj[at + 1] == '\t')) obj[at] = 'g';
    line_begins = obj[at] == '\n' || obj[at] == '\r';
  }
}

[[noreturn]] void failWith(const char* assimps_words) {
  const std::string_view words(assimps_words);
  if (words.find("alloc") != std::string_view::npos) throw std::bad_alloc();
  throw sim::InputError(fmt::format("cannot be read: {}", words.empty() ? "Assimp gives no reason" : words));
}

}  // namespace

void requireMeshFormat(const std::filesystem::path& file) {
  formatOf(file);
}

sim::Mesh meshFrom(const aiScene& scene, const std::filesystem::path& file, const DeclaredCounts& declared,
                   RegionsFrom regions_from) {
  const Format format = formatOf(file);
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) requireSound(*scene.mMeshes[m]);
  const auto instances = instancesOf(scene);
  requireDeclared(declared, countFaces(instances), format);
  return meshOf(scene, instances, regions_from, file.stem().string(), coloursOf(format));
}

sim::Mesh readWithAssimp(const std::filesystem::path& file, RegionsFrom regions_from,
                         std::vector<sim::InputFile>& files) {
  const Format format = formatOf(file);
  DeclaredCounts declared;
  if (format == Format::ply) declared = checkPly(file);
  if (format == Format::gltf) declared = checkGltf(file);

  Assimp::Importer importer;
  keepOnlyReaderOf(importer, format);
  const auto real = std::filesystem::canonical(file);
  auto* io = new MeshFolderIo(real, format == Format::obj ? objectsAsGroups : nullptr);
  importer.SetIOHandler(io);  // and owns it
  // By its name alone, so that all that the file asks for comes to the handler as a name in its folder.
  const aiScene* scene = importer.ReadFile(real.filename().string(), 0);
  if (!io->refused().empty()) {
    throw sim::InputError(
        fmt::format("it names the file '{}', which is not there as a regular file in its folder; put it "
                    "there or remove its name",
                    io->refused().front()));
  }
  if (scene == nullptr || scene->mRootNode == nullptr) failWith(importer.GetErrorString());
  files = io->files();
  return meshFrom(*scene, file, declared, regions_from);
}

}  // namespace espalier::scenes
