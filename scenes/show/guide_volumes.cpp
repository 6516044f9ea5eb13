#include "scenes/show/guide_volumes.h"

#include <fmt/format.h>

namespace espalier::scenes {
namespace {

constexpr int kFarthest = 3;

/// The voxels in a cube about each place, as large as there may be.
sim::BitVolume around(const std::vector<sim::Vec3>& places_vx, sim::Voxel size) {
  int reach = kFarthest;
  const auto most = [&](int r) {
    const auto side = static_cast<std::size_t>(2 * r + 1);
    return places_vx.size() * side * side * side;
  };
  while (reach > 0 && most(reach) > kMostGuideVoxels) --reach;
  sim::BitVolume near(size);
  for (const sim::Vec3& place : places_vx) {
    const sim::Voxel middle = sim::voxelAt(place);
    const sim::Voxel low = glm::max(middle - reach, sim::Voxel(0));
    const sim::Voxel high = glm::min(middle + reach, size - 1);
    for (int y = low.y; y <= high.y; ++y) {
      for (int z = low.z; z <= high.z; ++z) {
        for (int x = low.x; x <= high.x; ++x) near.set({x, y, z});
      }
    }
  }
  return near;
}

std::string axisOf(const rules::Guide& guide) {
  switch (guide.axis) {
    case rules::GuideAxis::node_normal:
      return "normal of the nearest attractor";
    case rules::GuideAxis::attractor_normal:
      return "normal of the attractor that pulls; here of the nearest";
    case rules::GuideAxis::grid:
      return "vectors of a file";
    case rules::GuideAxis::direction:
      break;
  }
  return fmt::format("[{:g}, {:g}, {:g}]", guide.direction.x, guide.direction.y, guide.direction.z);
}

}  // namespace

GuideVolumes guideVolumes(const sim::Growth& growth, const std::vector<UsedField>& fields,
                          const sim::World& world) {
  GuideVolumes volumes;
  std::vector<std::pair<std::string, std::shared_ptr<const ShownField>>> shown;
  std::vector<sim::Vec3> places_vx;
  for (const UsedField& used : fields) {
    if (used.uses.empty()) continue;
    shown.emplace_back(used.name, std::make_shared<const ShownField>(growth, used));
    const auto attractors_vx = shown.back().second->attractors_vx();
    places_vx.insert(places_vx.end(), attractors_vx.begin(), attractors_vx.end());
  }
  if (shown.empty()) return volumes;
  volumes.near = std::make_shared<const sim::VoxelSet>(around(places_vx, world.frame().size));
  for (const auto& [name, field] : shown) {
    const auto vector = [field = field](sim::Voxel v, std::size_t) {
      return sim::Vec3f(field->at(sim::Vec3(v)));
    };
    volumes.fields.push_back(
        {"field " + name,
         "what a guide field adds to the unit pull of attractors: strength times its way",
         "1",
         std::vector<render::VdbPart<sim::Vec3f>>{{volumes.near.get(), vector}},
         {{"angle", fmt::format("{:g} degrees", field->guide().angle_deg)},
          {"strength", fmt::format("{:g}", field->guide().strength)},
          {"axis", axisOf(field->guide())}},
         false});
  }
  return volumes;
}

}  // namespace espalier::scenes
