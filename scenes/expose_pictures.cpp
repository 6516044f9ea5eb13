#include "scenes/expose_pictures.h"

#include <algorithm>
#include <cmath>

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

NamedCamera overview(const sim::World& world, const sim::Sun& sun, double aspect) {
  const sim::Frame& frame = world.frame();
  const sim::Vec3 low = frame.origin_m - 0.5 * frame.voxel_m;
  const sim::Vec3 extent = sim::Vec3(frame.size) * frame.voxel_m;
  // Two faces of a house show more of it than one: aside by 28 degrees, and 32 up.
  const sim::Vec3 side = sunnySide(sun);
  const sim::Vec3 aside(side.x * 0.883 - side.z * 0.469, 0.0, side.z * 0.883 + side.x * 0.469);
  const sim::Vec3 back = glm::normalize(0.848 * aside + sim::Vec3(0, 0.53, 0));
  const sim::Vec3 right = glm::normalize(glm::cross(sim::Vec3(0, 1, 0), back));
  const sim::Vec3 up = glm::cross(back, right);
  const double tangent = 0.2867 / kRoom;  // of half the field of view
  const sim::Vec3 middle = low + 0.5 * extent;
  double distance = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const sim::Vec3 p = (sim::Vec3(corner & 1, (corner >> 1) & 1, corner >> 2) - 0.5) * extent;
    const double across = std::abs(glm::dot(p, right)) / aspect, above = std::abs(glm::dot(p, up));
    distance = std::max(distance, glm::dot(p, back) + std::max(across, above) / tangent);
  }
  return {"overview", {middle + distance * back, middle, kFov}};
}

std::vector<ImageSpec> exposureImages(const Scene& scene, const sim::Sun& sun) {
  std::vector<std::pair<ImageKind, const char*>> kinds = {{ImageKind::sky_exposure, "Sky exposure"}};
  if (!sun.directions.empty()) {
    kinds.insert(kinds.begin(), {ImageKind::sun_exposure, "Sun exposure"});
    // On an arc, which takes twelve hours by definition, hours would be sun_exposure in another unit.
    if (scene.sun.place) kinds.emplace_back(ImageKind::sun_hours, "Hours of direct sun");
  }
  if (!scene.plants.empty()) kinds.emplace_back(ImageKind::threshold, "Enough light for the plant");
  if (!sun.directions.empty()) kinds.emplace_back(ImageKind::shadow_matte, "Shadows");
  kinds.emplace_back(ImageKind::surface_colour, "Surface colour");
  if (!sun.directions.empty()) kinds.emplace_back(ImageKind::first_pass, "Lit by sun and sky");
  std::vector<ImageSpec> images;
  for (const NamedCamera& camera : scene.cameras) {
    const std::string end = scene.cameras.size() > 1 ? "_" + camera.name : "";
    ImageSpec sheet;
    sheet.name = "contact_sheet" + end;
    sheet.kind = ImageKind::contact_sheet;
    sheet.caption = scene.name;
    for (const auto& [kind, caption] : kinds) {
      ImageSpec image;
      image.name = std::string(nameOf(kind)) + end;
      image.kind = kind;
      image.camera = camera.name;
      image.caption = caption;
      sheet.of.push_back(image.name);
      images.push_back(std::move(image));
    }
    images.push_back(std::move(sheet));
  }
  return images;
}

}  // namespace espalier::scenes
