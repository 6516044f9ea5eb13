#include "scenes/job/starter_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "scenes/inspect/mesh_shape.h"
#include "scenes/job/seed_failure.h"
#include "scenes/prepare/plantings.h"
#include "scenes/prepare/site.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

constexpr int kMargin_vx = 10, kSeeds = 3, kLeastRise_vx = 3;

/// Of the library: ivy has its own size, which finer or coarser voxels would not show.
const char* ruleSetFor(double voxel_m) {
  return voxel_m >= 0.01 && voxel_m <= 0.05 ? "ivy" : "courtyard_vine";
}

/// "4 cm", "0.5 mm", "2 m".
std::string written(double metres) {
  if (metres >= 1.0) return fmt::format("{:.6g} m", metres);
  if (metres >= 0.01) return fmt::format("{:.6g} cm", 100.0 * metres);
  return fmt::format("{:.6g} mm", 1000.0 * metres);
}

/// A text as YAML has it, in quotes where it would be something else without them.
std::string asYaml(const std::string& text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./";
  const bool plain = text.find_first_not_of(kPlain) == text.npos &&
                     (text.starts_with("../") || text.starts_with("/") ||
                      (!text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0));
  return plain ? text : nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string asName(const std::string& text) {
  std::string name;
  for (const char c : text) name += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' ? c : '_';
  return name.empty() ? "mesh" : name;
}

/// A place that reads well: three digits more than what it is measured in.
std::string place(const sim::Vec3& at_m, double step_m) {
  const int digits = std::max(0, 1 - static_cast<int>(std::floor(std::log10(step_m))));
  return fmt::format("[{:.{}f}, {:.{}f}, {:.{}f}]", at_m.x, digits, at_m.y, digits, at_m.z, digits);
}

std::string meshLine(const SceneMesh& mesh, const std::filesystem::path& scene_file,
                     std::set<std::string>& names) {
  const auto folder = std::filesystem::absolute(scene_file).lexically_normal().parent_path();
  const auto path = std::filesystem::absolute(mesh.file).lexically_normal().lexically_proximate(folder);
  std::string line = fmt::format("  - {{file: {}", asYaml(path.generic_string()));
  std::string name = asName(mesh.name);
  for (int i = 2; !names.insert(name).second; ++i) name = fmt::format("{}_{}", asName(mesh.name), i);
  if (name != mesh.name) line += ", name: " + asYaml(name);
  if (mesh.placement.unit) line += fmt::format(", unit: {}", nameOf(*mesh.placement.unit));
  if (mesh.placement.up == UpAxis::z) line += ", up: z";
  if (mesh.regions_from == RegionsFrom::material) line += ", regions: material";
  if (mesh.placement.translate_m != sim::Vec3(0.0)) {
    const sim::Vec3& by = mesh.placement.translate_m;
    line += fmt::format(", translate: [{}, {}, {}]", by.x, by.y, by.z);
  }
  if (mesh.solid == true) line += ", solid: true";
  return line + "}\n";
}

std::string sceneText(const std::vector<SceneMesh>& meshes, const std::array<sim::Vec3, 2>& box_m,
                      double voxel_m, const std::filesystem::path& scene_file,
                      const std::vector<std::string>& seeds) {
  const sim::Vec3 size = box_m[1] - box_m[0], middle = 0.5 * (box_m[0] + box_m[1]);
  const sim::Vec3 eye = middle + 1.5 * glm::length(size) * glm::normalize(sim::Vec3(0.55, 0.3, 1.0));
  std::set<std::string> names;
  std::string text = fmt::format("# {}\nespalier: scene\nname: {}\nmeshes:\n", sizeText(size),
                                 asYaml(asName(meshes.front().name)));
  for (const SceneMesh& mesh : meshes) text += meshLine(mesh, scene_file, names);
  text += fmt::format("world:\n  voxel: {}\n  margin: {}\n", written(voxel_m), written(kMargin_vx * voxel_m));
  text += fmt::format("plants:\n  - name: vine\n    rules: {}\n    seeds: [{}]\niterations: 40\n",
                      ruleSetFor(voxel_m), fmt::join(seeds, ", "));
  return text + fmt::format("cameras:\n  main: {{eye: {}, target: {}}}\nimages: [vines, sky_exposure]\n",
                            place(eye, voxel_m), place(middle, voxel_m));
}

Scene parsed(const std::string& text, const std::filesystem::path& scene_file) {
  auto scene = readSceneText(text, scene_file);
  if (!scene) throw PlacedError(scene.problems());
  return std::move(*scene);
}

/// Free voxels right above something.
std::vector<sim::Voxel> placesOn(const sim::World& world) {
  const sim::BitVolume& occupied = world.occupied();
  const sim::Voxel size = occupied.size();
  std::vector<sim::Voxel> places;
  for (int y = 1; y + 1 < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x) {
        if (!occupied.at({x, y, z}) && occupied.at({x, y - 1, z})) places.emplace_back(x, y, z);
      }
    }
  }
  return places;
}

