#include "sim/relief/lines.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace espalier::sim {
namespace {

std::size_t index(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

std::vector<double> flowOf(const PlanLines& lines) {
  std::vector<double> flow(lines.parent.size(), 0.0);
  for (std::size_t n = flow.size(); n-- > 0;) {
    if (flow[n] == 0.0) flow[n] = 1.0;
    if (lines.parent[n] >= 0) flow[index(lines.parent[n])] += flow[n];
  }
  return flow;
}

std::vector<std::int32_t> ordersOf(const PlanLines& lines) {
  const std::vector<double> flow = flowOf(lines);
  std::vector<std::int32_t> main(flow.size(), -1), order(flow.size(), 0);
  for (std::size_t n = 0; n < flow.size(); ++n) {
    if (lines.parent[n] < 0) continue;
    std::int32_t& best = main[index(lines.parent[n])];
    if (best < 0 || flow[n] > flow[index(best)]) best = static_cast<std::int32_t>(n);
  }
  for (std::size_t n = 0; n < flow.size(); ++n) {
    if (lines.parent[n] < 0) continue;
    const std::size_t parent = index(lines.parent[n]);
    order[n] = order[parent] + (main[parent] == static_cast<std::int32_t>(n) ? 0 : 1);
  }
  return order;
}

std::vector<double> heightsOf(const PlanLines& lines, const RiseLaw& law) {
  const std::vector<double> flow = flowOf(lines);
  const std::vector<std::int32_t> order = ordersOf(lines);
  std::vector<double> height(flow.size(), law.base_m);
  for (std::size_t n = 0; n < flow.size(); ++n) {
    if (lines.parent[n] < 0) continue;
    const std::size_t parent = index(lines.parent[n]);
    const double steep = law.grade * std::pow(flow[n], -law.concavity) * std::pow(law.order_share, order[n]);
    height[n] = height[parent] + steep * glm::distance(lines.at_m[n], lines.at_m[parent]);
  }
  return height;
}

double widthOf(double width_m, double flow) {
  return width_m * std::sqrt(flow);
}

}  // namespace espalier::sim
