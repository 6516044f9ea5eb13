#include "scenes/import/obj_reader.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <map>
#include <memory>
#include <set>
#include <span>
#include <sstream>
#include <utility>

#include "scenes/clean_text.h"
#include "scenes/import/assimp_scene.h"
#include "scenes/import/mtl.h"
#include "scenes/import/texture_files.h"
#include "sim/base/counted.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

constexpr const char* kShown = "shapes.obj";

/// The MTL files that an OBJ file names.
class MtlFiles {
 public:
  MtlFiles(MeshFolderIo& io, const ObjText& obj) : io_(io) {
    for (const ObjText::Named& library : obj.libraries) {
      std::istringstream words(library.name);
      std::string first, second;
      words >> first >> second;
      if (second.empty() || io.read(library.name) != nullptr) {  // a name may have spaces
        add(library.name, library);
        continue;
      }
      words.seekg(0);
      for (std::string name; words >> name && !name.starts_with('#');) add(name, library);
    }
  }

  bool allThere() const { return missing_.empty(); }
  const MtlMaterials& materials() const { return materials_; }

  /// The picture of one of the materials; null where it has none, or none is to be had.
  std::shared_ptr<const sim::Texture> textureOf(const std::string& name, const MtlMaterial& material) {
    if (material.picture.empty()) return nullptr;
    const auto wrap = material.clamps ? sim::Texture::Wrap::clamp : sim::Texture::Wrap::repeat;
    const std::size_t last = material.picture.rfind('/');
    // Beside the MTL file; a path of the machine that it was made on is of no use here but for the file's
    // name.
    for (const std::string& file :
         {folders_[name] + material.picture, folders_[name] + material.picture.substr(last + 1)}) {
      if (const std::string* const bytes = io_.read(file)) return textures_.add(file, *bytes, {wrap, wrap});
    }
    textures_.miss(material.picture, "is not there as a regular file in the mesh's folder");
    return nullptr;
  }

  /// One warning for all that are not there, and one for the first line that is wrong: a file may name a
  /// million.
  void warn(std::vector<Problem>& warnings) const {
    if (!missing_.empty()) {
      const std::string what =
          missing_.size() == 1
              ? fmt::format("the MTL file {} is not there as a regular file", inQuotes(missing_[0]))
              : fmt::format("the {} MTL files {} are not there as regular files", missing_.size(),
                            listed(missing_));
      warnings.push_back({{},
                          first_missing_.line,
                          first_missing_.column,
                          what + " in the mesh's folder; materials that no other file has are grey"});
    }
    if (!wrong_.text.empty()) warnings.push_back(wrong_);
    textures_.warn(warnings);
  }

 private:
  void add(const std::string& name, const ObjText::Named& library) {
    if (!known_.insert(name).second) return;
    const std::string* const mtl = io_.read(name);
    if (mtl == nullptr) {
      if (missing_.empty()) first_missing_ = library;
      missing_.push_back(name);
      return;
    }
    const int line = readMtl(*mtl, materials_);
    const std::string folder = name.substr(0, name.rfind('/') + 1);
    for (const auto& [material, about] : materials_) folders_.try_emplace(material, folder);
    if (line == 0 || !wrong_.text.empty()) return;
    wrong_ = {{},
              library.line,
              library.column,
              fmt::format("line {} of the MTL file {} is neither a colour nor an opacity, and is left out",
                          line, inQuotes(name))};
  }

  MeshFolderIo& io_;
  std::set<std::string> known_;
  MtlMaterials materials_;
  std::map<std::string, std::string> folders_;  // of the MTL files that have them
  TextureFiles textures_;
  std::vector<std::string> missing_;
  ObjText::Named first_missing_;
  Problem wrong_;
};

/// The materials that the file's polygons have, by their numbers in the order of first use.
class ObjMaterials {
 public:
  ObjMaterials(MtlFiles& files, const std::string& stem) : stem_(stem), files_(files) {}

  std::size_t number(const ObjText::Named& material) {
    const auto [at, is_new] = numbers_.try_emplace(material.name, materials_.size());
    if (is_new) materials_.push_back(find(material));
    return at->second;
  }
  const std::vector<sim::Material>& materials() const { return materials_; }
  /// Moves UVs as the material's picture wants it.
  void move(const std::string& name, std::span<glm::vec2> uvs) const {
    const auto known = files_.materials().find(name);
    if (known == files_.materials().end()) return;
    const MtlMaterial& material = known->second;
    for (glm::vec2& uv : uvs) uv = uv * material.scale + material.offset;
  }

