#include "scenes/job/plant_models.h"

#include <fmt/format.h>

#include "sim/base/parallel.h"

namespace espalier::scenes {

std::string levelFile(int level) {
  return fmt::format("plant_lod{}.glb", level);
}

std::vector<render::PlantModel> modelPlants(const sim::Frame& frame, std::span<const sim::Plant> plants,
                                            const sim::BitVolume& bare, int level) {
  const render::ModelOptions options{.error = render::errorOfLevel(level), .walls = &bare};
  std::vector<render::PlantModel> models(plants.size());
  sim::parallelFor(plants.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) models[i] = render::modelPlant(plants[i], frame, options);
  });
  return models;
}

render::PlantModels modelsOf(const sim::Frame& frame, std::span<const sim::Plant> plants,
                             const sim::BitVolume& bare, int level) {
  return [=, &bare](const std::function<void(const render::PlantModel&)>& take) {
    constexpr std::size_t kAtOnce = 4096;  // nodes and elements
    for (std::size_t first = 0, last = 0; first < plants.size(); first = last) {
      std::size_t pieces = 0;
      while (last < plants.size() && pieces < kAtOnce) {
        pieces += plants[last].skeleton.parent.size() + plants[last].elements.size();
        ++last;
      }
      for (const auto& model : modelPlants(frame, plants.subspan(first, last - first), bare, level))
        take(model);
    }
  };
}

void writeGlb(std::ostream& out, const Site& site, const render::PlantModels& plants,
              const sim::Provenance& made_by, const std::function<void(std::size_t, std::size_t)>& meeting) {
  std::vector<const sim::Mesh*> meshes;
  for (const auto& tiled : site.meshes) meshes.push_back(&tiled.mesh);
  const auto heard = [&](const std::function<void(const render::PlantModel&)>& take) {
    std::size_t number = 0;
    plants([&](const render::PlantModel& model) {
      meeting(number++, model.meeting_limbs);
      take(model);
    });
  };
  render::writeGlb(out, meshes, heard, made_by);
}

}  // namespace espalier::scenes