/// Free voxels beside something that rises so far, as low as such places are, in the order (y, z, x).
std::vector<sim::Voxel> feetIn(const sim::World& world, int rise_vx) {
  const sim::BitVolume& occupied = world.occupied();
  const sim::Voxel size = occupied.size();
  std::vector<sim::Voxel> feet;
  const auto rises = [&](sim::Voxel v) {
    for (int up = 0; up < rise_vx; ++up) {
      if (!occupied.at(v + sim::Voxel(0, up, 0))) return false;
    }
    return true;
  };
  const auto isFree = [&](sim::Voxel v) { return !occupied.at(v) && !occupied.at(v + sim::Voxel(0, 1, 0)); };
  int lowest = size.y;
  for (int y = 0; y < size.y && y <= lowest + std::max(2, size.y / 50); ++y) {
    for (int z = 1; z + 1 < size.z; ++z) {
      for (int x = 1; x + 1 < size.x; ++x) {
        const sim::Voxel v(x, y, z);
        if (!isFree(v) || (!rises(v + sim::Voxel(1, 0, 0)) && !rises(v - sim::Voxel(1, 0, 0)) &&
                           !rises(v + sim::Voxel(0, 0, 1)) && !rises(v - sim::Voxel(0, 0, 1))))
          continue;
        lowest = std::min(lowest, y);
        feet.push_back(v);
      }
    }
  }
  return feet;
}

double apart2(sim::Voxel a, sim::Voxel b) {
  const sim::Vec3 d(a - b);
  return glm::dot(d, d);
}

/// Some of them, each as far from all before it as can be.
std::vector<sim::Voxel> spreadOver(const std::vector<sim::Voxel>& places, std::size_t count) {
  std::vector<sim::Voxel> chosen;
  std::vector<double> near2(places.size(), INFINITY);
  for (std::size_t next = 0; chosen.size() < std::min(count, places.size());) {
    chosen.push_back(places[next]);
    for (std::size_t i = 0; i < places.size(); ++i)
      near2[i] = std::min(near2[i], apart2(places[i], chosen.back()));
    next = static_cast<std::size_t>(std::max_element(near2.begin(), near2.end()) - near2.begin());
  }
  return chosen;
}

/// Of plants that stand where `seeds` are, by the blend of their rules.
std::vector<double> lightAt(const Scene& scene, const Site& site) {
  const auto lights =
      lightOfSeeds(makePlantings(scene, site), site.world, growthSettings(scene, site, {}).light);
  const rules::Light& blend = scene.plants.front().rules->light;
  std::vector<double> exposures;
  for (const rules::Exposure& light : lights)
    exposures.push_back((blend.sun * light.sun + blend.sky * light.sky) / (blend.sun + blend.sky));
  return exposures;
}

/// The brightest, not beside each other.
std::vector<std::size_t> brightestApart(const std::vector<sim::Voxel>& places,
                                        const std::vector<double>& light) {
  std::vector<std::size_t> order(places.size()), chosen;
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return light[a] > light[b]; });
  double far2 = 0.0;
  for (const sim::Voxel& v : places) far2 = std::max(far2, apart2(v, places.front()));
  for (const std::size_t i : order) {
    constexpr double kApart = 0.12;
    const bool alone = std::all_of(chosen.begin(), chosen.end(), [&](std::size_t other) {
      return apart2(places[i], places[other]) >= kApart * kApart * far2;
    });
    if (alone && chosen.size() < kSeeds) chosen.push_back(i);
  }
  return chosen;
}

}  // namespace

StarterScene starterScene(const std::vector<SceneMesh>& meshes, std::vector<sim::Mesh> placed,
                          const std::array<sim::Vec3, 2>& box_m, double voxel_m,
                          const std::filesystem::path& scene_file) {
  constexpr std::size_t kTried = 48;
  const auto textWith = [&](const std::vector<std::string>& seeds) {
    return sceneText(meshes, box_m, voxel_m, scene_file, seeds);
  };
  const Scene anywhere = parsed(textWith({place(box_m[0], voxel_m)}), scene_file);
  const Clock::time_point began = Clock::now();
  Site site = makeSite(anywhere, readSiteFiles(anywhere, std::move(placed)));
  const Clock::duration tiling = Clock::now() - began;
  std::vector<sim::Voxel> feet;  // of walls, not of the slab that they stand on
  for (int rise_vx = site.world.frame().size.y / 6; feet.empty() && rise_vx >= kLeastRise_vx; rise_vx /= 2)
    feet = spreadOver(feetIn(site.world, rise_vx), kTried);
  if (feet.empty()) feet = spreadOver(placesOn(site.world), kTried);  // nothing rises: on the ground
  std::vector<std::string> all, seeds;
  for (const sim::Voxel& v : feet)
    all.push_back(place(sim::worldFromVoxel(site.world.frame(), sim::Vec3(v)), voxel_m));
  const std::vector<double> light = lightAt(parsed(textWith(all), scene_file), site);
  for (const std::size_t i : brightestApart(feet, light)) seeds.push_back(all[i]);
  std::string text = textWith(seeds);
  Scene scene = parsed(text, scene_file);
  return {std::move(text), std::move(scene), std::move(site), tiling};
}

}  // namespace espalier::scenes
