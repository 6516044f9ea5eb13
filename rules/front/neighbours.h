#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "rules/front/front.h"

/// Internal to the wing: relative neighbours of attractors, as rules/front/front.h defines them. They are
/// kept from iteration to iteration: what is none never becomes one, as nodes are only added.
namespace espalier::rules {

/// New nodes, or older ones that attractors came after: who of them are relative neighbours now, who of the
/// others no longer, who has arrived, and which attractors end by it. `parents`: from which each was sent.
/// Parallel inside.
void meetNeighbours(Front& front, std::span<const std::int32_t> fresh, std::span<const std::int32_t> parents,
                    const OrderRules& rules);

/// A node lets go of an attractor, by its number; nothing where it has not got it.
void letGoOfNeighbour(Front& front, std::int32_t node, std::int32_t attractor, int iteration);

/// What pulls a node, by the attractors' numbers, ascending.
std::vector<std::int32_t> pulling(const Front& front, std::int32_t node);

/// The nearest of those, by its index; kNobody where nothing pulls. Equally near ones by their places.
std::int32_t nearestPulling(const Front& front, std::int32_t node);

}  // namespace espalier::rules
