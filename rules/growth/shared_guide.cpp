#include "rules/growth/shared_guide.h"

#include "sim/base/error.h"

namespace espalier::rules {
namespace {

using Doubles = std::vector<double>;
using Places = std::vector<sim::Vec3>;
using Whole = std::vector<std::int32_t>;

void require(bool good) {
  if (!good) throw sim::BrokenContract("columns that hold no guide field");
}

}  // namespace

std::string fieldNamed(const std::string& name) {
  return "field " + name;
}

sim::Columns columnsOf(const Guide& guide) {
  sim::Columns columns;
  columns["angle_and_strength"] = Doubles{guide.angle_deg, guide.strength};
  columns["axis"] = Whole{static_cast<std::int32_t>(guide.axis), guide.follows_normal ? 1 : 0};
  columns["direction"] = Places{guide.direction};
  columns["box_vx"] = guide.box ? Places{(*guide.box)[0], (*guide.box)[1]} : Places{};
  columns["orders"] = Whole{guide.orders[0], guide.orders[1]};
  Places at;
  Doubles point;
  for (const GuidePoint& p : guide.points) {
    at.push_back(p.at);
    point.insert(point.end(), {p.radius, p.angle_deg, p.strength});
  }
  columns["points_at_vx"] = at;
  columns["points"] = point;
  const GuideGrid& grid = guide.grid;
  columns["grid"] = grid.vectors;
  columns["grid_size"] = Whole{grid.size[0], grid.size[1], grid.size[2]};
  columns["grid_low_vx"] = Places{grid.low};
  columns["grid_apart_vx"] = Doubles{grid.apart};
  return columns;
}

Guide guideIn(const sim::Columns& columns) {
  Guide guide;
  const auto& numbers = sim::column<double>(columns, "angle_and_strength");
  const auto& axis = sim::column<std::int32_t>(columns, "axis");
  const auto& direction = sim::column<sim::Vec3>(columns, "direction");
  const auto& box = sim::column<sim::Vec3>(columns, "box_vx");
  require(numbers.size() == 2 && axis.size() == 2 && direction.size() == 1 &&
          (box.empty() || box.size() == 2) && axis[0] >= 0 && axis[0] <= 3);
  guide.angle_deg = numbers[0];
  guide.strength = numbers[1];
  guide.axis = static_cast<GuideAxis>(axis[0]);
  guide.follows_normal = axis[1] != 0;
  guide.direction = direction[0];
  if (!box.empty()) guide.box = {box[0], box[1]};
  const auto& orders = sim::column<std::int32_t>(columns, "orders");
  require(orders.size() == 2);
  guide.orders = {orders[0], orders[1]};
  const auto& at = sim::column<sim::Vec3>(columns, "points_at_vx");
  const auto& point = sim::column<double>(columns, "points");
  require(point.size() == 3 * at.size());
  for (std::size_t i = 0; i < at.size(); ++i)
    guide.points.push_back({at[i], point[3 * i], point[3 * i + 1], point[3 * i + 2]});
  const auto& size = sim::column<std::int32_t>(columns, "grid_size");
  const auto& low = sim::column<sim::Vec3>(columns, "grid_low_vx");
  const auto& apart = sim::column<double>(columns, "grid_apart_vx");
  require(size.size() == 3 && low.size() == 1 && apart.size() == 1);
  guide.grid = {low[0], apart[0], {size[0], size[1], size[2]}, sim::column<sim::Vec3>(columns, "grid")};
  std::size_t all = 1;
  for (const std::int32_t along : guide.grid.size) {
    require(along >= 0 && along <= 4096);
    all *= static_cast<std::size_t>(along);
  }
  require(all == guide.grid.vectors.size() && (guide.axis != GuideAxis::grid || all > 0));
  return guide;
}

}  // namespace espalier::rules
