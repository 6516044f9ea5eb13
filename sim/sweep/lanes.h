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

/// A set of blocks of kRows rows each: bit j is rows kRows * j .. kRows * (j + 1) - 1.
using Blocks = std::uint64_t;
inline constexpr std::size_t kMostBlocks = 63;  ///< that are swept at once

/// Flags of blocks, from bit `first` of a word on.
struct Flags {
  const Blocks* word;
  unsigned first;  ///< < 64
};

/// Words that are read several times, their voxels moved down by 0 .. 63 each time.
struct Read {
  const Word* from;  ///< what word (0, 0) of the result reads; readable for one line more than asked for
  Flags filled;      ///< of the blocks read: which hold anything
  Flags changed;     ///< and which differ from what was read there for the slice before
  bool astride;      ///< what a block reads lies in two
  bool unmoved;      ///< read as it stands too
  std::uint32_t count;
  const std::uint64_t* shifts;  ///< not 0
};

/// Words from line to line, of voxels and of flags.
struct Lines {
  std::size_t words, blocks;
};

/// Lines of a slice, and which of their blocks hold anything: of line w, filled[w].
struct Slice {
  Word* words;
  Blocks* filled;
};

/// period(w, z) becomes the union of all reads, and out(w, z) that of period(w, z) and of `end` (where
/// given), for w < words and `blocks` blocks of rows. `period` must hold what it became for the slice before:
/// where nothing that is read has changed, it is left alone. `filled` is brought up to date, and read: `out`
/// may hold an old slice.
void unite(std::span<const Read> reads, const Read* end, Lines lines, Slice period, Slice out,
           std::size_t words, std::size_t blocks);

/// Which of the first blocks of a line hold anything.
Blocks anythingIn(const Word* line, std::size_t blocks);
/// Which of them differ from another's.
Blocks differing(const Word* line, const Word* other, std::size_t blocks);

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

/// Turns a square of 64 words' bits: bit j of square[i] changes places with bit i of square[j]. Aligned as a
/// vector is, to 64 bytes.
void transpose(Word* square);

/// The vector instructions in use, and all that this processor can run, best first.
std::string level();
std::vector<std::string> levels();
/// Uses one of levels() from now on; for tests and measurements.
void useLevel(const std::string& name);

}  // namespace espalier::sim::lanes
