#include "scenes/show/growth_graph.h"

#include <fmt/format.h>

#include "rules/growth/front_memory.h"

namespace espalier::scenes {
namespace {

constexpr std::size_t kSetsNamed = 3;  // a legend with more names would be wider than its picture

void addPlant(GrowthGraph& whole, const sim::Skeleton& skeleton, const sim::Frame& frame) {
  const auto first = static_cast<std::int32_t>(whole.nodes.size());
  for (std::size_t n = 0; n < skeleton.parent.size(); ++n) {
    const sim::NodeId parent = skeleton.parent[n];
    whole.nodes.push_back({{sim::worldFromVoxel(frame, skeleton.position_vx[n])},
                           parent == sim::kNoNode ? -1 : first + parent});
    whole.born.push_back(skeleton.born[n]);
  }
}

void addAttractors(GrowthGraph& whole, const sim::Columns& columns, const sim::Frame& frame) {
  const std::size_t first = whole.attractors.size();
  for (const sim::Vec3& at_vx : sim::column<sim::Vec3>(columns, rules::kAttractorPlace))
    whole.attractors.push_back({{sim::worldFromVoxel(frame, at_vx)}});
  // A front has them in an order of its own; where none has begun, all wait.
  const auto& number = sim::column<std::int32_t>(columns, "front_number");
  const auto& fate = sim::column<std::int32_t>(columns, "front_fate");
  const auto& ended = sim::column<std::int32_t>(columns, "front_ended");
  for (std::size_t i = 0; i < number.size(); ++i) {
    SeenAttractor& attractor = whole.attractors.at(first + static_cast<std::size_t>(number[i]));
    attractor.fate = static_cast<rules::Fate>(fate.at(i));
    attractor.ended = ended.at(i);
  }
}

}  // namespace

GrowthGraph growthGraph(const sim::Growth& growth, const sim::Frame& frame) {
  GrowthGraph whole;
  for (const sim::Plant& plant : growth.plants) addPlant(whole, plant.skeleton, frame);
  const std::string prefix = rules::attractorsNamed("");
  std::size_t sets = 0;
  for (const auto& [name, columns] : growth.commons) {
    if (!name.starts_with(prefix)) continue;
    const std::size_t before = whole.attractors.size();
    addAttractors(whole, columns, frame);
    ++sets;
    whole.sets += fmt::format("{}{}, {}", whole.sets.empty() ? "" : "; ", name.substr(prefix.size()),
                              whole.attractors.size() - before);
  }
  if (sets > kSetsNamed) whole.sets = fmt::format("{} in {} sets", whole.attractors.size(), sets);
  return whole;
}

render::PointGraph graphAfter(const GrowthGraph& whole, std::int32_t iterations) {
  render::PointGraph graph;
  std::vector<std::int32_t> number(whole.nodes.size(), -1);
  for (std::size_t i = 0; i < whole.nodes.size(); ++i) {
    const std::int32_t parent = whole.nodes[i].parent;
    if (parent >= 0 && whole.born[i] >= iterations) continue;
    number[i] = static_cast<std::int32_t>(graph.nodes.size());
    graph.nodes.push_back(whole.nodes[i]);
    if (parent >= 0) graph.nodes.back().parent = number[static_cast<std::size_t>(parent)];
  }
  for (const SeenAttractor& attractor : whole.attractors) {
    if (attractor.fate == rules::Fate::waiting || attractor.ended >= iterations)
      graph.waiting.push_back(attractor.point);
    else if (attractor.fate != rules::Fate::taken)
      graph.ended.push_back(attractor.point);
  }
  return graph;
}

}  // namespace espalier::scenes
