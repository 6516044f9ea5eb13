#include "scenes/accuracy/certificate.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scenes/accuracy/accuracy_study.h"
#include "scenes/accuracy/compare_shape.h"
#include "scenes/accuracy/known_shapes.h"
#include "scenes/accuracy/spot_check.h"
#include "scenes/read/read_scene.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

using sim::Vec3;
using sim::Weighting;

const Vec3 kUp(0, 1, 0);

double at(const KnownShape& shape, Weighting weighting, Vec3 p) {
  return shape.truth(weighting, p, kUp);
}

// Published closed forms of radiation heat transfer.
TEST(KnownShapes, AnEndlessStreet) {
  const struct {
    double h, cosine, floor_mean, wall_mean, uniform, overcast;
  } kRows[] = {{0.25, 0.89443, 0.78078, 0.43845, 0.70483, 0.93160},
               {0.5, 0.70711, 0.61803, 0.38197, 0.50000, 0.77065},
               {1.0, 0.44721, 0.41421, 0.29289, 0.29517, 0.50585},
               {2.0, 0.24254, 0.23607, 0.19098, 0.15596, 0.27866},
               {4.0, 0.12403, 0.12311, 0.10961, 0.07917, 0.14317}};
  for (const auto& row : kRows) {
    const KnownShape shape = street(10.0, 10.0 * row.h, 0.0, 0.1);
    EXPECT_NEAR(at(shape, Weighting::cosine, Vec3(0.0)), row.cosine, 2e-4);
    EXPECT_NEAR(at(shape, Weighting::uniform, Vec3(0.0)), row.uniform, 2e-4);
    EXPECT_NEAR(at(shape, Weighting::cie_overcast, Vec3(0.0)), row.overcast, 2e-4);
    double floor = 0.0, wall = 0.0;
    constexpr int kSamples = 100;
    for (int i = 0; i < kSamples; ++i) {
      const double part = (i + 0.5) / kSamples;
      floor += at(shape, Weighting::cosine, Vec3(-5.0 + 10.0 * part, 0.0, 0.0)) / kSamples;
      wall += shape.truth(Weighting::cosine, Vec3(-5.0, 10.0 * row.h * part, 0.0), Vec3(1, 0, 0)) / kSamples;
    }
    EXPECT_NEAR(floor, row.floor_mean, 5e-4);
    EXPECT_NEAR(wall, row.wall_mean, 5e-4);
  }
}

TEST(KnownShapes, ASquareCourt) {
  const struct {
    double height, centre, corner, edge, uniform, overcast;
  } kRows[] = {{5, 0.55413, 0.20776, 0.33475, 0.33333, 0.63799},
               {10, 0.23946, 0.13853, 0.18037, 0.12819, 0.29468},
               {20, 0.07348, 0.05986, 0.06618, 0.03747, 0.09325}};
  for (const double turn : {0.0, 30.0}) {
    const double s = std::sin(turn * 3.14159265358979 / 180), c = std::cos(turn * 3.14159265358979 / 180);
    const auto turned = [&](double x, double z) { return Vec3(c * x - s * z, 0.0, s * x + c * z); };
    for (const auto& row : kRows) {
      const KnownShape shape = court(10.0, row.height, turn, 0.1);
      EXPECT_NEAR(at(shape, Weighting::cosine, Vec3(0.0)), row.centre, 2e-4);
      EXPECT_NEAR(at(shape, Weighting::cosine, turned(4.9999, 4.9999)), row.corner, 3e-3);
      EXPECT_NEAR(at(shape, Weighting::cosine, turned(4.9999, 0.0)), row.edge, 2e-3);
      EXPECT_NEAR(at(shape, Weighting::uniform, Vec3(0.0)), row.uniform, 2e-4);
      EXPECT_NEAR(at(shape, Weighting::cie_overcast, Vec3(0.0)), row.overcast, 2e-4);
    }
  }
}

TEST(KnownShapes, ARoundPit) {
  for (const double depth : {0.5, 1.0, 3.0}) {  // over the radius
    const KnownShape shape = pit(2.0, depth, 0.05);
    EXPECT_NEAR(at(shape, Weighting::cosine, Vec3(0.0)), 1.0 / (1.0 + depth * depth), 1e-6);
    EXPECT_NEAR(at(shape, Weighting::uniform, Vec3(0.0)), 1.0 - depth / std::sqrt(1.0 + depth * depth), 1e-6);
    // A small level patch and a disc that is not above it (configuration factors, Howell's B-13).
    const double x = 0.6, r2 = 1.0, h2 = depth * depth, q = x * x + h2 + r2;
    const double beside = 0.5 * (1.0 - (x * x + h2 - r2) / std::sqrt(q * q - 4.0 * r2 * x * x));
    EXPECT_NEAR(at(shape, Weighting::cosine, Vec3(0.0, 0.0, x)), beside, 1e-5);
  }
}

