#pragma once
#include <optional>
#include <vector>

#include "scenes/job/stages.h"
#include "scenes/prepare/site.h"
#include "sim/grow/grow.h"

namespace espalier::scenes {

/// A copy of the site's world, if anything that grows on it is given another form once it has grown.
std::optional<sim::World> worldToForm(const Site& site, const std::vector<sim::Planting>& plantings);

/// What has grown, as it is shown, lit and written, and as it is kept.
class Shown {
 public:
  /// `before`: from worldToForm. With it the site's world becomes that in which the forms stand.
  Shown(sim::Growth grown, std::optional<sim::World> before, Site& site, Stages& stages);

  const sim::Growth& growth() const { return shown_; }
  /// What grew, to be gone on with, and its world.
  const sim::Growth& grown() const { return grown_ ? *grown_ : shown_; }
  const sim::World& grownWorld() const { return grown_world_ ? *grown_world_ : site_.world; }

 private:
  const Site& site_;
  sim::Growth shown_;
  std::optional<sim::Growth> grown_;
  std::optional<sim::World> grown_world_;
};

}  // namespace espalier::scenes
