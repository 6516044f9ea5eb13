#pragma once
// Internal to the room: loops over many voxels' bits at once, compiled for every vector width that the
// processor may have and chosen when the program runs.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace espalier::sim::lanes {

using Word = std::uint64_t;

/// Voxels' bits as the loops like them: word (w, z) holds voxels 64 w .. 64 w + 63 of row z, and words of one
/// w and successive z lie side by side, so that a vector holds a word of each of eight rows and a shift along
/// x stays in its lanes. `line` words lie between (w, z) and (w + 1, z).
inline constexpr std::size_t kRows = 8;

/// Words that are read several times, their voxels moved down by 0 .. 63 each time.
struct Read {
  const Word* from;  ///< what word (0, 0) of the result reads; readable for one line more than asked for
  const std::uint64_t* shifts;  ///< not 0
  std::uint32_t count;
  bool unmoved;  ///< read as it stands too
};

/// out(w, z) = the union of all reads for w < words and z0 <= z < z1, both multiples of kRows. `out` is none
/// of what is read.
void unite(std::span<const Read> reads, std::size_t line, Word* out, std::size_t words, std::size_t z0,
           std::size_t z1);

/// Weighted counts by carry-save adders: the bits of the weights say which adders a direction goes through.
class Adders {
 public:
  /// Weights must add up to less than 65,536.
  explicit Adders(std::span<const std::uint16_t> weights);

  /// sums[64 * r + i] = the sum of the weights of the inputs whose word at[r] has bit i set, for kRows words.
  void sums(const Word* const* inputs, std::size_t at, std::uint16_t* sums) const;

 private:
  std::vector<std::uint32_t> inputs_;          // numbers, plane by plane
  std::vector<std::uint32_t> first_of_plane_;  // in inputs_; one more than there are planes
};

/// Turns a square of bits: bit j of square[i] changes places with bit i of square[j].
void transpose(Word square[64]);

/// The vector instructions in use, and all that this processor can run, best first.
std::string level();
std::vector<std::string> levels();
/// Uses one of levels() from now on; for tests and measurements.
void useLevel(const std::string& name);

}  // namespace espalier::sim::lanes
