#include "scenes/job/plant_models.h"

#include "sim/base/parallel.h"

namespace espalier::scenes {

std::vector<render::PlantModel> modelPlants(const sim::Frame& frame, std::span<const sim::Plant> plants,
                                            const sim::BitVolume& bare, int level, bool instances) {
  const render::ModelOptions options{
      .error = render::errorOfLevel(level), .walls = &bare, .instances = instances};
  std::vector<render::PlantModel> models(plants.size());
  sim::parallelFor(plants.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) models[i] = render::modelPlant(plants[i], frame, options);
  });
  return models;
}

render::PlantModels modelsOf(const sim::Frame& frame, std::span<const sim::Plant> plants,
                             const sim::BitVolume& bare, int level, bool instances) {
  return [=, &bare](const std::function<void(const render::PlantModel&)>& take) {
    constexpr std::size_t kAtOnce = 4096;  // nodes and elements
    for (std::size_t first = 0, last = 0; first < plants.size(); first = last) {
      std::size_t pieces = 0;
      while (last < plants.size() && pieces < kAtOnce) {
        pieces += plants[last].skeleton.parent.size() + plants[last].elements.size();
        ++last;
      }
      for (const auto& model :
           modelPlants(frame, plants.subspan(first, last - first), bare, level, instances))
        take(model);
    }
  };
}

}  // namespace espalier::scenes
