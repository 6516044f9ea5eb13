#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/base/error.h"
#include "sim/grow/growth.h"
#include "sim/world/world.h"

namespace espalier::sim {

/// What is wrong with a planting, or with one of its seeds.
struct PlantingFault {
  std::size_t planting;             ///< its number
  std::optional<std::size_t> seed;  ///< of the planting's
  std::string text;
};

/// Plantings that cannot begin to grow: at least one. Says what is wrong with the first.
class PlantingFaults : public InputError {
 public:
  explicit PlantingFaults(std::vector<PlantingFault> faults);
  const std::vector<PlantingFault>& faults() const { return faults_; }

 private:
  std::vector<PlantingFault> faults_;
};

/// Seeds outside of the world or inside something, and those whose key another of the same name has.
std::vector<PlantingFault> seedFaults(const World& world, const std::vector<Planting>& plantings);

}  // namespace espalier::sim
