#include "scenes/import/obj_reader.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <map>
#include <sstream>
#include <utility>

#include "scenes/clean_text.h"
#include "scenes/import/assimp_scene.h"
#include "scenes/import/mtl.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

constexpr const char* kShown = "shapes.obj";

/// The materials of the MTL files that are there; warns of the others.
MtlMaterials materialsOf(MeshFolderIo& io, const ObjText& obj, std::vector<Problem>& warnings) {
  MtlMaterials materials;
  const auto warn = [&](const ObjText::Named& library, const std::string& what) {
    warnings.push_back({{}, library.line, library.column, what});
  };
  const auto add = [&](const std::string& name, const ObjText::Named& library) {
    const std::string* const mtl = io.read(name);
    if (mtl == nullptr) {
      warn(library, fmt::format("the MTL file {} is not there as a regular file in the mesh's folder; its "
                                "materials are grey",
                                inQuotes(name)));
    } else if (const int line = readMtl(*mtl, materials); line > 0) {
      warn(library, fmt::format("line {} of the MTL file {} is no colour; its material is grey", line,
                                inQuotes(name)));
    }
  };
  for (const ObjText::Named& library : obj.libraries) {
    std::istringstream words(library.name);
    std::string first, second;
    words >> first >> second;
    if (second.empty() || io.read(library.name) != nullptr) {  // a name may have spaces
      add(library.name, library);
      continue;
    }
    words.seekg(0);
    for (std::string name; words >> name;) add(name, library);
  }
  return materials;
}

/// The materials that the file's polygons have, by their numbers in the order of first use.
class ObjMaterials {
 public:
  ObjMaterials(MtlMaterials known, const std::string& stem) : stem_(stem), known_(std::move(known)) {}

  std::size_t number(const ObjText::Named& material) {
    const auto [at, is_new] = numbers_.try_emplace(material.name, materials_.size());
    if (is_new) materials_.push_back(find(material));
    return at->second;
  }
  const std::vector<sim::Material>& materials() const { return materials_; }

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
    if (const auto known = known_.find(material.name); known != known_.end()) return known->second;
    if (unknown_.empty()) first_unknown_ = material;
    unknown_.push_back(cleanText(material.name));
    return unknownMaterial(unknown_.back());
  }

  std::string stem_;
  MtlMaterials known_;
  std::map<std::string, std::size_t> numbers_;
  std::vector<sim::Material> materials_;
  std::vector<std::string> unknown_;
  ObjText::Named first_unknown_;
};

/// Assimp gives the polygons of its one mesh in the file's order, each with corners of its own.
std::vector<MeshInstance> instancesOf(const aiMesh& mesh, const ObjText& obj, ObjMaterials& materials) {
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
  const ObjText obj = takeApart(*text);
  if (obj.polygons == 0) throw sim::InputError("there are no triangles in the file");
  ObjMaterials materials(materialsOf(io, obj, warnings), stem);
  const bool all_there = warnings.empty();
  io.show(kShown, obj.shapes);
  const aiScene& scene = read_scene(kShown);
  if (scene.mNumMeshes != 1 || scene.mMeshes[0]->mNumFaces != obj.polygons)
    throw sim::InputError("cannot be read: Assimp left out some of its polygons");
  const auto instances = instancesOf(*scene.mMeshes[0], obj, materials);
  if (all_there) materials.warn(!obj.libraries.empty(), warnings);
  return meshOf(instances, materials.materials(), regions_from, stem);
}

}  // namespace espalier::scenes
