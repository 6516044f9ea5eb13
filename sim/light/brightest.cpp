#include "sim/light/brightest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/light/exposure.h"
#include "sim/light/look.h"
#include "sim/world/field.h"

namespace espalier::sim {
namespace {

constexpr int kMostRows = 45, kMostColumns = 180;  // cells of two degrees
constexpr std::size_t kMostLobes = 1024;           // cells of a table whose lobes are kept: 4 MB
constexpr float kPi = std::numbers::pi_v<float>;

bool isOpen(std::span<const std::uint64_t> open, std::size_t ray) {
  return ((open[ray / 64] >> (ray % 64)) & 1u) != 0;
}

/// Unit direction at an elevation and azimuth, radians. In single precision: glibc's double functions give
/// other last bits on other processors.
Vec3f directionAt(float elevation, float azimuth) {
  const float across = cosf(elevation);
  return {across * cosf(azimuth), sinf(elevation), across * sinf(azimuth)};
}

/// Adds what each cell receives of one of them.
void addLobe(std::span<const SkyTable::Cell> cells, std::size_t from, float* received) {
  const Vec3f light = cells[from].light * cells[from].centre;
  for (std::size_t i = 0; i < cells.size(); ++i)
    received[i] += std::max(0.0f, glm::dot(cells[i].centre, light));
}

/// An open cell as a surface sees it.
struct Source {
  Vec3 centre, light;
};

/// What comes from the cells in front of a surface that faces this way: the gradient of what the surface
/// receives.
Vec3 lightInFront(std::span<const Source> sources, Vec3 facing) {
  Vec3 sum(0.0);
  for (const Source& source : sources) {
    // Nothing in place of what lies behind: no sum of these changes by a zero, and no branch is guessed
    // wrong.
    const double in_front = glm::dot(source.centre, facing) > 0.0 ? 1.0 : 0.0;
    sum += in_front * source.light;
  }
  return sum;
}

/// Of a cell, from its upper left corner on: the sun's band is narrower than cells are.
double meanWithin(const Background& background, float top, float row_step, float left, float column_step) {
  constexpr int kAcross = 4;
  double sum = 0.0, weights = 0.0;
  for (int i = 0; i < kAcross; ++i) {
    const float elevation = top - (static_cast<float>(i) + 0.5f) / kAcross * row_step;
    for (int k = 0; k < kAcross; ++k) {
      const Vec3 unit = glm::normalize(
          Vec3(directionAt(elevation, left + (static_cast<float>(k) + 0.5f) / kAcross * column_step)));
      const double radiance = background(unit), weight = static_cast<double>(cosf(elevation));
      if (!(radiance >= 0.0) || !std::isfinite(radiance)) {
        throw InputError(
            fmt::format("the sky's radiance at ({:.3f}, {:.3f}, {:.3f}) is {}; expected a number not below 0",
                        unit.x, unit.y, unit.z, radiance));
      }
      sum += weight * radiance;
      weights += weight;
    }
  }
  return sum / weights;
}

}  // namespace

SkyTable makeSkyTable(int rows, int columns, const Background& background) {
  if (rows < 2 || rows > kMostRows || columns < 4 || columns > kMostColumns) {
    throw InputError(
        fmt::format("a sky table of {} rows and {} columns; expected 2 to {} rows and 4 to {} columns", rows,
                    columns, kMostRows, kMostColumns));
  }
  SkyTable table{rows, columns, {}, {}};
  const int longest = std::min(2 * rows, kLongestComponent);
  const float row_step = 0.5f * kPi / static_cast<float>(rows);
  const float column_step = 2.0f * kPi / static_cast<float>(columns);
  std::vector<Voxel> vectors;
  std::vector<double> lights;
  std::map<std::tuple<int, int, int>, std::uint32_t> known;
  for (int row = 0; row < rows; ++row) {
    const float top = static_cast<float>(rows - row) * row_step;
    const float solid_angle = column_step * (sinf(top) - sinf(top - row_step));
    for (int column = 0; column < columns; ++column) {
      const Vec3f centre =
          directionAt(top - 0.5f * row_step, (static_cast<float>(column) + 0.5f) * column_step);
      const double radiance =
          meanWithin(background, top, row_step, static_cast<float>(column) * column_step, column_step);
      const Voxel v = nearestLatticeVector(glm::normalize(Vec3(centre)), longest);
      const auto [at, is_new] =
          known.try_emplace({v.y, v.z, v.x}, static_cast<std::uint32_t>(vectors.size()));
      if (is_new) {
        vectors.push_back(v);
        lights.push_back(0.0);
      }
      table.cells.push_back({centre, static_cast<float>(radiance) * solid_angle, at->second});
      lights[at->second] += static_cast<double>(table.cells.back().light);
    }
  }
  if (std::none_of(lights.begin(), lights.end(), [](double light) { return light > 0.0; }))
    throw InputError("a sky table without light; expected a radiance above 0 somewhere");
  table.rays = directionSet(vectors, lights, ExposureField::kWhole);
  return table;
}

SkyFilter::SkyFilter(const SkyTable& table)
    : cells_(table.cells),
      row_((cells_.size() + looking::kRowUnit - 1) / looking::kRowUnit * looking::kRowUnit) {
  if (cells_.size() > kMostLobes) return;
  lobes_.resize(cells_.size() * row_);
  for (std::size_t from = 0; from < cells_.size(); ++from) addLobe(cells_, from, lobes_.data() + from * row_);
}

std::vector<float> SkyFilter::illumination(std::span<const std::uint64_t> open) const {
  std::vector<std::uint32_t> sources;
  for (std::uint32_t i = 0; i < cells_.size(); ++i) {
    if (isOpen(open, cells_[i].ray)) sources.push_back(i);
  }
  std::vector<float> filtered(row_);
  if (lobes_.empty()) {
    for (const std::uint32_t from : sources) addLobe(cells_, from, filtered.data());
  } else {
    looking::sumRows(lobes_.data(), row_, sources, filtered.data());
  }
  filtered.resize(cells_.size());
  return filtered;
}

Vec3 SkyFilter::brightest(std::span<const std::uint64_t> open) const {
  constexpr int kMostSteps = 64;
  constexpr double kArrived = 1.0 - 1e-12;
  const std::vector<float> filtered = illumination(open);
  const auto best = std::max_element(filtered.begin(), filtered.end());
  if (best == filtered.end() || *best <= 0.0f) return Vec3(0.0);
  thread_local std::vector<Source> sources;  // it keeps its memory
  sources.resize(cells_.size());
  std::size_t count = 0;  // written whether they are open or not: no branch is guessed wrong
  for (const SkyTable::Cell& cell : cells_) {
    const Vec3 centre(cell.centre);
    sources[count] = {centre, static_cast<double>(cell.light) * centre};
    count += isOpen(open, cell.ray) ? 1 : 0;
  }
  // What a surface receives is a convex function of its normal, and homogeneous: facing the light in front of
  // it never loses any.
  Vec3 way = glm::normalize(Vec3(cells_[static_cast<std::size_t>(best - filtered.begin())].centre));
  for (int step = 0; step < kMostSteps; ++step) {
    const Vec3 next = glm::normalize(lightInFront({sources.data(), count}, way));
    const bool arrived = glm::dot(next, way) > kArrived;
    way = next;
    if (arrived) break;
  }
  return way;
}

namespace {

std::vector<std::uint64_t> openRays(const SkyTable& table, const BitVolume& occupied, Voxel p) {
  std::vector<std::uint64_t> open((table.rays.size() + 63) / 64);
  for (std::size_t ray = 0; ray < table.rays.size(); ++ray) {
    if (reachesEdge(occupied, p, table.rays[ray])) open[ray / 64] |= std::uint64_t{1} << (ray % 64);
  }
  return open;
}

}  // namespace

Vec3 brightest(const SkyTable& table, const BitVolume& occupied, Voxel p) {
  return SkyFilter(table).brightest(openRays(table, occupied, p));
}

std::vector<Vec3f> brightest(const SkyTable& table, const OpenTable& open) {
  const SkyFilter filter(table);
  std::vector<Vec3f> ways(open.where->count());
  parallelFor(ways.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ways[i] = Vec3f(filter.brightest(open.row(i)));
  });
  return ways;
}

SkySensor::SkySensor(const BitVolume& shape, const SkyTable& table)
    : rays_(shape, table.rays), filter_(table) {}

}  // namespace espalier::sim
