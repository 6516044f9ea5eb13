#include "scenes/show/model_parts.h"

namespace espalier::scenes {

std::vector<render::PlantModel> partsOf(const std::vector<render::PlantModel>& whole, bool stems,
                                        bool elements) {
  std::vector<render::PlantModel> parts;
  for (const render::PlantModel& model : whole) {
    render::PlantModel& part = parts.emplace_back();
    part.name = model.name;
    if (stems) part.stems = model.stems;
    if (stems && elements) part.stalks = model.stalks;
    if (elements) part.elements = model.elements;
  }
  return parts;
}

}  // namespace espalier::scenes
