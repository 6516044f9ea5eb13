#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sim/grow/process.h"

/// Who is asked when in diffusion: its memory.
namespace espalier::rules {

/// The element of a site's number; none of number 0, which is a seed.
inline constexpr std::uint32_t kSeedSite = 0;
inline std::size_t elementOf(std::uint32_t number) {
  return static_cast<std::size_t>(number) - 1;
}

void beginLaying(const sim::StandView& stand, sim::Columns& memory);

/// The sites that are asked together next: of those that still wait for their turn in this round, or else in
/// a new one, such as lie more than `apart_vx` from each other. `placeOf`: where light is sensed at a site.
std::vector<sim::Site> dueOfLaying(const sim::StandView& stand, sim::Columns& memory, double apart_vx,
                                   const std::function<sim::Vec3(const sim::Site&)>& placeOf);

/// Those that grew stand in the front with what they grew, as do those that rest; the others leave it.
void settleLaying(std::span<const sim::Verdict> verdicts, sim::Columns& memory);

/// Nobody is asked any more.
void endLaying(sim::Columns& memory);

/// Whether this iteration has more rounds, of so many, or more turns.
bool layingGoesOn(const sim::Columns& memory, int rounds);

std::size_t countLaying(const sim::Columns& memory);
/// Rounds that were begun since growth began: what random numbers follow from.
std::uint32_t roundOf(const sim::Columns& memory);

}  // namespace espalier::rules