/// What a scene that says nothing of its sky gets, from voxels of a fortieth of the width: courts with walls
/// along the voxels and turned by 20 degrees. Without evening, or with half of the directions, the RMS is
/// beyond the bound.
TEST(Certificate, FloorsAreTrueByDefault) {
  const auto weighting = Weighting::cosine;
  const sim::Sky sky = sim::makeSky({.weighting = weighting, .standard_error = SkySpec::kMapError});
  double squares = 0.0;
  int count = 0;
  for (const double turn : {0.0, 20.0}) {
    for (const double height : {5.0, 10.0, 20.0}) {
      const auto lines = compareShape(court(10.0, height, turn, 0.25), sky, {weighting}, 0.25, 0);
      for (const auto& line : lines[0]) {
        if (line.place.find("floor") == std::string::npos) continue;
        SCOPED_TRACE(fmt::format("{} {} m high: {}", line.shape, height, line.place));
        EXPECT_LT(std::abs(line.error()), line.place == "floor" ? 0.0025 : 0.01);
        EXPECT_LT(std::abs(line.worst), 0.01);
        squares += line.rms * line.rms;
        ++count;
      }
    }
  }
  EXPECT_EQ(count, 12);
  EXPECT_LT(std::sqrt(squares / count), 0.0025);
}

/// With so many directions that what is left is the voxels' error.
TEST(Certificate, VoxelsErrLittleAndLessWhereTheyAreFiner) {
  sim::Sky sky = sim::makeSky({.directions = 1000});
  for (const Weighting weighting : {Weighting::uniform, Weighting::cie_overcast}) {
    sky.weighting = weighting;
    const Certificate coarse = certifyShapes(sky, 0.25, {8}), fine = certifyShapes(sky, 0.25, {24});
    EXPECT_LT(std::abs(coarse.bias), 0.012);
    EXPECT_LT(coarse.rms, 0.03);
    EXPECT_LT(std::abs(fine.bias), 0.003);
    EXPECT_LT(fine.rms, 0.5 * coarse.rms);
    EXPECT_EQ(fine.weighting, weighting);
    EXPECT_EQ(fine.lines.size(), 7u + 3 + 3 + 2);
    for (const auto& line : fine.lines) {
      EXPECT_LT(std::abs(line.error()), 0.025) << line.shape << ", " << line.place;
      EXPECT_LT(line.rms, 0.025) << line.shape << ", " << line.place;
    }
  }
}

Scene smallScene() {
  return *readScene(std::string(ESPALIER_SOURCE_DIR) + "/scenes/library/figure_3.yaml");
}

TEST(Certificate, OfASceneAgreesWithRaysOnItsTriangles) {
  const Scene scene = smallScene();
  const Site site = makeSite(scene);
  const Certificate certificate = certify(site, sim::lightOf(site.world, site.sky), scene.seed);
  ASSERT_TRUE(certificate.spots);
  const auto& spots = *certificate.spots;
  EXPECT_GT(spots.points, 2000u);
  EXPECT_LT(std::abs(spots.bias), 0.01);
  EXPECT_LT(spots.median, 0.01);
  EXPECT_LT(spots.percentile_95, 0.08);
  EXPECT_LE(spots.on_faces, spots.points);
  EXPECT_LE(spots.rms_on_faces, spots.rms);
  EXPECT_EQ(certificate.voxel_m, site.world.frame().voxel_m);
  EXPECT_EQ(certificate.directions, site.sky.directions.size());
  // The worst place is a place of the scene.
  EXPECT_TRUE(sim::contains(site.world.frame().size,
                            sim::voxelAt(sim::voxelFromWorld(site.world.frame(), spots.worst.at_m))));
  EXPECT_EQ(spotCheck(site, sim::lightOf(site.world, site.sky), scene.seed)->rms,
            spots.rms);  // the same points in every run
  const auto json = nlohmann::json::parse(toJson(certificate));
  EXPECT_EQ(json["weighting"], std::string(sim::nameOf(site.sky.weighting)));
  EXPECT_FALSE(json.contains("known_shapes"));
  const Certificate whole = certifyWithShapes(site, sim::lightOf(site.world, site.sky), scene.seed);
  EXPECT_EQ(whole.spots->rms, spots.rms);
  EXPECT_GT(whole.lines.size(), 10u);
  EXPECT_EQ(nlohmann::json::parse(toJson(whole))["known_shapes"]["lines"].size(), whole.lines.size());
  EXPECT_NE(toText(certificate).find(std::string(sim::nameOf(site.sky.weighting)) + " weighting"),
            std::string::npos);
}

