#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/image/image_io.h"
#include "scenes/prepare/attractors.h"
#include "scenes/prepare/plantings.h"
#include "scenes/problem.h"
#include "scenes/read/read_scene.h"
#include "scenes/show/cut_out_picture.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/grow/grow.h"
#include "sim/grow/state.h"
#include "sim/sense/scene_surface.h"
#include "tests/support/scratch.h"

/// Veins of leaves by the library's rule sets, open and closed (Runions et al. 2005): in two outlines, by
/// other seeds and in other voxels.
namespace espalier::scenes {
namespace {

using sim::Vec3;

struct Leaf {
  std::string outline = "blade_ovate";
  std::string rules = "closed_venation";
  int seed = 1;
  double voxel_mm = 1.0;
  std::string spacing = "4 mm";
  std::string attractors = "";  ///< instead of those on the blade
  std::string more = ", colonization: {step: 1 mm, influence: 8 mm, kill: 1.2 mm}";  ///< of its rules
};

std::string sceneOf(const Leaf& leaf) {
  const std::string folder = (tests::sourceFolder() / "scenes/meshes").string();
  return fmt::format(
      "espalier: scene\nseed: {}\niterations: 900\n"
      "meshes: [{{file: {}/{}.obj, unit: cm, name: blade, guide: true}}]\n"
      "world: {{voxel: {} mm, margin: 3 mm}}\n"
      "attractors: {{blade: {}}}\n"
      "plants: [{{rules: {{base: {}{}}}, seeds: [[0, 0.0005, 0]]}}]\n"
      "images: [{{kind: cut_out, name: leaf}}]\n",
      leaf.seed, folder, leaf.outline, leaf.voxel_mm,
      leaf.attractors.empty() ? fmt::format("{{surface: blade, spacing: {}, waves: 3}}", leaf.spacing)
                              : leaf.attractors,
      leaf.rules, leaf.more);
}

struct Grown {
  Scene scene;
  Site site;
  std::vector<sim::Planting> plantings;
  sim::Growth growth;

