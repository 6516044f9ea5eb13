#include "sim/sense/exposure.h"

#include <algorithm>

namespace espalier::sim {

bool reachesEdge(const BitVolume& occupied, Voxel p, const LatticeDirection& direction) {
  const Voxel size = occupied.size();
  for (Voxel start = p;; start += direction.v) {
    for (const Voxel o : direction.crossed) {
      const Voxel q = start + o;
      if (!contains(size, q)) return true;  // the world is convex: a ray that left it does not come back
      if (((occupied.row(q.y, q.z)[q.x >> 6] >> (q.x & 63)) & 1u) != 0) return false;
    }
  }
}

Outlook lookOut(const BitVolume& occupied, Voxel p, const DirectionSet& directions) {
  Outlook outlook;
  for (const LatticeDirection& direction : directions) {
    if (!reachesEdge(occupied, p, direction)) continue;
    outlook.sum = static_cast<std::uint16_t>(outlook.sum + direction.weight);
    outlook.toward += static_cast<double>(direction.weight) * glm::normalize(Vec3(direction.v));
  }
  return outlook;
}

float surfaceExposure(const BitVolume& occupied, const ExposureField& field, Voxel surface, Vec3f normal) {
  float sum = 0.0f, weights = 0.0f;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Vec3f step(static_cast<float>(dx), static_cast<float>(dy), static_cast<float>(dz));
        const float ahead = glm::dot(step, normal);
        const Voxel neighbour = surface + Voxel(dx, dy, dz);
        if (ahead <= 0.0f || occupied.at(neighbour)) continue;
        const float weight = ahead * ahead / glm::dot(step, step);
        sum += weight * field.at(neighbour);
        weights += weight;
      }
    }
  }
  return weights > 0.0f ? sum / weights : field.at(surface);
}

}  // namespace espalier::sim
