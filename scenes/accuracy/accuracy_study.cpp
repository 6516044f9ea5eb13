#include "scenes/accuracy/accuracy_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "scenes/accuracy/compare_shape.h"
#include "scenes/accuracy/spot_check.h"
#include "sim/light/sun.h"
#include "sim/light/surface.h"
#include "sim/sweep/sweep.h"

namespace espalier::scenes {
namespace {

using sim::Vec3;
using sim::Weighting;

constexpr std::array kWeightings{Weighting::uniform, Weighting::cosine, Weighting::cie_overcast};
constexpr int kManyDirections = 1024;  // so that what is left is the voxels' error
constexpr int kPlaces = 3;             // between the borders of voxels

sim::Sky skyOf(Weighting weighting, int directions) {
  return sim::makeSky({.weighting = weighting, .directions = directions});
}

/// Mean truth, mean error and mean square of the single voxels' errors.
struct Mean {
  double truth = 0.0, bias = 0.0, squares = 0.0;
};
using Means = std::array<Mean, kWeightings.size()>;

/// A shape's errors at each of its places, for each weighting.
std::map<std::string, Means> meansOf(const KnownShape& shape, const sim::Sky& sky) {
  std::map<std::string, Means> means;
  for (int p = 1; p <= kPlaces; ++p) {
    const auto lines = compareShape(shape, sky, {kWeightings.begin(), kWeightings.end()}, 1.0, p);
    for (std::size_t w = 0; w < kWeightings.size(); ++w) {
      for (const Certificate::Line& line : lines[w]) {
        Mean& mean = means[line.place][w];
        mean.truth += line.truth / kPlaces;
        mean.bias += line.error() / kPlaces;
        mean.squares += line.rms * line.rms / kPlaces;
      }
    }
  }
  return means;
}

std::string tableBy(const char* column) {
  return fmt::format(
      "| shape | place | {} | uniform: truth | error | RMS | cosine: truth | error | RMS | CIE overcast: "
      "truth | "
      "error | RMS |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      column);
}

void addRows(std::string& text, const KnownShape& shape, const std::string& column, const sim::Sky& sky) {
  for (const auto& [place, means] : meansOf(shape, sky)) {
    text += fmt::format("| {} | {} | {} |", shape.name, place, column);
    for (const Mean& m : means)
      text += fmt::format(" {:.4f} | {:+.4f} | {:.4f} |", m.truth, m.bias, std::sqrt(m.squares));
    text += "\n";
  }
}

/// Streets, courts and pits by their proportions.
std::string byProportion(const sim::Sky& sky, double width) {
  std::string text = tableBy("height / width");
  for (const double h : {0.25, 0.5, 1.0, 2.0})
    addRows(text, street(width, h * width, 0.0, 1.0), fmt::format("{:g}", h), sky);
  for (const double h : {0.5, 1.0, 2.0})
    addRows(text, court(width, h * width, 30.0, 1.0), fmt::format("{:g}", h), sky);
  for (const double h : {0.25, 0.5, 1.0})
    addRows(text, pit(width, h * width, 1.0), fmt::format("{:g}", h), sky);
  return text;
}

/// The same shapes by their width in voxels.
std::string byVoxel(const sim::Sky& sky) {
  std::string text = tableBy("voxels across");
  const auto rows = [&](const std::function<KnownShape(double)>& shape, int first, int last) {
    for (int width = first; width <= last; width *= 2)
      addRows(text, shape(width), std::to_string(width), sky);
  };
  rows([](double w) { return street(w, w, 0.0, 1.0); }, 8, 32);
  rows([](double w) { return court(w, w, 30.0, 1.0); }, 8, 64);
  rows([](double w) { return pit(w, w / 2.0, 1.0); }, 8, 64);
  rows([](double w) { return canopy(w, w / 4.0, 1.0); }, 16, 64);
  return text;
}

std::string planes(const sim::Sky& sky) {
  std::string text = tableBy("tilt");
  for (const double tilt : {0.0, 10.0, 20.0, 30.0, 45.0, 60.0, 75.0, 90.0})
    addRows(text, slope(tilt, 25.0, 32.0), fmt::format("{:g} degrees", tilt), sky);
  return text;
}

/// The level of raster tools: street and court of 20 m, walls and cells in step.
std::string againstRasters() {
  constexpr double kMetres = 20.0;
  std::string text =
      "| shape | cell | raster (SAGA 8.5) | plain voxels, 1024 directions | Espalier, 256 directions | "
      "Espalier, "
      "1024 |\n|---|---|---|---|---|---|\n";
  const auto row = [&](const KnownShape& shape, double cell_m, const char* raster) {
    const sim::World world = worldOf(shape, cell_m, 0);
    const auto voxels = byPlace(shape, world)[kMiddleOfTheFloor];
    const auto error = [&](const SurfaceMap& map) {
      return errorsOf(shape, world, Weighting::cosine, kMiddleOfTheFloor, map).error();
    };
    text += fmt::format("| {} | {:g} m | {} | {:+.4f} |", shape.name, cell_m, raster,
                        error(plainMap(world, voxels, skyOf(Weighting::cosine, 1024))));
    for (const int directions : {256, 1024}) {
      const sim::Sky sky = skyOf(Weighting::cosine, directions);
      text += fmt::format(" {:+.4f} |", error(mapsOf(world, voxels, sky, {Weighting::cosine})[0]));
    }
    text += "\n";
  };
  row(street(kMetres, kMetres, 0.0, 1.0), 1.0, "+0.0099");
  row(court(kMetres, kMetres, 0.0, 1.0), 1.0, "+0.0125");
  row(court(kMetres, kMetres, 0.0, 0.5), 0.5, "+0.0087");
  row(court(kMetres, kMetres, 0.0, 0.25), 0.25, "+0.0039");
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

std::string accuracyStudy(std::string_view only) {
  const sim::Sky sky = skyOf(Weighting::uniform, kManyDirections);
  constexpr int kWidth = 16;
  const std::string directions = fmt::format("{} directions, mean of {} places between the borders of voxels",
                                             sky.directions.size(), kPlaces);
  std::string text;
  const auto section = [&](std::string_view title, const std::string& about,
                           const std::function<std::string()>& table) {
    if (only.empty() || only == title) text += fmt::format("### {}\n\n{}\n\n{}\n", title, about, table());
  };
  section("Proportions", fmt::format("{} voxels wide; {}.", kWidth, directions),
          [&] { return byProportion(sky, kWidth); });
  section(
      "Voxel size",
      fmt::format("As high as wide; pits as deep as their radius, roofs a quarter as high; {}.", directions),
      [&] { return byVoxel(sky); });
  section("Open planes", fmt::format("Turned by 25 degrees; {}.", directions), [&] { return planes(sky); });
  section(
      "Raster tools",
      "Errors in the middle of the floor, walls as high as the floor is wide (20 m), cosine weighting. Walls "
      "stand on the borders of cells.",
      againstRasters);
  section("Sun in a street from north to south",
          fmt::format("Hours in the middle of the floor, latitude 45 degrees, declination 0; {} voxels wide.",
                      kSunVoxels),
          alongTheMeridian);
  section("Sun in a street from east to west",
          fmt::format(
              "The shadow of the south wall of height H at declination 0; {} voxels wide, H = {:g} voxels.",
              kSunVoxels, kSunVoxels / 2.5),
          acrossTheMeridian);
  return text;
}

std::string accuracyOnMeshes(const std::vector<std::filesystem::path>& meshes) {
  std::string text =
      "| mesh | voxel | voxels along its longest side | points | bias | RMS | median | 95th percentile | on "
      "faces | RMS there |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n";
  for (const auto& file : meshes) {
    for (const int resolution : {64, 128, 256}) {
      Scene scene;
      scene.name = scene.file = file.stem();
      SceneMesh mesh;
      mesh.name = file.stem();
      mesh.file = file;
      scene.meshes.push_back(mesh);
      scene.world.resolution = resolution;
      scene.sky.directions = 512;
      const Site site = makeSiteForLight(scene);
      const auto check =
          spotCheck(site, sim::lightOf(site.world, site.sky, {}, {.faces = false}), scene.seed);
      if (!check) continue;
      text += fmt::format("| {} | {:.3g} m | {} | {} | {:+.4f} | {:.4f} | {:.4f} | {:.4f} | {} | {:.4f} |\n",
                          file.filename().string(), site.world.frame().voxel_m, resolution, check->points,
                          check->bias, check->rms, check->median, check->percentile_95, check->on_faces,
                          check->rms_on_faces);
    }
  }
  return text;
}

}  // namespace espalier::scenes
