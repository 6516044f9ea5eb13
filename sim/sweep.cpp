#include "sim/sweep.h"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>

#include "sim/lanes.h"
#include "sim/sweep_batch.h"

// Everything begins as open, and each batch of directions takes away what it finds blocked.
namespace espalier::sim {
namespace {

using lanes::kRows;
using lanes::Word;

constexpr std::size_t kSummedAtOnce = 24;  // directions whose sweep is worth a pass over the sums

DirectionSet thatCount(const DirectionSet& directions) {
  DirectionSet counting;
  std::copy_if(directions.begin(), directions.end(), std::back_inserter(counting),
               [](const LatticeDirection& d) { return d.weight > 0; });
  return counting;
}

std::uint16_t wholeSum(const DirectionSet& directions) {
  int sum = 0;
  for (const LatticeDirection& direction : directions) sum += direction.weight;
  return static_cast<std::uint16_t>(sum);
}

/// Words of up to eight rows of a band.
struct Block {
  int y, z;
  std::size_t rows;
  const Band& band;

  /// Where word (w, z) lies, from word (0, 0).
  std::size_t at(std::size_t w) const { return w * band.line + static_cast<std::size_t>(z); }
  /// Whether any direction is blocked anywhere in the words of this w.
  bool anything(std::size_t w) const {
    return ((band.filled[w] >> (static_cast<std::size_t>(z - band.z0) / kRows)) & 1u) != 0;
  }
};

/// Those in which anything is asked for: low > high if there are none.
struct Slices {
  int low, high;
};

Slices slicesOf(const VoxelSet& where) {
  const auto none = [&](int y) {
    const std::size_t next = y + 1 < where.bits().size().y ? where.firstOfRow(y + 1, 0) : where.count();
    return next == where.firstOfRow(y, 0);
  };
  Slices slices{0, where.bits().size().y - 1};
  while (slices.low <= slices.high && none(slices.low)) ++slices.low;
  while (slices.low <= slices.high && none(slices.high)) --slices.high;
  return slices;
}

/// Calls prepare(numbers of its directions) for each batch, and what that returns for each block.
template <typename Prepare>
void sweepBlocks(const BitVolume& occupied, const DirectionSet& directions, std::size_t batch_size,
                 Slices slices, const Prepare& prepare) {
  forEachBatch(occupied, directions, batch_size, [&](std::span<const std::size_t> numbers) {
    std::vector<const LatticeDirection*> batch;
    for (const std::size_t i : numbers) batch.push_back(&directions[i]);
    const auto work = prepare(numbers);
    sweepBatch(occupied, batch, slices.low, slices.high, [&](const Band& band) {
      for (int z = band.z0; z < band.z1; z += static_cast<int>(kRows)) {
        work({band.y, z, static_cast<std::size_t>(std::min(static_cast<int>(kRows), band.z1 - z)), band});
      }
    });
  });
}

lanes::Adders addersOf(const DirectionSet& directions, std::span<const std::size_t> numbers) {
  std::vector<std::uint16_t> weights;
  for (const std::size_t i : numbers) weights.push_back(directions[i].weight);
  return lanes::Adders(weights);
}

/// Calls take(w, r, word) for the words of a block with places in them, w by w, and `begin(w)` before those
/// of a w.
template <typename Begin, typename Take>
void forEachAsked(const VoxelSet& where, const Block& block, const Begin& begin, const Take& take) {
  const BitVolume& bits = where.bits();
  const int words = bits.rowWords() - 1;
  std::array<const Word*, kRows> rows{};
  std::array<std::size_t, kRows> next{};
  for (std::size_t r = 0; r < block.rows; ++r) {
    const int z = block.z + static_cast<int>(r);
    rows[r] = bits.row(block.y, z);
    next[r] = where.firstOfRow(block.y, z);
  }
  for (int w = 0; w < words; ++w) {
    const bool anything = block.anything(static_cast<std::size_t>(w));
    bool begun = false;
    for (std::size_t r = 0; r < block.rows; ++r) {
      const Word asked = rows[r][w];
      if (asked == 0) continue;
      if (anything) {
        if (!begun) begin(static_cast<std::size_t>(w));
        begun = true;
        take(static_cast<std::size_t>(w), r, asked, next[r]);
      }
      next[r] += static_cast<std::size_t>(std::popcount(asked));
    }
  }
}

}  // namespace

ExposureField sweepExposure(const BitVolume& occupied, const DirectionSet& directions) {
  const Voxel size = occupied.size();
  const auto nx = static_cast<std::size_t>(size.x);
  const std::size_t voxels = nx * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
  ExposureField field{size, std::vector<std::uint16_t>(voxels, wholeSum(directions))};
  const DirectionSet counting = thatCount(directions);
  sweepBlocks(occupied, counting, kSummedAtOnce, {0, size.y - 1}, [&](std::span<const std::size_t> numbers) {
    return [&, adders = addersOf(counting, numbers)](const Block& block) {
      std::array<std::uint16_t, 64 * kRows> blocked;
      for (std::size_t x = 0; x < nx; x += 64) {
        if (!block.anything(x / 64)) continue;
        adders.sums(block.band.blocked.data(), block.at(x / 64), blocked.data());
        for (std::size_t r = 0; r < block.rows; ++r) {
          std::uint16_t* const sums =
              field.sums.data() + field.index({static_cast<int>(x), block.y, block.z + static_cast<int>(r)});
          const std::size_t n = std::min<std::size_t>(64, nx - x);
          for (std::size_t i = 0; i < n; ++i)
            sums[i] = static_cast<std::uint16_t>(sums[i] - blocked[64 * r + i]);
        }
      }
    };
  });
  return field;
}

ExposureField sweepExposure(const BitVolume& occupied, const DirectionSet& directions,
                            std::shared_ptr<const VoxelSet> where) {
  ExposureField field{occupied.size(), std::vector<std::uint16_t>(where->count(), wholeSum(directions)),
                      where};
  const DirectionSet counting = thatCount(directions);
  sweepBlocks(occupied, counting, kSummedAtOnce, slicesOf(*where), [&](std::span<const std::size_t> numbers) {
    return [&, adders = addersOf(counting, numbers)](const Block& block) {
      std::array<std::uint16_t, 64 * kRows> blocked;
      forEachAsked(
          *where, block,
          [&](std::size_t w) { adders.sums(block.band.blocked.data(), block.at(w), blocked.data()); },
          [&](std::size_t, std::size_t r, Word asked, std::size_t place) {
            for (; asked != 0; asked &= asked - 1, ++place) {
              field.sums[place] = static_cast<std::uint16_t>(
                  field.sums[place] - blocked[64 * r + static_cast<std::size_t>(std::countr_zero(asked))]);
            }
          });
    };
  });
  return field;
}

OpenTable sweepOpen(const BitVolume& occupied, const DirectionSet& directions,
                    std::shared_ptr<const VoxelSet> where) {
  OpenTable table{where, directions.size(), {}};
  table.bits.resize(where->count() * table.words());
  for (std::size_t i = 0; i < table.bits.size(); ++i) {
    const std::size_t left = directions.size() - 64 * (i % table.words());
    table.bits[i] = left >= 64 ? ~Word{0} : (Word{1} << left) - 1;
  }
  sweepBlocks(occupied, directions, 64, slicesOf(*where), [&](std::span<const std::size_t> numbers) {
    return [&, numbers](const Block& block) {
      forEachAsked(
          *where, block, [](std::size_t) {},
          [&](std::size_t w, std::size_t r, Word asked, std::size_t place) {
            const std::size_t at = block.at(w) + r;
            for (std::size_t n = 0;
                 n < numbers.size();) {  // 64 directions by 64 voxels change rows for columns
              const std::size_t column = numbers[n] / 64;
              std::array<Word, 64> square{};
              for (; n < numbers.size() && numbers[n] / 64 == column; ++n)
                square[numbers[n] % 64] = block.band.blocked[n][at];
              lanes::transpose(square.data());
              Word* row = table.bits.data() + place * table.words() + column;
              for (Word left = asked; left != 0; left &= left - 1, row += table.words())
                *row &= ~square[static_cast<std::size_t>(std::countr_zero(left))];
            }
          });
    };
  });
  return table;
}

}  // namespace espalier::sim
