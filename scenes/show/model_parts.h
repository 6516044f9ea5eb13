#pragma once
#include <vector>

#include "render/model/plant_model.h"

namespace espalier::scenes {

/// Plants without their stems or without their elements. Stalks stand where both do.
std::vector<render::PlantModel> partsOf(const std::vector<render::PlantModel>& whole, bool stems,
                                        bool elements);

}  // namespace espalier::scenes
