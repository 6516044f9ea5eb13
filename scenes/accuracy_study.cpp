#include "scenes/accuracy_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/compare_shape.h"
#include "scenes/spot_check.h"
#include "sim/sense/surface.h"
#include "sim/sun.h"
#include "sim/sweep.h"

namespace espalier::scenes {
namespace {

using sim::Vec3;
using sim::Weighting;

constexpr std::array kWeightings{Weighting::uniform, Weighting::cosine, Weighting::cie_overcast};
constexpr int kManyDirections = 1024;  // so that what is left is the voxels' error
constexpr int kPlaces = 4;             // between the borders of voxels

sim::Sky skyOf(Weighting weighting, int directions) {
  return sim::makeSky({.weighting = weighting, .directions = directions});
}

/// Mean truth, mean error and root of the mean square of the single voxels' errors, over several places.
struct Mean {
  double truth = 0.0, bias = 0.0, rms = 0.0;
};

/// A shape's errors at one of its places (all of it if the name is kAll), for each weighting.
std::array<Mean, 3> meansOf(const KnownShape& shape, const std::string& place, const sim::Sky& sky,
                            double voxel_m) {
  std::array<Mean, 3> means;
  for (int p = 1; p <= kPlaces; ++p) {
    const sim::World world = worldOf(shape, voxel_m, p);
    const auto maps =
        mapsOf(world, byPlace(shape, world)[place], sky, {kWeightings.begin(), kWeightings.end()});
    for (std::size_t w = 0; w < kWeightings.size(); ++w) {
      const Certificate::Line line = errorsOf(shape, world, kWeightings[w], place, maps[w]);
      means[w].truth += line.truth / kPlaces;
      means[w].bias += line.error() / kPlaces;
      means[w].rms += line.rms * line.rms / kPlaces;
    }
  }
  for (Mean& mean : means) mean.rms = std::sqrt(mean.rms);
  return means;
}

std::string cells(const std::array<Mean, 3>& means) {
  std::string text;
  for (const Mean& m : means) text += fmt::format(" {:.4f} | {:+.4f} | {:.4f} |", m.truth, m.bias, m.rms);
  return text + "\n";
}

constexpr const char* kHead =
    " uniform: truth | error | RMS | cosine: truth | error | RMS | CIE overcast: truth | error | RMS |\n";
constexpr const char* kRule = "---|---|---|---|---|---|---|---|---|\n";

/// Streets, courts and pits by their proportions, 32 voxels wide.
std::string byProportion(const sim::Sky& sky) {
  constexpr double kWidth = 32.0;
  std::string text = fmt::format("| shape | place |{}|---|---|{}", kHead, kRule);
  const auto row = [&](const KnownShape& shape, const char* place) {
    text += fmt::format("| {} | {} |{}", shape.name, place, cells(meansOf(shape, place, sky, 1.0)));
  };
  for (const double h : {0.25, 0.5, 1.0, 2.0}) {
    const KnownShape shape = street(kWidth, h * kWidth, 0.0, 1.0);
    for (const char* place : {kMiddleOfTheFloor, kFloor, kWalls}) row(shape, place);
  }
  for (const double h : {0.5, 1.0, 2.0}) {
    const KnownShape shape = court(kWidth, h * kWidth, 30.0, 1.0);
    for (const char* place : {kMiddleOfTheFloor, kFloor, kWalls}) row(shape, place);
  }
  for (const double h : {0.25, 0.5, 1.0}) row(pit(kWidth, h * kWidth, 1.0), kMiddleOfTheFloor);
  return text;
}

/// The same shapes, as high as wide, by their width in voxels.
std::string byVoxel(const sim::Sky& sky) {
  std::string text = fmt::format("| shape | voxels across |{}|---|---|{}", kHead, kRule);
  const auto rows = [&](const std::function<KnownShape(double)>& shape, const char* place, int most) {
    for (int width = 8; width <= most; width *= 2) {
      text += fmt::format("| {}, {} | {} |{}", shape(8.0).name, place, width,
                          cells(meansOf(shape(width), place, sky, 1.0)));
    }
  };
  const auto straight = [](double w) { return street(w, w, 0.0, 1.0); };
  const auto turned = [](double w) { return court(w, w, 30.0, 1.0); };
  rows(straight, kFloor, 32);
  rows(straight, kWalls, 32);
  rows(turned, kFloor, 64);
  rows(turned, kWalls, 64);
  rows([](double w) { return pit(w, w / 2.0, 1.0); }, kMiddleOfTheFloor, 64);
  rows([](double w) { return canopy(w, w / 4.0, 1.0); }, kFloor, 64);
  return text;
}

/// Open planes: the answer is exact where no stairs hide the horizon.
std::string planes(const sim::Sky& sky) {
  std::string text = fmt::format("| tilt |{}|---|{}", kHead, kRule);
  for (const double tilt : {0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0})
    text += fmt::format("| {:g} degrees |{}", tilt, cells(meansOf(slope(tilt, 25.0, 32.0), kAll, sky, 1.0)));
  return text;
}

/// The level of raster tools: street and court of 20 m, walls and cells in step.
std::string againstRasters() {
  constexpr double kMetres = 20.0;
  struct Row {
    const char* name;
    KnownShape shape;
    double cell_m;
    const char* raster;
  };
  std::string text =
      "| shape | cell | raster, 64 directions (SAGA 8.5) | plain voxels, 64 | Espalier, 64 | Espalier, 256 "
      "|\n"
      "|---|---|---|---|---|---|\n";
  const auto row = [&](const char* name, const KnownShape& shape, double cell_m, const char* raster) {
    const sim::World world = worldOf(shape, cell_m, 0);
    const auto voxels = byPlace(shape, world)[kMiddleOfTheFloor];
    const sim::Sky few = skyOf(Weighting::cosine, 64), many = skyOf(Weighting::cosine, 256);
    const auto error = [&](const SurfaceMap& map) {
      return errorsOf(shape, world, Weighting::cosine, kMiddleOfTheFloor, map).error();
    };
    text += fmt::format("| {} | {:g} m | {} | {:+.4f} | {:+.4f} | {:+.4f} |\n", name, cell_m, raster,
                        error(plainMap(world, voxels, few)),
                        error(mapsOf(world, voxels, few, {Weighting::cosine})[0]),
                        error(mapsOf(world, voxels, many, {Weighting::cosine})[0]));
  };
  for (const double cell : {1.0, 0.5, 0.25})
    row("street", street(kMetres, kMetres, 0.0, cell), cell, cell == 1.0 ? "+0.0099" : "-");
  const std::array rasters{"+0.0125", "+0.0087", "+0.0039"};
  const std::array sizes{1.0, 0.5, 0.25};
  for (std::size_t i = 0; i < sizes.size(); ++i)
    row("court", court(kMetres, kMetres, 0.0, sizes[i]), sizes[i], rasters[i]);
  return text;
}

struct Hours {
  std::vector<sim::TiledVoxel> surfaces;
  std::vector<float> values;
};

Hours hoursOf(const sim::World& world, std::vector<sim::TiledVoxel> voxels, const sim::Sun& sun) {
  const sim::SurfaceSensors sensors = sim::surfaceSensors(world, std::move(voxels));
  const auto open = sim::sweepOpen(world.opaque(), sun.directions, sensors.places);
  return {sensors.surfaces, sim::surfaceSunHours(sensors, open, sun)};
}

constexpr double kSunStep = 4.0;  // minutes
constexpr int kSunVoxels = 32;

/// Hours of sun in the middle of a street from north to south, at an equinox.
std::string alongTheMeridian() {
  constexpr double kLatitude = 45.0;
  const sim::Sun sun = sim::sunOfDeclination(kLatitude, 0.0, kSunStep);
  std::string text = "| height / width | truth | map |\n|---|---|---|\n";
  for (const double h : {0.5, 1.0, 2.0}) {
    double mean = 0.0;
    for (int p = 1; p <= kPlaces; ++p) {
      const KnownShape shape = street(kSunVoxels, h * kSunVoxels, 0.0, 1.0);
      const sim::World world = worldOf(shape, 1.0, p);
      const Hours hours = hoursOf(world, byPlace(shape, world)[kMiddleOfTheFloor], sun);
      double sum = 0.0;
      for (const float v : hours.values) sum += static_cast<double>(v);
      mean += sum / static_cast<double>(hours.values.size()) / kPlaces;
    }
    constexpr double kDegree = std::numbers::pi / 180.0;
    const double truth = 2.0 / 15.0 * std::atan(std::cos(kLatitude * kDegree) / (2.0 * h)) / kDegree;
    text += fmt::format("| {:g} | {:.3f} h | {:.3f} h |\n", h, truth, mean);
  }
  return text;
}

/// Where the shadow of a street's south wall ends at an equinox: at the same place all day.
std::string acrossTheMeridian() {
  std::string text =
      "| latitude | truth: the shadow ends at | map | hours nearer to the wall | hours farther off |\n"
      "|---|---|---|---|---|\n";
  for (const double latitude : {30.0, 45.0, 60.0}) {
    const sim::Sun sun = sim::sunOfDeclination(latitude, 0.0, kSunStep);
    const double height = kSunVoxels / 2.5, half = kSunVoxels / 2.0;
    double edge = 0.0, nearer = 0.0, farther = 0.0;
    for (int p = 1; p <= kPlaces; ++p) {
      const KnownShape shape = street(kSunVoxels, height, 90.0, 1.0);
      const sim::World world = worldOf(shape, 1.0, p);
      auto places = byPlace(shape, world);
      auto voxels = places[kFloor];
      voxels.insert(voxels.end(), places[kMiddleOfTheFloor].begin(), places[kMiddleOfTheFloor].end());
      const Hours hours = hoursOf(world, voxels, sun);
      // Along one row from the south wall (at +z) to the north.
      std::vector<std::pair<double, double>> row;
      for (std::size_t i = 0; i < hours.values.size(); ++i) {
        const Vec3 at = sim::worldFromVoxel(world.frame(), Vec3(hours.surfaces[i].voxel));
        if (hours.surfaces[i].voxel.x == hours.surfaces[0].voxel.x)
          row.emplace_back(half - at.z, static_cast<double>(hours.values[i]));
      }
      std::sort(row.begin(), row.end());
      nearer += row.front().second / kPlaces;
      farther += row.back().second / kPlaces;
      for (std::size_t i = 1; i < row.size(); ++i) {
        const auto& [d0, h0] = row[i - 1];
        const auto& [d1, h1] = row[i];
        if (h0 < 6.0 && h1 >= 6.0) {
          edge += (d0 + (6.0 - h0) / (h1 - h0) * (d1 - d0)) / kPlaces;
          break;
        }
      }
    }
    const double truth = std::tan(latitude * std::numbers::pi / 180.0);
    text += fmt::format("| {:g} degrees | {:.4f} H | {:.4f} H | {:.2f} h | {:.2f} h |\n", latitude, truth,
                        edge / height, nearer, farther);
  }
  return text;
}

}  // namespace

std::string accuracyStudy() {
  const sim::Sky sky = skyOf(Weighting::uniform, kManyDirections);
  std::string text;
  const auto section = [&](const char* title, const std::string& about, const std::string& table) {
    text += fmt::format("### {}\n\n{}\n\n{}\n", title, about, table);
  };
  section("Proportions",
          fmt::format("32 voxels wide, {} directions, mean of {} places between the borders of voxels.",
                      sky.directions.size(), kPlaces),
          byProportion(sky));
  section("Voxel size",
          fmt::format("As above, {} directions. The roof leaves its sides open.", sky.directions.size()),
          byVoxel(sky));
  section("Open planes", fmt::format("Turned by 25 degrees, {} directions.", sky.directions.size()),
          planes(sky));
  section(
      "Raster tools",
      "Errors in the middle of the floor, walls as high as the floor is wide (20 m), cosine weighting; walls "
      "stand on the borders of cells.",
      againstRasters());
  section("Hours of sun in a street from north to south",
          fmt::format("In the middle of the floor, latitude 45 degrees, declination 0, {} voxels wide.",
                      kSunVoxels),
          alongTheMeridian());
  section("Hours of sun in a street from east to west",
          fmt::format(
              "The shadow of the south wall of height H at declination 0, {} voxels wide, H = {:g} voxels.",
              kSunVoxels, kSunVoxels / 2.5),
          acrossTheMeridian());
  return text;
}

std::string accuracyOnMeshes(const std::vector<std::filesystem::path>& meshes) {
  std::string text =
      "| mesh | voxel | voxels along its longest side | points | bias | RMS | median | 95th percentile |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const auto& file : meshes) {
    for (const int resolution : {64, 128, 256}) {
      Scene scene;
      scene.name = scene.file = file.stem();
      SceneMesh mesh;
      mesh.name = file.stem();
      mesh.file = file;
      mesh.solid = true;
      scene.meshes.push_back(mesh);
      scene.world.resolution = resolution;
      scene.world.layers = 0;
      scene.sky.directions = 512;
      const Job job = prepareJob(scene);
      const auto check = spotCheck(job);
      if (!check) continue;
      text += fmt::format("| {} | {:.3g} m | {} | {} | {:+.4f} | {:.4f} | {:.4f} | {:.4f} |\n",
                          file.filename().string(), job.world.frame().voxel_m, resolution, check->points,
                          check->bias, check->rms, check->median, check->percentile_95);
    }
  }
  return text;
}

}  // namespace espalier::scenes
