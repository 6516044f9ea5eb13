#include "rules/front/lengths.h"

#include <algorithm>
#include <cmath>

namespace espalier::rules {

double spacingOf(const Attractors& attractors) {
  constexpr std::int32_t kSamples = 4096;
  const std::int32_t count = attractors.size();
  if (count < 2) return 0.0;
  const std::int32_t stride = std::max(1, count / kSamples);
  std::vector<double> away;
  for (std::int32_t i = 0; i < count; i += stride) {
    const std::int32_t other = nearestOther(attractors, i);
    away.push_back(std::sqrt(distance2(attractors.at(i), attractors.at(other))));
  }
  const auto middle = away.begin() + static_cast<std::ptrdiff_t>(away.size() / 2);
  std::nth_element(away.begin(), middle, away.end());
  return *middle;
}

FrontLengths suitableLengths(double spacing) {
  const double edge = spacing / 0.55;
  return {0.5 * edge, 6.0 * edge, edge};
}

}  // namespace espalier::rules
