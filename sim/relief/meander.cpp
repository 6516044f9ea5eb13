#include "sim/relief/meander.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sim/relief/sparse_noise.h"

namespace espalier::sim {
namespace {

constexpr double kPiecesAWave = 12.0;
constexpr unsigned kAlongX = 32, kAlongZ = 64;  // numbers of the first octaves: erosion has those from 0

/// How many octaves can be seen.
int octavesOf(const Meander& meander, double spacing_m) {
  int octaves = 0;
  for (double scale_m = meander.scale_m; octaves < meander.octaves && scale_m >= 2.0 * spacing_m;
       scale_m *= 0.5)
    ++octaves;
  return meander.amplitude_m > 0.0 ? octaves : 0;
}

double pieceOf(const Meander& meander, double spacing_m) {
  return std::max(spacing_m, std::ldexp(meander.scale_m, 1 - octavesOf(meander, spacing_m)) / kPiecesAWave);
}

int piecesOf(const PlanLines& lines, std::size_t n, double piece_m) {
  const double length_m = glm::distance(lines.at_m[n], lines.at_m[static_cast<std::size_t>(lines.parent[n])]);
  return std::max(1, static_cast<int>(std::ceil(length_m / piece_m)));
}

struct Extent {
  glm::dvec2 low_m{0.0}, high_m{0.0};
};

Extent extentOf(const PlanLines& lines) {
  Extent extent{lines.at_m.front(), lines.at_m.front()};
  for (const glm::dvec2 at_m : lines.at_m) {
    extent.low_m = glm::min(extent.low_m, at_m);
    extent.high_m = glm::max(extent.high_m, at_m);
  }
  return extent;
}

}  // namespace

PlanLines meandering(const PlanLines& lines, const Meander& meander, double spacing_m, std::uint64_t stream) {
  const int octaves = octavesOf(meander, spacing_m);
  if (octaves == 0 || lines.at_m.empty()) return lines;
  const double piece_m = pieceOf(meander, spacing_m);
  PlanLines moved;
  std::vector<std::int32_t> number(lines.parent.size());
  for (std::size_t n = 0; n < number.size(); ++n) {
    if (lines.parent[n] >= 0) {
      const auto parent = static_cast<std::size_t>(lines.parent[n]);
      const int pieces = piecesOf(lines, n, piece_m);
      std::int32_t before = number[parent];
      for (int i = 1; i < pieces; ++i) {
        moved.at_m.push_back(glm::mix(lines.at_m[parent], lines.at_m[n], static_cast<double>(i) / pieces));
        moved.parent.push_back(before);
        before = static_cast<std::int32_t>(moved.parent.size()) - 1;
      }
      moved.parent.push_back(before);
    } else {
      moved.parent.push_back(-1);
    }
    moved.at_m.push_back(lines.at_m[n]);
    number[n] = static_cast<std::int32_t>(moved.parent.size()) - 1;
  }
  const Extent extent = extentOf(lines);
  std::vector<glm::dvec2> way_m(moved.at_m.size(), glm::dvec2(0.0));
  for (int octave = 0; octave < octaves; ++octave) {
    const auto number_of = static_cast<unsigned>(octave);
    const double scale_m = std::ldexp(meander.scale_m, -octave),
                 amplitude_m = std::ldexp(meander.amplitude_m, -2 * octave);
    const SparseNoise along_x(stream, kAlongX + number_of, scale_m, extent.low_m, extent.high_m),
        along_z(stream, kAlongZ + number_of, scale_m, extent.low_m, extent.high_m);
    for (std::size_t n = 0; n < way_m.size(); ++n)
      way_m[n] += amplitude_m * glm::dvec2(along_x.at(moved.at_m[n]), along_z.at(moved.at_m[n]));
  }
  for (std::size_t n = 0; n < way_m.size(); ++n) moved.at_m[n] += way_m[n];
  return moved;
}

double meanderBytes(const PlanLines& lines, const Meander& meander, double spacing_m) {
  constexpr double kBytesANode = 100.0;
  const int octaves = octavesOf(meander, spacing_m);
  if (octaves == 0 || lines.at_m.empty()) return 0.0;
  const double piece_m = pieceOf(meander, spacing_m);
  double nodes = 0.0;
  for (std::size_t n = 0; n < lines.parent.size(); ++n)
    nodes += lines.parent[n] < 0 ? 1.0 : piecesOf(lines, n, piece_m);
  const Extent extent = extentOf(lines);
  return kBytesANode * nodes +
         2.0 * SparseNoise::bytes(std::ldexp(meander.scale_m, 1 - octaves), extent.high_m - extent.low_m);
}

}  // namespace espalier::sim
