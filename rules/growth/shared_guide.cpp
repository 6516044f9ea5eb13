#include "rules/growth/shared_guide.h"

#include "sim/base/error.h"

namespace espalier::rules {
namespace {

using Doubles = std::vector<double>;
using Places = std::vector<sim::Vec3>;
using Whole = std::vector<std::int32_t>;
using Words = std::vector<std::int64_t>;

void require(bool good) {
  if (!good) throw sim::BrokenContract("columns that hold no guide field");
}

template <typename Values>
std::vector<typename Values::value_type> copied(const Values& values) {
  return {values.begin(), values.end()};
}

/// The columns of a lattice: a grid or a region.
template <typename Lattice>
void putLattice(sim::Columns& columns, const std::string& name, const Lattice& lattice) {
  columns[name + "_size"] = Whole{lattice.size[0], lattice.size[1], lattice.size[2]};
  columns[name + "_low_vx"] = Places{lattice.low};
  columns[name + "_apart_vx"] = Doubles{lattice.apart};
}

/// Their points, all in all.
template <typename Lattice>
std::size_t takeLattice(const sim::Columns& columns, const std::string& name, Lattice& lattice) {
  const auto& size = sim::column<std::int32_t>(columns, name + "_size");
  const auto& low = sim::column<sim::Vec3>(columns, name + "_low_vx");
  const auto& apart = sim::column<double>(columns, name + "_apart_vx");
  require(size.size() == 3 && low.size() == 1 && apart.size() == 1);
  lattice.low = low[0];
  lattice.apart = apart[0];
  std::size_t all = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    require(size[axis] >= 0 && size[axis] <= 4096);
    lattice.size[axis] = size[axis];
    all *= static_cast<std::size_t>(size[axis]);
  }
  return all;
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
  columns["grid"] = copied(grid.vectors);
  putLattice(columns, "grid", grid);
  columns["region"] = guide.region ? copied(guide.region->words) : Words();
  putLattice(columns, "region", guide.region.value_or(GuideRegion()));
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
  guide.grid.vectors = sim::column<sim::Vec3>(columns, "grid");
  const std::size_t points = takeLattice(columns, "grid", guide.grid);
  require(points == guide.grid.vectors.size() && (guide.axis != GuideAxis::grid || points > 0));
  const auto& words = sim::column<std::int64_t>(columns, "region");
  GuideRegion region{.words = words};
  require(words.size() == (takeLattice(columns, "region", region) + 63) / 64);
  if (!words.empty()) guide.region = region;
  return guide;
}

}  // namespace espalier::rules
