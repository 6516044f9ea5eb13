#include "scenes/prepare/site_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "scenes/clean_text.h"
#include "scenes/import/density_reader.h"
#include "scenes/import/line_shape.h"
#include "scenes/import/mesh_import.h"
#include "scenes/import/points_reader.h"
#include "scenes/import/skeleton_reader.h"
#include "scenes/import/sky_reader.h"

namespace espalier::scenes {
namespace {

/// Adds a mesh's files, called from the scene's file as the mesh is.
void addFiles(const SceneMesh& spec, const std::vector<sim::InputFile>& read, SiteFiles& to) {
  const std::filesystem::path told =
      spec.told.empty() ? spec.file.filename() : std::filesystem::path(spec.told);
  for (const sim::InputFile& file : read) {
    sim::InputFile named = file;
    named.name = file.kind == "mesh" ? cleanText(told.generic_string())
                                     : cleanText((told.parent_path() / file.name).generic_string());
    to.mesh_paths.push_back(file.kind == "mesh" ? spec.file : spec.file.parent_path() / file.name);
    if (std::find(to.mesh_files.begin(), to.mesh_files.end(), named) == to.mesh_files.end())
      to.mesh_files.push_back(std::move(named));
  }
}

/// Adds a file that stands alone, called as the scene's file calls it.
void addFile(const std::filesystem::path& path, const std::string& told, sim::InputFile read, SiteFiles& to) {
  if (!told.empty()) read.name = told;
  to.mesh_paths.push_back(path);
  if (std::find(to.mesh_files.begin(), to.mesh_files.end(), read) == to.mesh_files.end())
    to.mesh_files.push_back(std::move(read));
}

sim::Mesh readMesh(const SceneMesh& spec, SiteFiles& to) {
  MeshSources read;
  sim::Mesh mesh = placeMesh(importMesh(spec.file, spec.regions_from, std::nullopt, &read), spec.placement);
  addFiles(spec, read.files, to);
  for (Problem& warning : read.warnings) {  // of materials, which nobody sees under a colour of the scene's
    if (spec.tiled && !spec.colour &&
        std::find(to.warnings.begin(), to.warnings.end(), warning) == to.warnings.end())
      to.warnings.push_back(std::move(warning));
  }
  if (spec.colour) {
    for (sim::Material& material : mesh.materials) {
      material.colour = *spec.colour;
      material.texture.reset();
    }
  }
  if (spec.emits) {
    for (sim::Material& material : mesh.materials) material.emissive = spec.emits->light();
  }
  if (spec.alpha) {
    for (sim::Material& material : mesh.materials) sim::setOpacity(material, *spec.alpha);
  }
  return mesh;
}

void addMesh(const SceneMesh& spec, sim::Mesh mesh, SiteFiles& to) {
  mesh.name = spec.name;
  if (spec.tiled) {
    to.meshes.push_back({std::move(mesh), spec.solid.value_or(false), !spec.solid && !spec.guide});
    to.meshes.back().guide = spec.guide;
    to.meshes.back().shade = spec.shade;
    return;
  }
  mesh.uvs = {};  // nobody sees it
  mesh.normals = {};
  for (sim::Material& material : mesh.materials) material.texture.reset();
  to.shapes.push_back(std::move(mesh));
}

/// Adds a mesh by its file, or lines.
void readInto(const SceneMesh& spec, SiteFiles& to) {
  std::optional<LineArt> art;
  if (!spec.lines_m.empty()) art = linesOf(spec);
  if (!art && spec.tiled && spec.file.extension() == ".obj") {
    sim::InputFile read;
    if (art = readLineFile(spec.file, spec.regions_from, read); art) addFiles(spec, {read}, to);
  }
  if (!art) return addMesh(spec, readMesh(spec, to), to);
  to.meshes.push_back(lineShape(spec, std::move(*art)));
}

void addTable(const PointTable& table, SiteFiles& to) {
  to.listed_m.emplace_back();
  if (table.file.empty()) return;
  sim::InputFile read;
  to.listed_m.back() = readPoints(table.file, table.type, read);
  addFile(table.file, table.told, std::move(read), to);
}

void addDensity(const AttractorsSpec& spec, SiteFiles& to) {
  to.densities.emplace_back();
  if (!spec.picture) return;
  sim::InputFile read;
  to.densities.back() = readDensity(spec.picture->file, read);
  addFile(spec.picture->file, spec.picture->told, std::move(read), to);
}

void addSkeletons(const PlantSpec& plant, SiteFiles& to) {
  to.skeletons.emplace_back();
  if (!plant.skeleton) return;
  const SkeletonSpec& spec = *plant.skeleton;
  sim::InputFile read;
  to.skeletons.back() = readSkeletons(spec.file, read);
  placeSkeletons(to.skeletons.back(), spec.placement);
  addFile(spec.file, spec.told, std::move(read), to);
}

void addFields(const Scene& scene, SiteFiles& to) {
  std::vector<sim::InputFile> read;
  to.fields = readFieldGrids(scene, read, to.warnings);
  for (sim::InputFile& file : read) {
    if (std::find(to.mesh_files.begin(), to.mesh_files.end(), file) == to.mesh_files.end())
      to.mesh_files.push_back(std::move(file));
  }
  for (const FieldSpec& field : scene.fields) {
    if (!field.file.empty()) to.mesh_paths.push_back(field.file);
  }
}

/// Adds all that is no mesh, and sees to the sides of the meshes.
void addTheRest(const Scene& scene, SiteFiles& to, Gathering& wrong) {
  forEachTable(scene, [&](const PointTable& table, const std::string&) {
    wrong.part(table.place, [&] { addTable(table, to); });
  });
  for (const AttractorsSpec& spec : scene.attractors) {
    wrong.part(spec.picture ? spec.picture->place : Place{}, [&] { addDensity(spec, to); });
  }
  for (const PlantSpec& plant : scene.plants) {
    wrong.part(plant.skeleton ? plant.skeleton->place : Place{}, [&] { addSkeletons(plant, to); });
  }
  wrong.part([&] { addFields(scene, to); });
  const BackgroundSpec& background = scene.sky.background;
  wrong.part(background.file_place, [&] {
    if (background.file.empty()) return;
    sim::InputFile read;
    to.sky_picture = readSky(background.file, read);
    addFile(background.file, background.told, std::move(read), to);
  });
  wrong.end();
  to.facings = findFacing(to.meshes);
}

}  // namespace

MeshMissing::MeshMissing(const Scene& scene, const SceneMesh& mesh)
    : runtime_error(fmt::format("the mesh {} is not there; skipped, as the scene calls it optional",
                                mesh.file.string())),
      problem_(problemAt(mesh.place, scene.file, what())) {}

SiteFiles readSiteFiles(const Scene& scene) {
  for (const SceneMesh& spec : scene.meshes) {
    std::error_code unknown;  // what cannot be looked at is there, and an error when it is read
    if (spec.optional &&
        std::filesystem::status(spec.file, unknown).type() == std::filesystem::file_type::not_found)
      throw MeshMissing(scene, spec);
  }
  SiteFiles files;
  Gathering wrong(scene.file);
  for (const SceneMesh& spec : scene.meshes) wrong.part(spec.place, [&] { readInto(spec, files); });
  addTheRest(scene, files, wrong);
  return files;
}

SiteFiles readSiteFiles(const Scene& scene, std::vector<sim::Mesh> placed) {
  SiteFiles files;
  Gathering wrong(scene.file);
  for (std::size_t i = 0; i < placed.size(); ++i) addMesh(scene.meshes.at(i), std::move(placed[i]), files);
  addTheRest(scene, files, wrong);
  return files;
}

}  // namespace espalier::scenes
