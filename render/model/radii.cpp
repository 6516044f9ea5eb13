#include "render/model/radii.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim/base/error.h"

namespace espalier::render {

std::vector<float> pipeRadii(const sim::Skeleton& skeleton, const PipeModel& model) {
  if (!(model.exponent > 0 && model.tip_radius_vx > 0 && model.max_radius_vx > 0)) {
    throw sim::InputError("pipe model: the exponent and the radii must be positive");
  }
  // All tips are equally thick, so r^e = tips * tip^e: counting tips in whole numbers keeps the sums exact.
  const auto nodes = static_cast<std::size_t>(skeleton.size());
  std::vector<std::int64_t> tips(nodes, 0);
  std::vector<float> radii(nodes);
  for (std::size_t n = nodes; n-- > 0;) {
    tips[n] = std::max<std::int64_t>(tips[n], 1);
    if (skeleton.parent[n] != sim::kNoNode) tips[static_cast<std::size_t>(skeleton.parent[n])] += tips[n];
    radii[n] = std::min(model.max_radius_vx,
                        model.tip_radius_vx * std::pow(static_cast<float>(tips[n]), 1.0f / model.exponent));
  }
  // A seed has no segment of its own; it is as thick as what grows from it.
  std::vector<float> thickest(nodes, 0.0f);
  for (std::size_t n = 0; n < nodes; ++n) {
    if (skeleton.parent[n] == sim::kNoNode) continue;
    float& most = thickest[static_cast<std::size_t>(skeleton.parent[n])];
    most = std::max(most, radii[n]);
  }
  for (std::size_t n = 0; n < nodes; ++n) {
    if (skeleton.parent[n] == sim::kNoNode && thickest[n] > 0) radii[n] = thickest[n];
  }
  return radii;
}

}  // namespace espalier::render
