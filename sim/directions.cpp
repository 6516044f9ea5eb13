#include "sim/directions.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/field.h"
#include "sim/tiling.h"

namespace espalier::sim {
std::vector<Voxel> crossedVoxels(Voxel v) {
  std::vector<Voxel> voxels;
  tileSegment(Vec3(0.0), Vec3(v), voxels);
  voxels.erase(voxels.begin());
  return voxels;
}

Voxel nearestLatticeVector(Vec3 unit, int longest) {
  Voxel best(0, 1, 0);
  double best_cosine = -2.0;
  const double reach = std::max({std::abs(unit.x), std::abs(unit.y), std::abs(unit.z)});
  // Among the vectors whose longest component is `scale`, the nearest one lies beside the direction's own
  // point.
  for (int scale = 1; scale <= longest; ++scale) {
    const Voxel low = Voxel(glm::floor(unit * (scale / reach)));
    for (int corner = 0; corner < 8; ++corner) {
      const Voxel raised = low + Voxel(corner & 1, (corner >> 1) & 1, corner >> 2);
      const Voxel v(raised.x, std::max(raised.y, 1), raised.z);
      if (std::max({std::abs(v.x), v.y, std::abs(v.z)}) > longest) continue;
      if (std::gcd(std::gcd(v.x, v.y), v.z) != 1) continue;
      const double c = glm::dot(Vec3(v), unit) / std::sqrt(glm::dot(Vec3(v), Vec3(v)));
      if (c > best_cosine + 1e-12) {
        best_cosine = c;
        best = v;
      }
    }
  }
  return best;
}

DirectionSet directionSet(const std::vector<Voxel>& vectors, const std::vector<double>& shares, int total) {
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  DirectionSet set;
  std::vector<std::pair<double, std::size_t>> remainders;
  int left = total;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    const double exact = shares[i] / sum * total;
    set.push_back({vectors[i], crossedVoxels(vectors[i]), static_cast<std::uint16_t>(exact)});
    left -= set.back().weight;
    remainders.emplace_back(set.back().weight - exact, i);
  }
  std::sort(remainders.begin(), remainders.end());
  for (int k = 0; k < left; ++k)
    ++set[remainders[static_cast<std::size_t>(k) % remainders.size()].second].weight;
  return set;
}

DirectionSet singleDirection(Vec3 unit) {
  constexpr int kLongest = 24;  // within about a degree
  return directionSet({nearestLatticeVector(unit, kLongest)}, {1.0}, ExposureField::kWhole);
}

}  // namespace espalier::sim
