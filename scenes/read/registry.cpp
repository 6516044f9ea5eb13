#include "scenes/read/registry.h"

#include "rules/language/emission_keys.h"
#include "rules/language/key_builder.h"
#include "scenes/read/attractor_keys.h"
#include "scenes/read/field_keys.h"
#include "scenes/read/film_keys.h"
#include "scenes/read/heights_keys.h"
#include "scenes/read/light_keys.h"
#include "scenes/read/piece_keys.h"
#include "scenes/read/units.h"
#include "scenes/scene.h"
#include "sim/tile/build_world.h"

namespace espalier::scenes {
namespace {

using rules::About;
using rules::Datum;
using rules::Kind;
using rules::Limits;
using rules::RuleReference;
using rules::Table;
using rules::TableOf;

constexpr Limits kPositive{0.0, 1e6, true};
constexpr std::size_t kMostEntries = 1000;

/// How what a file holds is placed.
template <class Placed>
void addPlacement(TableOf<Placed>& table) {
  std::vector<std::pair<std::string, LengthUnit>> units;
  for (const auto unit : {LengthUnit::m, LengthUnit::cm, LengthUnit::mm, LengthUnit::in, LengthUnit::ft})
    units.emplace_back(nameOf(unit), unit);
  table
      .template choice<LengthUnit>(
          "unit", [](auto& p) -> auto& { return p.placement.unit; }, units,
          {.meaning = "What the file's numbers count: they become metres first of all; without it, metres."})
      .template choice<UpAxis>(
          "up", [](auto& p) -> auto& { return p.placement.up; }, {{"y", UpAxis::y}, {"z", UpAxis::z}},
          {.meaning = "Which way is up in the file: z is turned to y, and y to -z, before anything else "
                      "turns it."})
      .number(
          "scale", [](auto& p) -> auto& { return p.placement.scale; },
          {.unit = "factor", .limits = kPositive, .meaning = "How many times as large; after unit and up."})
      .point(
          "rotate", [](auto& p) -> auto& { return p.placement.rotate_deg; },
          {.unit = kDegrees, .limits = {-360.0, 360.0}, .meaning = "About x, then y, then z; after scale."})
      .place("translate", [](auto& p) -> auto& { return p.placement.translate_m; },
             {.unit = kMetres, .limits = kCoordinate, .meaning = "Applied last."});
}

std::shared_ptr<const Table> meshKeys() {
  TableOf<SceneMesh> table;
  table
      .file("file", &SceneMesh::file,
            {.meaning = "The mesh: .obj, .gltf, .glb, .ply or .stl; or an .obj of lines and points alone."})
      .file("from", &SceneMesh::from,
            {.meaning = "Or another scene, which is run first: the mesh is a product of its."})
      .name(
          "product", &SceneMesh::product,
          {.meaning = "Which of that scene's meshes; without it, the only one. The plants' is called plant."})
      .custom(
          "lines", Kind::lines,
          [](SceneMesh& mesh, const Datum& d) { mesh.lines_m = std::get<rules::Polygons>(d).corners; },
          [](const SceneMesh& mesh) {
            return mesh.lines_m.empty() ? Datum{} : Datum{rules::Polygons{mesh.lines_m, true}};
          },
          {.unit = kMetres,
           .limits = kCoordinate,
           .meaning = "Or lines from place to place; one of a single place is a point.",
           .most = 10'000})
      .name("name", &SceneMesh::name,
            {.meaning = "What reports and outputs call it; without it, the file's name without its ending."})
      .choice<RegionsFrom>(
          "regions", &SceneMesh::regions_from,
          {{"group", RegionsFrom::group}, {"material", RegionsFrom::material}},
          {.meaning = "Whether the file's groups or its materials become regions that rules can name."})
      .flag("solid", &SceneMesh::solid,
            {.meaning = "Fills the inside, or not. Without it: where the mesh is closed, and faces turn to "
                        "the light."})
      .flag("tiled", &SceneMesh::tiled,
            {.meaning = "Whether it stands in the world; otherwise it is a shape for attractors alone."})
      .flag("optional", &SceneMesh::optional,
            {.meaning = "Where the file is missing, the scene is skipped instead of being an error."})
      .flag("guide", &SceneMesh::guide,
            {.meaning = "Is felt by what grows, as near and as a region, but stands in nobody's way and "
                        "casts no shadow: a sketch for growth to follow."})
      .flag("shade", &SceneMesh::shade,
            {.meaning = "Whether it takes light; otherwise nothing grows through it, but light goes, as "
                        "through glass."})
      .metres("thickness", &SceneMesh::thickness_m,
              {.unit = kMetres,
               .limits = {0.0, 1e6, true},
               .meaning = "Of lines and points, where they are drawn; and of what encloses nothing, as the "
                          "share of voxels that it takes (alpha) has it."});
  addPlacement(table);
  return table.colour("colour", &SceneMesh::colour, {.meaning = "Instead of the file's own colours."})
      .section("emits", &SceneMesh::emits, rules::emissionKeys(),
               {.meaning = "Light that it sends out, instead of the file's own, and with interreflection "
                           "onto others too."},
               "colour")
      .number(
          "opacity", &SceneMesh::alpha,
          {.unit = "share",
           .limits = {0.0, 1.0},
           .meaning =
               "Instead of the file's own: how much it hides of what is behind it, in pictures and models."})
      .oneOf({"file", "lines", "from"})
      .shared();
}

std::shared_ptr<const Table> worldKeys() {
  using Bounds = std::array<sim::Vec3, 2>;
  const auto bounds = TableOf<Bounds>()
                          .place("min", [](auto& b) -> auto& { return b[0]; },
                                 {.unit = kMetres,
                                  .limits = kCoordinate,
                                  .meaning = "The corner with the least x, y and z.",
                                  .required = true})
                          .place("max", [](auto& b) -> auto& { return b[1]; },
                                 {.unit = kMetres,
                                  .limits = kCoordinate,
                                  .meaning = "The corner with the greatest x, y and z.",
                                  .required = true})
                          .shared();
  return TableOf<WorldSpec>()
      .metres("voxel", &WorldSpec::voxel_m,
              {.unit = kMetres,
               .limits = {sim::kLeastVoxel_m, sim::kMostVoxel_m},
               .meaning = "Edge of a voxel; either this or a resolution."})
      .whole("resolution", &WorldSpec::resolution,
             {.unit = "voxels",
              .limits = {1.0, 4096.0},
              .meaning = "Voxels along the world's longest side; either this or a voxel size."})
      .metres("margin", &WorldSpec::margin_m,
              {.unit = kMetres,
               .limits = {0.0, 1e6},
               .meaning =
                   "Free space around the meshes on every side. Without it, and without bounds: three voxels "
                   "at the sides and above."})
      .section("bounds", &WorldSpec::bounds_m, bounds,
               {.meaning = "The world's box; without it, the meshes' box plus the margin."})
      .whole("layers", &WorldSpec::layers,
             {.unit = "layers",
              .limits = {0.0, kMostLayers},
              .meaning = "Least number of boundary layers around the scene's objects; as many more as the "
                         "rules ask for."})
      .shared();
}

std::shared_ptr<const Table> exposureKeys() {
  return TableOf<ExposureSpec>()
      .choice<ExposureWhere>("where", &ExposureSpec::where,
                             {{"surfaces", ExposureWhere::surfaces},
                              {"band", ExposureWhere::band},
                              {"everything", ExposureWhere::everything}},
                             {.meaning = "On surfaces alone, in the free space near them too, or in all of "
                                         "the world's free space."})
      .whole("band", &ExposureSpec::band_vx,
             {.unit = "voxels",
              .limits = {1.0, 64.0},
              .meaning = "How far the free space near surfaces reaches, for where: band."})
      .choice<Unreached>(
          "unreached", &ExposureSpec::unreached,
          {{"count", Unreached::count}, {"leave_out", Unreached::leave_out}},
          {.meaning = "What the tables make of surfaces from which no sky and no sun is seen, as "
                      "inside of a closed room: count their zeros, or leave them out."})
      .shared();
}

std::shared_ptr<const Table> seedKeys() {
  return TableOf<SeedSpec>()
      .place("at", &SeedSpec::at_m,
             {.unit = kMetres, .limits = kCoordinate, .meaning = "Where it stands.", .required = true})
      .text(
          "key", &SeedSpec::key,
          {.meaning = "What its random numbers hang on, in place of where it stands: with a key of its own a "
                      "plant draws the same wherever it is moved.",
           .most = 100})
      .shared();
}

std::shared_ptr<const Table> skeletonKeys() {
  TableOf<SkeletonSpec> table;
  table
      .file("file", &SkeletonSpec::file,
            {.meaning = "Its trees: the skeleton.json of a run, nodes in JSON, or the lines of an .obj."})
      .file("from", &SkeletonSpec::from,
            {.meaning = "Or another scene, which is run first: the trees are those that grow there."});
  addPlacement(table);
  return table.oneOf({"file", "from"}).shared();
}

std::shared_ptr<const Table> plantKeys() {
  const auto scatter =
      TableOf<Scatter>()
          .text("region", &Scatter::region,
                {.meaning = "Seeds stand on this region's voxels that look up.", .required = true})
          .whole("count", &Scatter::count,
                 {.unit = "seeds", .limits = {1.0, 100'000.0}, .meaning = "How many.", .required = true})
          .shared();
  return TableOf<PlantSpec>()
      .custom(
          "rules", Kind::rules,
          [](PlantSpec& p, const Datum& d) {
            const auto& reference = std::get<RuleReference>(d);
            p.rules_file = reference.file;
            p.rules = reference.rules;
          },
          [](const PlantSpec& p) {
            return p.rules ? Datum{RuleReference{p.rules_file.string(), p.rules}} : Datum{};
          },
          {.meaning = "How it grows: a rule file, one of the library by its name, or rule keys in place.",
           .required = true})
      .name("name", &PlantSpec::name,
            {.meaning = "What reports and outputs call it; without it, plant_1, plant_2 and so on."})
      .list<SeedSpec>("seeds", Kind::entries, &PlantSpec::seeds, seedKeys(),
                      {.meaning = "Where it starts, once for each."}, "at")
      .section("scatter", &PlantSpec::scatter, scatter,
               {.meaning = "Seeds strewn at random, beside those that are given."})
      .file(
          "points", [](auto& p) -> auto& { return p.table.file; },
          {.meaning = "More seeds from a table of points, .csv: x, y, z in metres on each line, and perhaps "
                      "their type."})
      .whole("type", [](auto& p) -> auto& { return p.table.type; },
             {.limits = kPointTypes, .meaning = "Those points of the table that are of this type alone."})
      .section("skeleton", &PlantSpec::skeleton, skeletonKeys(),
               {.meaning = "In place of seeds: trees that somebody else made, which the rules dress."},
               "file")
      .shared();
}

std::shared_ptr<const Table> cameraKeys() {
  return TableOf<NamedCamera>()
      .place("eye", [](auto& c) -> auto& { return c.camera.eye_m; },
             {.unit = kMetres, .limits = kCoordinate, .meaning = "Where it stands.", .required = true})
      .place("target", [](auto& c) -> auto& { return c.camera.target_m; },
             {.unit = kMetres, .limits = kCoordinate, .meaning = "What it looks at.", .required = true})
      .number("fov", [](auto& c) -> auto& { return c.camera.fov_deg; },
              {.unit = kDegrees, .limits = {1.0, 170.0}, .meaning = "Vertical field of view."})
      .shared();
}

std::shared_ptr<const Table> imageKeys() {
  std::vector<std::pair<std::string, ImageKind>> kinds;
  for (const auto kind :
       {ImageKind::sun_exposure, ImageKind::sky_exposure, ImageKind::threshold, ImageKind::shadow_matte,
        ImageKind::surface_colour, ImageKind::first_pass, ImageKind::volume, ImageKind::sun_hours,
        ImageKind::vines, ImageKind::section, ImageKind::attempts, ImageKind::points, ImageKind::graph,
        ImageKind::field, ImageKind::narrow_band, ImageKind::cut_out, ImageKind::sky_tables,
        ImageKind::voxels, ImageKind::contact_sheet}) {
    kinds.emplace_back(nameOf(kind), kind);
  }
  return TableOf<ImageSpec>()
      .choice("kind", &ImageSpec::kind, kinds, {.meaning = "What it shows.", .required = true})
      .name("name", &ImageSpec::name,
            {.meaning = "The picture's file name without an ending; without it, its kind."})
      .text("camera", &ImageSpec::camera, {.meaning = "One of the scene's cameras; without it, the first."})
      .text("plant", &ImageSpec::plant,
            {.meaning = "Of a threshold or sky_tables: whose, one of the scene's plants; without it, the "
                        "first's."})
      .text("caption", &ImageSpec::caption, {.meaning = "A line below the picture."})
      .text("letter", &ImageSpec::letter,
            {.meaning = "On a contact sheet, beside the caption; by default A, B, C .. in order."})
      .choice<char>("axis", &ImageSpec::axis, {{"x", 'x'}, {"y", 'y'}, {"z", 'z'}},
                    {.meaning = "Of a section or a narrow_band: the way in which the cut looks."})
      .metres("at", &ImageSpec::at_m,
              {.unit = kMetres,
               .limits = kCoordinate,
               .meaning = "Of a section or a narrow_band: where on that axis the cut lies."})
      .text("mesh", &ImageSpec::mesh,
            {.meaning = "Of a narrow_band or cut_out: which of the scene's meshes; without it, the first."})
      .text("field", &ImageSpec::field,
            {.meaning = "Of a field: which of the scene's fields; without it, the first."})
      .text("heights", &ImageSpec::heights,
            {.meaning = "Of vines that show heights: which of them; without it, the first."})
      .whole("iteration", &ImageSpec::iteration,
             {.unit = "iterations",
              .limits = {0.0, 100'000.0},
              .meaning = "Of points or a graph: what stands after so many iterations; without it, or where "
                         "growth ended before, at the end."})
      .names("of", &ImageSpec::of,
             {.meaning = "Of a contact_sheet: the names of the images on it, in order."})
      .names("show", &ImageSpec::show,
             {.meaning = "Of vines: what of scene, stems, elements, guides, pieces and heights is shown."})
      .number("apart", &ImageSpec::apart,
              {.unit = "share",
               .limits = {0.0, 10.0},
               .meaning = "Of vines that show pieces: each is moved away from their middle by this share of "
                          "its distance."})
      .shared();
}

Table makeTable() {
  const auto image =
      TableOf<Scene>()
          .whole("width", &Scene::image_width,
                 {.unit = "pixels", .limits = {16.0, 16'384.0}, .meaning = "Width of every image."})
          .whole("height", &Scene::image_height,
                 {.unit = "pixels", .limits = {16.0, 16'384.0}, .meaning = "Height of every image."})
          .number("bloom", &Scene::bloom,
                  {.unit = "share",
                   .limits = {0.0, 1.0},
                   .meaning = "Of vines and films: how much spreads as a glow of what is brighter than "
                              "white."})
          .shared();
  return TableOf<Scene>()
      .header(
          {.meaning = "The kind of this file and, if wanted, the version of the language: scene or scene/1."})
      .text("name", &Scene::name, {.meaning = "A name for people."})
      .list<SceneMesh>("meshes", Kind::entries, &Scene::meshes, meshKeys(),
                       {.meaning = "What the world is made of; the first to claim a voxel keeps it.",
                        .most = kMostEntries},
                       "file")
      .section("world", &Scene::world, worldKeys(),
               {.meaning = "How the meshes become voxels.", .required = true})
      .section("sky", &Scene::sky, skyKeys(), {.meaning = "How sky_exposure is found."})
      .section("sun", &Scene::sun, sunKeys(),
               {.meaning = "How sun_exposure is found: Greene's inclined arc, or with a place the real sun."})
      .section(
          "interreflection", &Scene::interreflection, interreflectionKeys(),
          {.meaning = "Light that bounces from surface to surface, in images of kinds first_pass and vines."},
          "passes")
      .section("exposure", &Scene::exposure, exposureKeys(),
               {.meaning =
                    "What espalier expose finds beside the exposure of surfaces, and what its tables count."})
      .list<AttractorsSpec>(
          "attractors", Kind::named, &Scene::attractors, attractorKeys(),
          {.meaning = "Points that plants grow towards, by names that rules use.", .most = kMostEntries})
      .list<FieldSpec>(
          "fields", Kind::named, &Scene::fields, fieldKeys(),
          {.meaning = "Guide fields that bend fronts, by names that rules use.", .most = kMostEntries})
      .list<PlantSpec>("plants", Kind::entries, &Scene::plants, plantKeys(),
                       {.meaning = "What grows.", .most = kMostEntries})
      .list<PiecesSpec>("pieces", Kind::named, &Scene::pieces, pieceKeys(),
                        {.meaning = "Meshes that are cut into pieces along what has grown, by names: each a "
                                    "NAME.glb.",
                         .most = kMostEntries})
      .list<HeightsSpec>(
          "heights", Kind::named, &Scene::heights, heightsKeys(),
          {.meaning = "Land that is made of what has grown, in plan, by names.", .most = kMostEntries})
      .whole("iterations", &Scene::iterations,
             {.unit = "iterations", .limits = {0.0, 100'000.0}, .meaning = "How long it grows."})
      .whole("seed", &Scene::seed,
             {.limits = {0.0, 9'007'199'254'740'991.0},
              .meaning = "Of every random number: another seed, another plant."})
      .section("image", std::identity{}, image, {.meaning = "The shape of the images."})
      .list<NamedCamera>("cameras", Kind::named, &Scene::cameras, cameraKeys(),
                         {.meaning = "From where images are taken; the first is the one that is meant.",
                          .most = kMostEntries})
      .list<ImageSpec>("images", Kind::entries, &Scene::images, imageKeys(),
                       {.meaning = "The images wanted.", .most = kMostEntries}, "kind")
      .section("film", &Scene::film, filmKeys(),
               {.meaning = "Growth as a film: numbered pictures, and film.mp4 where ffmpeg is installed."},
               "camera")
      .table();
}

}  // namespace

const Table& sceneTable() {
  static const Table table = makeTable();
  return table;
}

}  // namespace espalier::scenes