  /// One warning for all that no file has.
  void warn(bool names_files, std::vector<Problem>& warnings) const {
    if (unknown_.empty()) return;
    const char* const none = names_files ? "no MTL file that it names has" : "it names no MTL file that has";
    warnings.push_back({{},
                        first_unknown_.line,
                        first_unknown_.column,
                        unknown_.size() == 1
                            ? fmt::format("{} the material {}, which is grey", none, inQuotes(unknown_[0]))
                            : fmt::format("{} the {} materials {}, which are grey", none, unknown_.size(),
                                          listed(unknown_))});
  }

 private:
  sim::Material find(const ObjText::Named& material) {
    if (material.name.empty()) return {.name = stem_};
    const auto known = files_.materials().find(material.name);
    const bool is_known = known != files_.materials().end();
    sim::Material found = is_known ? known->second.material : unknownMaterial(cleanText(material.name));
    if (is_known) {
      found.texture = files_.textureOf(material.name, known->second);
    } else {
      if (unknown_.empty()) first_unknown_ = material;
      unknown_.push_back(found.name);
    }
    if (found.name.empty()) found.name = stem_;  // nothing in it can be shown
    return found;
  }

  std::string stem_;
  MtlFiles& files_;
  std::map<std::string, std::size_t> numbers_;
  std::vector<sim::Material> materials_;
  std::vector<std::string> unknown_;
  ObjText::Named first_unknown_;
};

/// Assimp gives the polygons of its one mesh in the file's order, each with corners of its own.
std::vector<MeshInstance> instancesOf(const aiMesh& mesh, ObjText& obj, ObjMaterials& materials) {
  std::vector<MeshInstance> instances;
  unsigned vertex = 0;
  for (std::size_t s = 0; s < obj.stretches.size(); ++s) {
    const ObjText::Stretch& stretch = obj.stretches[s];
    MeshInstance instance;
    instance.mesh = &mesh;
    instance.first_face = static_cast<unsigned>(stretch.first_polygon);
    instance.end_face = s + 1 < obj.stretches.size()
                            ? static_cast<unsigned>(obj.stretches[s + 1].first_polygon)
                            : mesh.mNumFaces;
    instance.first_vertex = vertex;
    for (unsigned f = instance.first_face; f < instance.end_face; ++f) {
      for (unsigned c = 0; c < mesh.mFaces[f].mNumIndices; ++c) {
        if (mesh.mFaces[f].mIndices[c] != vertex++)
          throw sim::InputError("cannot be read: Assimp mixed up the corners of its polygons");
      }
    }
    instance.end_vertex = vertex;
    instance.group = cleanText(stretch.group);
    instance.material = materials.number(stretch.material);
    if (!obj.uvs.empty()) {
      instance.uvs = &obj.uvs;
      materials.move(stretch.material.name,
                     std::span(obj.uvs).subspan(instance.first_vertex, vertex - instance.first_vertex));
    }
    if (!obj.normals.empty()) instance.normals = &obj.normals;
    instances.push_back(std::move(instance));
  }
  return instances;
}

}  // namespace

sim::Mesh readObj(MeshFolderIo& io, const std::string& name, RegionsFrom regions_from,
                  const std::string& stem,
                  const std::function<const aiScene&(const std::string& shown)>& read_scene,
                  std::vector<Problem>& warnings) {
  const std::string* const text = io.read(name);
  if (text == nullptr) throw sim::InputError("cannot be read");
  ObjText obj = takeApart(*text);
  if (obj.polygons == 0) throw sim::InputError("there are no triangles in the file");
  MtlFiles files(io, obj);
  ObjMaterials materials(files, stem);
  io.show(kShown, obj.shapes);
  const aiScene& scene = read_scene(kShown);
  if (scene.mNumMeshes != 1 || scene.mMeshes[0]->mNumFaces != obj.polygons)
    throw sim::InputError("cannot be read: Assimp left out some of its polygons");
  const auto instances = instancesOf(*scene.mMeshes[0], obj, materials);
  files.warn(warnings);
  if (obj.odd_corners > 0) {
    warnings.push_back({{},
                        0,
                        0,
                        fmt::format("{} for texture vertices or normals that are not there, and {} none",
                                    sim::counted(obj.odd_corners, "corner of its polygons asks",
                                                 "corners of its polygons ask"),
                                    obj.odd_corners == 1 ? "has" : "have")});
  }
  if (files.allThere()) materials.warn(!obj.libraries.empty(), warnings);
  return meshOf(instances, materials.materials(), regions_from, stem);
}

}  // namespace espalier::scenes
