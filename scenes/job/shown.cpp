#include "scenes/job/shown.h"

#include <algorithm>
#include <utility>

#include "render/form/formed.h"

namespace espalier::scenes {

std::optional<sim::World> worldToForm(const Site& site, const std::vector<sim::Planting>& plantings) {
  const bool forms = std::any_of(plantings.begin(), plantings.end(), [](const sim::Planting& planting) {
    return planting.process->seedling().form.any();
  });
  return forms ? std::optional(site.world) : std::nullopt;
}

Shown::Shown(sim::Growth grown, std::optional<sim::World> before, Site& site, Stages& stages)
    : site_(site), shown_(std::move(grown)) {
  if (!before) return;
  stages.run("forming", [&] {
    render::FormedStand stand = render::formedStand(std::move(*before), site.world, shown_.plants);
    grown_world_ = std::exchange(site.world, std::move(stand.world));
    grown_ = shown_;
    shown_.plants = std::move(stand.plants);
  });
}

}  // namespace espalier::scenes
