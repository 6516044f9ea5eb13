#include "render/form/formed.h"

#include <algorithm>
#include <utility>

#include "render/form/forks.h"
#include "render/form/rough.h"
#include "sim/base/stop.h"
#include "sim/grow/retiled.h"

namespace espalier::render {

sim::Plant formed(const sim::Plant& plant, const sim::World& world, const KeptFree& kept_free) {
  const sim::Voxel size = world.frame().size;
  const KeptFree blocked = [&](sim::Voxel v) { return !sim::contains(size, v) || kept_free(v); };
  sim::Plant formed =
      plant.form.forks == sim::StemForm::Forks::murray ? withMurrayForks(plant, blocked) : plant;
  return plant.form.rough ? roughened(formed, *plant.form.rough, world, blocked) : formed;
}

FormedStand formedStand(sim::World before, const sim::World& grown, std::span<const sim::Plant> plants) {
  std::vector<sim::Plant> stand(plants.begin(), plants.end());
  std::vector<bool> changed(plants.size(), false);
  sim::BitVolume taken(grown.frame().size);  // by what has its form
  for (std::size_t i = 0; i < plants.size(); ++i) {
    sim::throwIfStopped();
    if (!plants[i].form.any()) continue;
    const int own = static_cast<int>(i);
    changed[i] = true;
    stand[i] = formed(plants[i], before, [&](sim::Voxel v) {
      if (before.solid().at(v) || taken.at(v)) return true;
      return grown.solid().at(v) && grown.part(grown.partAt(v)).plant != own;
    });
    for (const sim::Voxel v : sim::stemVoxels(stand[i].skeleton)) taken.set(v);
  }
  sim::World world = sim::retiled(std::move(before), grown, stand, changed);
  return {std::move(stand), std::move(world)};
}

bool anyForm(std::span<const sim::Plant> plants) {
  return std::any_of(plants.begin(), plants.end(), [](const sim::Plant& plant) { return plant.form.any(); });
}

}  // namespace espalier::render
