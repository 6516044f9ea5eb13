#pragma once
#include <span>
#include <vector>

#include "render/files/gltf.h"
#include "render/model/plant_model.h"
#include "sim/base/bits.h"
#include "sim/base/frame.h"
#include "sim/grow/plant.h"

namespace espalier::scenes {

/// `bare`: what the scene alone occupies. `level`: of detail. `instances`: as for render::ModelOptions.
std::vector<render::PlantModel> modelPlants(const sim::Frame& frame, std::span<const sim::Plant> plants,
                                            const sim::BitVolume& bare, int level = 0,
                                            bool instances = false);

/// Models plants only when they are asked for, small ones some at once: all models of a large scene take more
/// memory than all that has grown. Borrows the plants and `bare`.
render::PlantModels modelsOf(const sim::Frame& frame, std::span<const sim::Plant> plants,
                             const sim::BitVolume& bare, int level, bool instances);

}  // namespace espalier::scenes
