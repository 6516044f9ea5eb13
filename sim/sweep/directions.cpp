#include "sim/sweep/directions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim/tile/tiling.h"
#include "sim/world/field.h"

namespace espalier::sim {

int periodsInside(Voxel size, Voxel p, Voxel v) {
  int periods = std::numeric_limits<int>::max();
  for (int axis = 0; axis < 3; ++axis) {
    if (v[axis] > 0) periods = std::min(periods, (size[axis] - 1 - p[axis]) / v[axis]);
    if (v[axis] < 0) periods = std::min(periods, p[axis] / -v[axis]);
  }
  return periods;
}

std::vector<Voxel> crossedVoxels(Voxel v) {
  std::vector<Voxel> voxels;
  tileSegment(Vec3(0.0), Vec3(v), voxels);
  voxels.erase(voxels.begin());
  return voxels;
}

void forEachLatticeVector(Vec3 unit, int lowest, const std::function<bool(int, Voxel)>& visit) {
  const double reach = std::max({std::abs(unit.x), std::abs(unit.y), std::abs(unit.z)});
  for (int longest = 1; longest <= kLongestComponent; ++longest) {
    const Voxel low = Voxel(glm::floor(unit * (longest / reach)));
    for (int corner = 0; corner < 8; ++corner) {
      const Voxel raised = low + Voxel(corner & 1, (corner >> 1) & 1, corner >> 2);
      const Voxel v(raised.x, std::max(raised.y, lowest), raised.z);
      if (std::max({std::abs(v.x), v.y, std::abs(v.z)}) != longest) continue;
      if (std::gcd(std::gcd(v.x, v.y), v.z) != 1) continue;
      if (!visit(longest, v)) return;
    }
  }
}

double sineBetween(Voxel v, Vec3 unit) {
  const Vec3 way(v);
  if (glm::dot(way, unit) <= 0.0) return 1.0;
  const Vec3 off = glm::cross(way, unit);
  return std::sqrt(glm::dot(off, off) / glm::dot(way, way));
}

int crossedCount(Voxel v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);  // one face at a time
}

Voxel nearestLatticeVector(Vec3 unit, int longest) {
  Voxel best(0, 1, 0);
  double least = 2.0;
  forEachLatticeVector(unit, 1, [&](int size, Voxel v) {
    const double sine = sineBetween(v, unit);
    if (size <= longest && sine < least - 1e-12) {
      least = sine;
      best = v;
    }
    return size <= longest;
  });
  return best;
}

DirectionSet directionSet(const std::vector<Voxel>& vectors, const std::vector<double>& shares, int total) {
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  DirectionSet set;
  std::vector<std::pair<double, std::size_t>> remainders;
  int left = total;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    const double exact = sum > 0.0 ? shares[i] / sum * total : 0.0;
    set.push_back({vectors[i], crossedVoxels(vectors[i]), static_cast<std::uint16_t>(exact)});
    left -= set.back().weight;
    remainders.emplace_back(set.back().weight - exact, i);
  }
  std::sort(remainders.begin(), remainders.end());
  if (sum <= 0.0) return set;
  for (int k = 0; k < left; ++k)
    ++set[remainders[static_cast<std::size_t>(k) % remainders.size()].second].weight;
  return set;
}

}  // namespace espalier::sim
