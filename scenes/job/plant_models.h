#pragma once
#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "render/files/gltf.h"
#include "render/model/plant_model.h"
#include "scenes/prepare/site.h"
#include "sim/base/bits.h"
#include "sim/base/frame.h"
#include "sim/base/provenance.h"
#include "sim/grow/plant.h"

namespace espalier::scenes {

/// The file of a coarser level of detail.
std::string levelFile(int level);

/// `bare`: what the scene alone occupies. `level`: of detail.
std::vector<render::PlantModel> modelPlants(const sim::Frame& frame, std::span<const sim::Plant> plants,
                                            const sim::BitVolume& bare, int level = 0);

/// Models plants only when they are asked for, small ones some at once: all models of a large scene take more
/// memory than all that has grown. Borrows the plants and `bare`.
render::PlantModels modelsOf(const sim::Frame& frame, std::span<const sim::Plant> plants,
                             const sim::BitVolume& bare, int level);

/// `plants` hands their models over; `meeting` hears of each plant's number and its limbs that meet.
void writeGlb(std::ostream& out, const Site& site, const render::PlantModels& plants,
              const sim::Provenance& made_by, const std::function<void(std::size_t, std::size_t)>& meeting);

}  // namespace espalier::scenes
