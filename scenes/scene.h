#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/image/camera.h"
#include "rules/front/guide.h"
#include "rules/language/emission.h"
#include "rules/language/envelope_spec.h"
#include "rules/language/rule_set.h"
#include "scenes/film.h"
#include "scenes/light_spec.h"
#include "scenes/made_spec.h"
#include "scenes/problem.h"
#include "scenes/product.h"
#include "sim/base/provenance.h"
#include "sim/base/vec.h"

/// A scene as plain structs: what was asked for, with nothing yet read but the rule files it names.
/// Positions are in world metres, y up. scenes/read/registry.h describes every key.
namespace espalier::scenes {

/// What boundary layers a world may have.
inline constexpr int kMostLayers = 64;

enum class RegionsFrom { group, material };

/// What a file's numbers may count, and which of its axes may point up.
enum class LengthUnit { m, cm, mm, in, ft };
enum class UpAxis { y, z };

/// The unit's name in scene files.
std::string_view nameOf(LengthUnit unit);

/// How what a file holds is placed in world space (scenes/import/placing.h).
struct Placement {
  std::optional<LengthUnit> unit = {};  ///< of the file's numbers; without one, metres
  UpAxis up = UpAxis::y;                ///< what points up in the file
  double scale = 1.0;
  sim::Vec3 rotate_deg{0.0};  ///< about x, then y, then z
  sim::Vec3 translate_m{0.0};
};

/// A mesh, a polyline or points, to be tiled into the world.
struct SceneMesh {
  std::string name;  ///< defaults to the file's stem
  std::filesystem::path file;
  std::filesystem::path from;  ///< or another scene, whose product it is
  std::string product;         ///< empty: its only mesh
  std::string told;  ///< what reports call the file, without a path of the machine; empty: its last name
  RegionsFrom regions_from = RegionsFrom::group;  ///< which names of the file become regions
  std::optional<bool> solid;                      ///< fill the inside; unset: where the mesh is closed
  bool tiled = true;      ///< false: no part of the world, a shape for attractors alone
  bool optional = false;  ///< a missing file skips the scene instead of being an error
  /// In place of a file, or an .obj file without faces: polylines; one of a single place is a point.
  std::vector<std::vector<sim::Vec3>> lines_m;
  double thickness_m = 0.02;  ///< of lines and points as they are drawn; of what is open
  bool guide = false;         ///< is felt and stands in nobody's way (sim::TiledMesh)
  bool shade = true;          ///< takes light
  Placement placement;
  std::optional<sim::Colour> colour;     ///< instead of the file's materials; linear RGB
  std::optional<rules::Emission> emits;  ///< likewise
  std::optional<double> alpha;           ///< likewise: how much it hides of what is behind it, 0..1
  Place place = {};                      ///< where a scene file has it; without a path where none does
};

struct WorldSpec {
  std::optional<double> voxel_m;                     ///< either this
  std::optional<int> resolution;                     ///< or the number of voxels along the longest side
  std::optional<double> margin_m;                    ///< unset: room for light beside and above the meshes
  std::optional<std::array<sim::Vec3, 2>> bounds_m;  ///< instead of the meshes' bounds plus margin
  int layers = 4;    ///< at least so many; more where the rules of its plants ask for them (layersFor)
  Place place = {};  ///< where a scene file says how large it is; without a path where none does
};

struct Scatter {
  std::string region;  ///< seeds stand on the voxels of this region that look up
  int count = 0;
  Place region_place = {};  ///< where a scene file names the region; without a path where none does
};

struct SeedSpec {
  sim::Vec3 at_m{0.0};
  std::string key;   ///< what its random numbers hang on; empty: its place
  Place place = {};  ///< where a scene file has it; without a path where none does
};

/// A table of points in a file, if its path is not empty.
struct PointTable {
  std::filesystem::path file;
  std::string told;         ///< what reports call it
  std::optional<int> type;  ///< of the points that are meant, in the fourth column; without it all are
  Place place = {};         ///< where a scene file names it; without a path where none does
};

/// Trees that somebody else made, from a file, in place of growth. Placed as meshes are.
struct SkeletonSpec {
  std::filesystem::path file;
  std::filesystem::path from;  ///< or another scene, whose product they are
  std::string told;            ///< what reports call the file
  Placement placement;
  Place place = {};  ///< where a scene file names it; without a path where none does
};

struct PlantSpec {
  std::string name;
  std::filesystem::path rules_file;
  std::shared_ptr<const rules::RuleSet> rules;
  Place rules_place = {};  ///< where the scene file names them; without a path where none does
  std::vector<SeedSpec> seeds;
  std::optional<Scatter> scatter;
  PointTable table;                      ///< of more seeds
  std::optional<SkeletonSpec> skeleton;  ///< instead of all these: its roots are the seeds
};

/// Whether a planting's rules have it lay elements on surfaces.
inline bool lays(const PlantSpec& plant) {
  return !plant.skeleton && plant.rules->propagate == rules::Propagate::diffusion;
}

/// What the attractors of a planting's own crown are called.
inline std::string crownOf(const std::string& planting) {
  return "crown of " + planting;
}

/// Whether a planting's rules have it colonize.
inline bool colonizes(const PlantSpec& plant) {
  return !plant.skeleton && plant.rules->propagate == rules::Propagate::colonization;
}

/// What the attractors are called that a planting's front grows to: the scene's, or its own crown.
inline std::string attractorsFor(const PlantSpec& plant) {
  const rules::Colonization& front = plant.rules->colonization;
  return front.crown ? crownOf(plant.name) : front.attractors;
}

/// A picture that says how dense points lie, and where its corners are.
struct PictureSpec {
  std::filesystem::path file;
  std::filesystem::path from;  ///< or another scene, whose product it is
  std::string product;         ///< empty: its only picture
  std::string told;            ///< what reports call it
  sim::Vec3 top_left_m{0.0}, top_right_m{0.0}, bottom_left_m{0.0};
  Place place = {};  ///< where a scene file names it
};

/// Points that plants grow towards, from exactly one source.
struct AttractorsSpec {
  std::string name;
  rules::EnvelopeSpec solid;           ///< either this
  std::optional<sim::Vec3> at_m;       ///< its foot
  std::string surface;                 ///< or the name of a mesh that they lie on
  std::string inside;                  ///< or of one that they lie in
  PointTable table;                    ///< or a file that lists them
  std::optional<PictureSpec> picture;  ///< or one that they lie in, as dense as it is bright
  rules::StrewingSpec strewing;        ///< spread and density: of a solid
  std::optional<double> spacing_m;     ///< on a surface or a picture: the least between two
  int waves = 1;  ///< in which they come: each twice as dense as those before it, when nothing moves any more
  Place place = {};  ///< where a scene file has it
};

struct NamedCamera {
  std::string name;
  render::Camera camera;
  Place eye_place = {};  ///< where a scene file has its eye; without a path where none does
};

enum class ImageKind {
  sun_exposure,
  sky_exposure,
  threshold,
  shadow_matte,
  surface_colour,
  first_pass,   // Greene's figure 6
  volume,       // the same, with opacity accumulated along rays
  sun_hours,    // of direct sun, a day
  vines,        // the plant itself, leaves and stems
  section,      // a cut through the world with its boundary layers
  attempts,     // every trial of a flat walk and the voxels taken, beside the skeleton
  points,       // nodes and attractors of colonization
  graph,        // the plants' out-trees as lines
  field,        // a guide field as arrows
  narrow_band,  // a cut through the level set of a mesh
  cut_out,      // a mesh straight on with what grew on it, and nothing beyond its outline
  sky_tables,   // what a limb's tips saw of the sky (Greene's figure 7)
  voxels,       // a small world's voxels as cubes, with what occupies them (his figure 1)
  contact_sheet
};

/// The kind's name in scene files.
std::string_view nameOf(ImageKind kind);

struct ImageSpec {
  std::string name;  ///< file name without an ending
  ImageKind kind = ImageKind::vines;
  std::string camera;  ///< empty: the first one
  std::string plant;   ///< threshold, sky_tables: whose it is; empty: that of the first one
  std::string caption;
  std::string letter;            ///< on a contact sheet; empty: A, B, C .. in order
  char axis = 'y';               ///< section, narrow_band: which way the cut looks
  double at_m = 0.0;             ///< section, narrow_band: where the cut lies on that axis
  std::string mesh;              ///< narrow_band, cut_out: which of the meshes; empty: the first one
  std::string field;             ///< field: which of the fields; empty: the first one
  std::string heights;           ///< vines that show heights: which of them; empty: the first ones
  std::optional<int> iteration;  ///< points, graph: what stands after so many iterations; without: at the end
  std::vector<std::string> of;   ///< contact_sheet: names of the images on it, in order
  std::vector<std::string> show{"scene", "stems", "elements"};  ///< vines: what of it; kImageParts
  double apart = 0.0;  ///< vines that show pieces: how far these are moved away from their middle, as a share
                       ///< of how far they are from it
};

/// What images of vines may show.
inline constexpr std::array<std::string_view, 6> kImageParts{"scene", "stems", "elements", "guides",
                                                             "pieces", "heights"};

/// A region that a rule file names, and where.
struct RegionMention {
  std::string region;
  Place place;
  bool sensed = false;  ///< by a sense, which finds only what fills voxels
};

/// A guide field that bends fronts.
struct FieldSpec {
  std::string name;
  rules::Guide guide;                        ///< all but its points, orders, grid and region; in metres
  std::vector<rules::GuidePoint> points;     ///< its own
  std::filesystem::path file;                ///< of GuideAxis::grid: a volume
  std::string told;                          ///< what reports call that file
  std::string grid;                          ///< its grid; empty: the only one
  std::string within;                        ///< the name of a mesh: holds in its inside alone
  int order_first = 0, order_last = 1000;    ///< of limbs for which it holds
  Place file_place = {}, within_place = {};  ///< where a scene file names them
};

struct Scene {
  std::string name = "unnamed";
  std::filesystem::path file;                     ///< where it was read from
  std::vector<sim::InputFile> read_files;         ///< itself and its rule files, in the order of reading
  std::vector<std::filesystem::path> read_paths;  ///< where those are, and its meshes
  std::vector<ProductAsk> asks;                   ///< for products of other scenes, its rule files' too
  std::vector<SceneMesh> meshes;
  WorldSpec world;
  SkySpec sky;
  SunSpec sun;
  ExposureSpec exposure;
  std::optional<InterreflectionSpec>
      interreflection;  ///< none: pictures are lit by the sky and the sun alone
  std::vector<AttractorsSpec> attractors;
  std::vector<FieldSpec> fields;
  std::vector<PlantSpec> plants;
  std::vector<PiecesSpec> pieces;
  std::vector<HeightsSpec> heights;
  std::vector<RegionMention> region_mentions;  ///< in the rules of its plants: each place once
  std::vector<Problem> warnings;               ///< what its files say without effect
  int iterations = 50;
  std::optional<int> skeleton_iterations;  ///< in which given skeletons grow whole; without it, in all
  std::uint64_t seed = 1;
  int image_width = 1280;
  int image_height = 960;
  double bloom = 0.0;  ///< of images of vines: the share that spreads of what is brighter than white
  Place images_place;  ///< where a scene file says how large images are, or which; without a path where none
                       ///< does
  std::vector<NamedCamera> cameras;
  std::vector<ImageSpec> images;
  std::optional<FilmSpec> film;
};

/// Calls visit(table, "attractors.crown") for the tables of attractors, then of plants, with the path of what
/// has them; also for those that are not there.
template <class Scene_, class Visit>
void forEachTable(Scene_& scene, Visit visit) {
  for (auto& attractors : scene.attractors) visit(attractors.table, "attractors." + attractors.name);
  for (std::size_t i = 0; i < scene.plants.size(); ++i)
    visit(scene.plants[i].table, "plants[" + std::to_string(i) + "]");
}

}  // namespace espalier::scenes
