#include "scenes/show/expose_pictures.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>

#include "scenes/show/pictures.h"

namespace espalier::scenes {
namespace {

constexpr double kFov = 32.0;
constexpr double kRoom = 1.04;  // between the world and the picture's edge

/// The horizontal way to where the sun stands on the whole; +z where it has none.
sim::Vec3 sunnySide(const sim::Sun& sun) {
  sim::Vec3 sum(0.0);
  for (const sim::LatticeDirection& d : sun.directions)
    sum += static_cast<double>(d.weight) * glm::normalize(sim::Vec3(d.v));
  sum.y = 0.0;
  return glm::length(sum) > 1e-3 ? glm::normalize(sum) : sim::Vec3(0, 0, 1);
}

}  // namespace

NamedCamera overview(const sim::Frame& frame, const std::vector<sim::TiledVoxel>& surfaces,
                     const sim::Sun& sun, double aspect) {
  // Two faces of a house show more of it than one: aside by 28 degrees, and 32 up.
  const sim::Vec3 side = sunnySide(sun);
  const sim::Vec3 aside(side.x * 0.883 - side.z * 0.469, 0.0, side.z * 0.883 + side.x * 0.469);
  const sim::Vec3 back = glm::normalize(0.848 * aside + sim::Vec3(0, 0.53, 0));
  const sim::Vec3 right = glm::normalize(glm::cross(sim::Vec3(0, 1, 0), back));
  const sim::Vec3 up = glm::cross(back, right);
  // A point at (x, y, z) to the right, above and to the back is in the picture of an eye at (a, b, d) if
  // |x - a| <= t (d - z), t being the tangent of half the field of view, and so for y.
  const double tall = 0.2867 / kRoom, wide = tall * aspect;
  double least_right = -INFINITY, least_left = -INFINITY, least_up = -INFINITY, least_down = -INFINITY;
  const auto include = [&](sim::Vec3 p_m) {
    const double x = glm::dot(p_m, right), y = glm::dot(p_m, up), z = glm::dot(p_m, back);
    least_right = std::max(least_right, x + wide * z);
    least_left = std::max(least_left, -x + wide * z);
    least_up = std::max(least_up, y + tall * z);
    least_down = std::max(least_down, -y + tall * z);
  };
  for (const sim::TiledVoxel& tiled : surfaces) include(sim::worldFromVoxel(frame, sim::Vec3(tiled.voxel)));
  if (surfaces.empty()) {
    include(sim::worldFromVoxel(frame, sim::Vec3(-0.5)));
    include(sim::worldFromVoxel(frame, sim::Vec3(frame.size) - 0.5));
  }
  const double distance =
      std::max((least_right + least_left) / (2 * wide), (least_up + least_down) / (2 * tall));
  const sim::Vec3 eye =
      0.5 * (least_right - least_left) * right + 0.5 * (least_up - least_down) * up + distance * back;
  return {"overview", {eye, eye - glm::length(sim::Vec3(frame.size)) * frame.voxel_m * back, kFov}};
}

namespace {

/// Kind and caption of each, for one camera.
std::vector<ImageSpec> exposureKinds(const Scene& scene, bool sun) {
  std::vector<ImageSpec> images;
  const auto add = [&](ImageKind kind, const std::string& caption, const std::string& plant = "") {
    ImageSpec image;
    image.name = std::string(nameOf(kind)) + (plant.empty() ? "" : "_" + plant);
    image.kind = kind;
    image.caption = caption;
    image.plant = plant;
    images.push_back(std::move(image));
  };
  if (sun) add(ImageKind::sun_exposure, "Sun exposure");
  add(ImageKind::sky_exposure, "Sky exposure");
  // On an arc, which takes twelve hours by definition, hours would be sun_exposure in another unit.
  if (sun && scene.sun.place) add(ImageKind::sun_hours, "Hours of direct sun");
  std::vector<PlantLight> needs;  // each once, by the first plant that has them
  for (const PlantSpec& plant : scene.plants) {
    const render::LightNeeds own = lightNeeds(*plant.rules);
    const auto same = [&](const PlantLight& other) { return other.needs == own; };
    const auto at = std::find_if(needs.begin(), needs.end(), same);
    if (at == needs.end()) needs.push_back({plant.name, own});
  }
  for (const PlantLight& plant : needs) {
    const bool alone = needs.size() == 1;
    add(ImageKind::threshold, "Enough light for " + (alone ? "the plant" : plant.name),
        alone ? "" : plant.name);
  }
  if (sun) add(ImageKind::shadow_matte, "Shadows");
  add(ImageKind::surface_colour, "Surface colour");
  if (sun) add(ImageKind::first_pass, "Lit by sun and sky");
  return images;
}

/// What a file may be called, as near to the name as can be, and as no other is.
std::string fileName(std::string name, std::set<std::string>& taken) {
  constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  std::replace_if(
      name.begin(), name.end(), [&](char c) { return kAllowed.find(c) == kAllowed.npos; }, '_');
  while (!taken.insert(name).second) name += '_';
  return name;
}

}  // namespace

std::vector<ImageSpec> exposureImages(const Scene& scene, const std::vector<NamedCamera>& cameras, bool sun) {
  std::vector<ImageSpec> images;
  std::set<std::string> taken;
  for (const NamedCamera& camera : cameras) {
    const std::string end = cameras.size() > 1 ? "_" + camera.name : "";
    ImageSpec sheet;
    sheet.name = fileName("contact_sheet" + end, taken);
    sheet.kind = ImageKind::contact_sheet;
    sheet.caption = scene.name;
    for (ImageSpec& image : exposureKinds(scene, sun)) {
      image.name = fileName(image.name + end, taken);
      image.camera = camera.name;
      sheet.of.push_back(image.name);
      images.push_back(std::move(image));
    }
    images.push_back(std::move(sheet));
  }
  return images;
}

}  // namespace espalier::scenes
