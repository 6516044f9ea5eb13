#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "sim/base/random.h"
#include "sim/grow/plant.h"

/// Skeletons that grew by chance alone: forks of two to four limbs, and none of the order that rules bring.
namespace espalier::tests {

/// `least_apart_deg`: between the limbs of a fork. About `nodes` nodes.
inline sim::Skeleton randomTree(std::uint32_t number, sim::NodeId nodes = 250,
                                double least_apart_deg = 50.0) {
  sim::Skeleton skeleton;
  const auto add = [&](sim::NodeId parent, sim::Vec3 at, std::int32_t born) {
    skeleton.parent.push_back(parent);
    skeleton.position_vx.push_back(at);
    skeleton.born.push_back(born);
    return skeleton.size() - 1;
  };
  struct Tip {
    sim::NodeId node;
    sim::Vec3 way;
  };
  std::vector<Tip> tips{{add(sim::kNoNode, {0, 0, 0}, 0), {0, 1, 0}}};
  const double cos_apart = std::cos(least_apart_deg * 3.14159265358979 / 180.0);
  const std::uint64_t stream = sim::streamOf(number, "random tree");
  for (std::int32_t round = 1; skeleton.size() < nodes && !tips.empty(); ++round) {
    std::vector<Tip> next;
    for (const Tip& tip : tips) {
      sim::Draws draws({stream, static_cast<std::uint32_t>(tip.node), 0, static_cast<std::uint32_t>(round)},
                       sim::Purpose::custom);
      const bool forks = draws.uniform() < 0.3;
      const int children = forks ? draws.whole(2, 4) : 1;
      std::vector<sim::Vec3> ways;
      for (int tries = 0; static_cast<int>(ways.size()) < children && tries < 60; ++tries) {
        const sim::Vec3 way = draws.inCone(tip.way, forks ? 0.4 : 0.9);
        bool apart = true;
        for (const sim::Vec3 other : ways) apart &= glm::dot(way, other) < cos_apart;
        if (apart) ways.push_back(way);
      }
      for (const sim::Vec3 way : ways) {
        const sim::Vec3 from = skeleton.position_vx[static_cast<std::size_t>(tip.node)];
        next.push_back({add(tip.node, from + draws.uniform(1.5, 4.0) * way, round), way});
      }
    }
    tips = std::move(next);
  }
  return skeleton;
}

}  // namespace espalier::tests
