#include "sim/light/exposure.h"

#include <algorithm>
#include <bit>

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

std::vector<Outlook> sharesOf(const DirectionSet& directions) {
  std::vector<Outlook> shares;
  for (const LatticeDirection& direction : directions) {
    shares.push_back(
        {direction.weight, static_cast<double>(direction.weight) * glm::normalize(Vec3(direction.v))});
  }
  return shares;
}

Outlook outlook(std::span<const Outlook> shares, std::span<const std::uint64_t> open, std::size_t first,
                std::size_t count) {
  Outlook outlook;
  const std::size_t end = first + count;
  for (std::size_t word = first / 64; 64 * word < end; ++word) {
    std::uint64_t left = open[word];
    if (64 * word < first) left &= ~std::uint64_t{0} << (first % 64);
    if (64 * (word + 1) > end) left &= (std::uint64_t{1} << (end % 64)) - 1;
    for (; left != 0; left &= left - 1) {
      const Outlook& share = shares[64 * word + static_cast<std::size_t>(std::countr_zero(left))];
      outlook.sum = static_cast<std::uint16_t>(outlook.sum + share.sum);
      outlook.toward += share.toward;
    }
  }
  return outlook;
}

Lookout::Lookout(const BitVolume& shape, const DirectionSet& directions) {
  const auto bitStep = [&](Voxel o) {
    return (static_cast<std::ptrdiff_t>(o.y) * shape.size().z + o.z) * shape.rowWords() *
               BitVolume::kWordBits +
           o.x;
  };
  for (const LatticeDirection& direction : directions) {
    const std::size_t first = crossed_.size();
    for (const Voxel o : direction.crossed) {
      crossed_.push_back(o);
      steps_.push_back(bitStep(o));
    }
    rays_.push_back(
        {direction.v, direction.weight, glm::normalize(Vec3(direction.v)), first, crossed_.size()});
  }
}

Outlook Lookout::from(const BitVolume& occupied, Voxel p) const {
  const std::uint64_t* const words = occupied.words().data();
  const std::ptrdiff_t start = (occupied.row(p.y, p.z) - words) * BitVolume::kWordBits + p.x;
  Outlook outlook;
  for (const Ray& ray : rays_) {
    const auto reaches = [&] {
      const int periods = periodsInside(occupied.size(), p, ray.v);
      std::ptrdiff_t bit = start;
      for (int k = 0; k < periods; ++k) {  // all of it lies inside, so nothing needs to be asked but the bits
        for (std::size_t i = ray.first; i < ray.last; ++i) {
          const std::ptrdiff_t at = bit + steps_[i];
          if (((words[at >> 6] >> (at & 63)) & 1u) != 0) return false;
        }
        bit += steps_[ray.last - 1];
      }
      const Voxel last = p + periods * ray.v;
      for (std::size_t i = ray.first; i < ray.last && contains(occupied.size(), last + crossed_[i]); ++i) {
        if (occupied.at(last + crossed_[i])) return false;
      }
      return true;
    };
    if (!reaches()) continue;
    outlook.sum = static_cast<std::uint16_t>(outlook.sum + ray.weight);
    outlook.toward += static_cast<double>(ray.weight) * ray.unit;
  }
  return outlook;
}

}  // namespace espalier::sim