  const sim::Skeleton& skeleton() const { return growth.plants.at(0).skeleton; }
  const std::vector<float>* joins() const { return sim::find(skeleton(), sim::kJoinsColumn); }
  std::size_t loops() const {
    return joins() == nullptr ? 0
                              : static_cast<std::size_t>(std::count_if(joins()->begin(), joins()->end(),
                                                                       [](float n) { return n > 0.0f; }));
  }
};

sim::GrowthSettings settingsOf(const Scene& scene, const Site& site) {
  return growthSettings(scene, site, attractorsOf(scene, site));
}

Grown grown(const Leaf& leaf, int iterations = 900) {
  const tests::Scratch scratch;
  auto read = readScene(scratch.write("leaf.yaml", sceneOf(leaf)));
  if (!read) throw std::runtime_error(format(read.problems()));
  Scene scene = *read;
  scene.iterations = iterations;
  Site site = makeSite(scene);
  auto plantings = makePlantings(scene, site);
  sim::Growth growth = sim::grow(site.world, plantings, settingsOf(scene, site));
  return {std::move(scene), std::move(site), std::move(plantings), std::move(growth)};
}

/// How far the farthest node is from the blade, voxel widths.
double farthestOff(const Grown& leaf) {
  const sim::Mesh& mesh = leaf.site.meshes.at(0).mesh;
  const auto vx = [&](std::uint32_t v) {
    return sim::voxelFromWorld(leaf.site.world.frame(), mesh.vertices_m[v]);
  };
  double farthest = 0.0;
  for (const Vec3 at : leaf.skeleton().position_vx) {
    double nearest = HUGE_VAL;
    for (const auto& [a, b, c] : mesh.triangles)
      nearest = std::min(nearest, glm::distance(at, sim::nearestOn({vx(a), vx(b), vx(c)}, at)));
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

void expectVeins(const Leaf& leaf, bool closed) {
  SCOPED_TRACE(sceneOf(leaf));
  const Grown veins = grown(leaf);
  EXPECT_GT(veins.skeleton().size(), 300);
  EXPECT_LE(farthestOff(veins), 0.5);
  if (closed) {
    EXPECT_GT(veins.loops(), 10u);
    for (std::size_t n = 0; n < veins.joins()->size(); ++n) {
      const float joins = (*veins.joins())[n];
      if (joins <= 0.0f) continue;
      const auto other = static_cast<std::size_t>(joins);
      ASSERT_LT(other, n);
      EXPECT_EQ(veins.skeleton().position_vx[n], veins.skeleton().position_vx[other]);
      EXPECT_NE(veins.skeleton().parent[n], static_cast<sim::NodeId>(other));
    }
  } else {
    EXPECT_EQ(veins.joins(), nullptr) << "an open pattern is a tree, and its plant as any other";
  }
}

TEST(Venation, OpenVeinsAreATreeAndClosedOnesHaveLoops) {
  for (const bool closed : {false, true}) {
    const std::string rules = closed ? "closed_venation" : "venation";
    for (const int seed : {1, 2, 3}) expectVeins({.rules = rules, .seed = seed}, closed);
    expectVeins({.outline = "blade_lobed", .rules = rules}, closed);
    expectVeins({.rules = rules, .voxel_mm = 1.0 / 0.7}, closed);
  }
}

TEST(Venation, NoVeinLeavesTheBladeOverTheGapBetweenTwoLobes) {
  const Grown kept = grown({.outline = "blade_lobed"});
  Leaf free{.outline = "blade_lobed"};
  free.more += ", require: {along: {sheet: {max: 1}}}";  // the control: as far off as it likes
  EXPECT_LE(farthestOff(kept), 0.5);
  EXPECT_GT(farthestOff(grown(free)), 1.0);
}

TEST(Venation, IsTheSameOnAnyNumberOfThreads) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 5}) {
    const sim::Shaken shaken;
    sim::onThreads(threads, [&] {
      const Grown leaf = grown({});
      hashes.push_back(sim::stateHash(leaf.site.world, leaf.growth));
    });
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
  const Grown other = grown({.seed = 2});
  EXPECT_NE(hashes[0], sim::stateHash(other.site.world, other.growth));
}

TEST(Venation, GoesOnFromASavedState) {
  const Grown whole = grown({});
  for (const int before : {30, 80}) {
    const Grown half = grown({}, before);
    ASSERT_LT(half.growth.iterations, whole.growth.iterations) << "or nothing is left to grow";
    const sim::BitVolume bare = makeSite(half.scene).world.occupied();
    const std::string bytes = sim::stateBytes({}, half.site.world, bare, half.growth);
    Site site = makeSite(whole.scene);
    const auto plantings = makePlantings(whole.scene, site);
    sim::Growth growth = sim::restore(sim::readState(bytes, "f"), site.world, plantings, "f");
    sim::Growing growing(site.world, plantings, settingsOf(whole.scene, site), std::move(growth));
    while (growing.step()) {
    }
    EXPECT_EQ(sim::stateHash(site.world, growing.growth()), sim::stateHash(whole.site.world, whole.growth));
  }
}

/// The share of its bounds that a mesh covers, seen along z.
double shareOf(const sim::Mesh& mesh) {
  Vec3 low(HUGE_VAL), high(-HUGE_VAL);
  double area = 0.0;
  for (const Vec3 at : mesh.vertices_m) {
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 at = mesh.vertices_m[a];
    area += 0.5 * std::abs(glm::cross(mesh.vertices_m[b] - at, mesh.vertices_m[c] - at).z);
  }
  return area / ((high.x - low.x) * (high.y - low.y));
}

TEST(Venation, IsCutOutAsAPictureThatElementsTakeAsItIs) {
  const tests::Scratch scratch;
  const Grown leaf = grown({});
  const sim::BitVolume bare = leaf.site.world.occupied();
  const sim::Lighting light = {};
  const std::vector<render::PlantModel> models;
  const Finished finished{leaf.site.meshes, leaf.site.world, bare, leaf.growth, light, models};
  ImageSpec image;
  image.name = "leaf";
  image.kind = ImageKind::cut_out;
  const render::Image picture = drawCutOut(finished, image, {300, 200});
  EXPECT_EQ(picture.height, 200);
  const double outline = shareOf(leaf.site.meshes.at(0).mesh);
  scratch.write("leaf.png", render::encodePng(picture));
  const auto read = readScene(scratch.write(
      "tree.yaml",
      "espalier: scene\nworld: {voxel: 4 cm, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}\n"
      "plants: [{rules: {elements: [{texture: leaf.png, size: 9 cm}]}, seeds: [[0.5, 0.5, 0.5]]}]\n"));
  ASSERT_TRUE(read) << format(read.problems());
  const rules::Element& element = read->plants.at(0).rules->elements.at(0);
  EXPECT_NEAR(element.opacity, outline, 0.02);
  EXPECT_GT(outline, 0.4);
  EXPECT_LT(outline, 0.8);
  // With the veins in it: without them all of it has one colour.
  const Grown young = grown({}, 0);
  const Finished unveined{young.site.meshes, young.site.world, bare, young.growth, light, models};
  const render::Image plain = drawCutOut(unveined, image, {300, 200});
  const auto middle = [](const render::Image& of) { return of.at(of.width / 2, of.height / 2); };
  EXPECT_GT(middle(picture)[0], middle(plain)[0] + 0.1f) << "the great vein";
  image.mesh = "none";
  EXPECT_THROW(drawCutOut(finished, image, {300, 200}), sim::InputError);
}

TEST(Venation, SaysWhatIsWrong) {
  const tests::Scratch scratch;
  const auto problemsOf = [&](const Leaf& leaf) -> std::string {
    auto read = readScene(scratch.write("leaf.yaml", sceneOf(leaf)));
    if (!read) return format(read.problems());
    try {
      Site site = makeSite(*read);
      const auto plantings = makePlantings(*read, site);
      attractorsOf(*read, site);
      requireCutOutsSeen(*read, site.meshes);
    } catch (const sim::InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(problemsOf({}), "");
  EXPECT_NE(problemsOf({.more = ", colonization: {kill: 12 cm}"}).find("kill"), std::string::npos);
  EXPECT_NE(problemsOf({.attractors = "{surface: blad, spacing: 4 mm}"}).find("blade"), std::string::npos);
  EXPECT_NE(problemsOf({.attractors = "{sphere: 3 cm, at: [0, 0.05, 0], count: 9, waves: 2}"})
                .find("waves means nothing"),
            std::string::npos);
  // Of a body no side is the one.
  const std::string body = problemsOf({.outline = "sphere"});
  EXPECT_NE(body.find("leaf.yaml:"), std::string::npos) << body;
  EXPECT_NE(body.find("expected an open sheet"), std::string::npos) << body;
}

}  // namespace
}  // namespace espalier::scenes