/// A block of earth with a square court in it, 20 m wide and deep.
Scene courtOf(const tests::Scratch& scratch, double voxel_m, double accuracy) {
  std::string obj;
  const auto ring = [&](double half, double y) {
    for (const auto& [x, z] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
      obj += fmt::format("v {} {} {}\n", x * half, y, z * half);
  };
  ring(13.0, -1.0);
  ring(13.0, 20.0);
  ring(10.0, 20.0);
  ring(10.0, 0.0);
  for (int low = 1; low <= 9; low += 4) {
    for (int k = 0; k < 4; ++k)
      obj += fmt::format("f {} {} {} {}\n", low + k, low + 4 + k, low + 4 + (k + 1) % 4, low + (k + 1) % 4);
  }
  obj += "f 1 2 3 4\nf 13 16 15 14\n";
  Scene scene;
  scene.name = scene.file = "court";
  SceneMesh mesh;
  mesh.name = "court";
  mesh.file = scratch.write("court.obj", obj);
  scene.meshes.push_back(mesh);
  scene.world.voxel_m = voxel_m;
  scene.sky.weighting = sim::Weighting::cosine;
  scene.sky.accuracy = accuracy;
  return scene;
}

/// Coarse voxels err more than the directions; beyond some fineness it is the directions that err.
TEST(Certificate, SaysWhatWouldHelp) {
  const tests::Scratch scratch;
  const auto of = [&](double voxel_m, double accuracy) {
    const Scene scene = courtOf(scratch, voxel_m, accuracy);
    const Site site = makeSiteForLight(scene);
    return certify(site, sim::lightOf(site.world, site.sky), scene.seed);
  };
  const Certificate coarse = of(1.0, 0.005), fine = of(0.125, 0.01), exact = of(0.25, 0.002);
  EXPECT_NE(inShort(coarse).find("smaller voxels would help most"), std::string::npos) << inShort(coarse);
  EXPECT_NE(inShort(fine).find("a finer sky.accuracy would help most"), std::string::npos) << inShort(fine);
  EXPECT_LT(fine.spots->rms_on_faces, 0.5 * coarse.spots->rms_on_faces);
  EXPECT_LT(exact.spots->size_of_directions, 0.7 * fine.spots->size_of_directions);
}

/// Between these lines docs/accuracy.md holds what the program says. ESPALIER_UPDATE_DOCS=1 writes it anew.
const char* const kShapesBegin = "<!-- espalier certify -->\n";
const char* const kMeshesBegin = "<!-- its own meshes -->\n";
const char* const kSharedBegin = "<!-- meshes of others -->\n";
const char* const kEnd = "<!-- end -->";

void put(std::string& page, const std::string& begin, const std::string& text) {
  const std::size_t from = page.find(begin) + begin.size();
  page.replace(from, page.find(kEnd, from) - from, text);
}

std::vector<std::filesystem::path> sharedMeshes() {
  std::vector<std::filesystem::path> meshes;
  for (const char* name : {"house_3.obj", "ruin_wall.glb", "bunny.obj"}) {
    const auto file = std::filesystem::path(ESPALIER_SHARED_MESHES) / name;
    if (std::filesystem::exists(file)) meshes.push_back(file);
  }
  return meshes;
}

TEST(AccuracyPage, SaysWhatTheProgramSays) {
  const auto path = tests::sourceFolder() / "docs/accuracy.md";
  if (std::getenv("ESPALIER_UPDATE_DOCS")) {
    std::string page = tests::fileText(path);
    put(page, kShapesBegin, accuracyStudy());
    put(page, kMeshesBegin,
        accuracyOnMeshes({tests::sourceFolder() / "scenes/meshes/garden_wall.obj",
                          tests::sourceFolder() / "scenes/meshes/column.obj"}));
    if (sharedMeshes().size() == 3) put(page, kSharedBegin, accuracyOnMeshes(sharedMeshes()));
    std::ofstream(path, std::ios::binary) << page;
  }
  // The whole study takes its time; these sections stand for the others.
  const std::string page = tests::fileText(path);
  for (const char* section : {"Open planes", "Raster tools"}) {
    EXPECT_NE(page.find(accuracyStudy(section)), std::string::npos)
        << section << ": run this test once with ESPALIER_UPDATE_DOCS=1 and commit the page";
  }
}

TEST(AccuracyPage, SaysWhatTheProgramSaysOfOthersMeshes) {
  if (sharedMeshes().size() < 3) GTEST_SKIP() << "no meshes in " << ESPALIER_SHARED_MESHES;
  const std::string rows = accuracyOnMeshes({sharedMeshes()[1]});
  const std::string row = rows.substr(rows.rfind("| ruin_wall"));
  EXPECT_NE(tests::fileText(tests::sourceFolder() / "docs/accuracy.md").find(row), std::string::npos) << row;
}

}  // namespace
}  // namespace espalier::scenes
