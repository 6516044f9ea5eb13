#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/finish/daylight.h"
#include "render/finish/ray_scene.h"
#include "render/model/plant_model.h"
#include "render/voxels/panels.h"
#include "scenes/made/heights.h"
#include "scenes/scene.h"
#include "scenes/show/bounced_light.h"
#include "scenes/show/shown_field.h"
#include "scenes/show/shown_pieces.h"
#include "scenes/show/world_occupancy.h"
#include "scenes/write/output_folder.h"
#include "sim/base/provenance.h"
#include "sim/grow/grow.h"
#include "sim/light/brightest.h"
#include "sim/light/lighting.h"
#include "sim/tile/build_world.h"
#include "sim/world/world.h"

namespace espalier::scenes {

/// A plant whose threshold panels can show.
struct PlantLight {
  std::string name;
  render::LightNeeds needs;
};

/// What to draw.
struct PicturesWanted {
  std::string title;
  int width_px = 0, height_px = 0;
  std::vector<NamedCamera> cameras;
  std::vector<ImageSpec> images;
  sim::Vec3 to_sun{0.0, 1.0, 0.0};     ///< unit: of the shadow matte, the first pass and the vines
  std::vector<PlantLight> plants;      ///< those of the scene
  std::vector<UsedField> fields = {};  ///< likewise
  sim::Provenance made_by = {};        ///< for the files' headers
  std::optional<InterreflectionSpec> interreflection = {};  ///< of first passes, volumes and vines
  std::size_t film_frames = 0;                              ///< of the scene's film, which is drawn by others
  double film_pixels = 0.0;                                 ///< of each
  render::DaylightShare daylight = {};                      ///< of images of vines
  double bloom = 0.0;                                       ///< likewise; see render::bloom
};

/// What a plant's outermost rule set asks for.
render::LightNeeds lightNeeds(const rules::RuleSet& rules);

/// All that the scene itself asks for.
PicturesWanted picturesOf(const Scene& scene, const sim::Provenance& made_by = {});

/// What pictures are made from, once growth is done. Borrowed.
struct Finished {
  const std::vector<sim::TiledMesh>& meshes;
  const sim::World& world;
  const sim::BitVolume& bare;  ///< what the scene alone occupies
  const sim::Growth& growth;
  const sim::Lighting& light;                     ///< in all of space too, where there is an image of vines
  const std::vector<render::PlantModel>& models;  ///< one a plant
  render::KnownPictures textures = {};            ///< of the meshes' materials, for images of vines
  std::function<sim::SkyTable()> sky_table = {};  ///< as growth has it, for images of sky tables
  PictureLight lit = {};                          ///< beside `light`
  const WorldOccupancy* occupancy = nullptr;      ///< for images of volumes
  const std::vector<ShownPieces>* pieces = nullptr;  ///< for images of vines that show them
  const sim::Growth* grown = nullptr;  ///< for images of points and graphs: what grew, if it is not `growth`
  std::span<const MadeHeights> heights = {};  ///< for images of vines that show them
};

/// Whether it is one of the panels of render/voxels/panels.h.
bool isPanel(ImageKind kind);

/// The files that drawPictures makes.
std::vector<std::string> fileNames(const std::vector<ImageSpec>& images);

/// Draws images, in their order: PNG files for the eye, and EXR files with the pure values of the exposure
/// and colour panels. Throws sim::InputError; sim::Stopped.
std::vector<OutputFile> drawPictures(const PicturesWanted& wanted, const Finished& finished);

}  // namespace espalier::scenes
