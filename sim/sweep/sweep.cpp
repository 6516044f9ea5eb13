#include "sim/sweep/sweep.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "sim/base/parallel.h"
#include "sim/sweep/lanes.h"
#include "sim/sweep/sweep_batch.h"

// Everything begins as open, and each batch of directions takes away what it finds blocked.
namespace espalier::sim {
namespace {

using lanes::kRows;
using lanes::Word;

constexpr std::size_t kSummedAtOnce = 24;  // directions whose sweep is worth a pass over the sums
constexpr std::size_t kMostOwnSums = std::size_t{32} << 20;  // that threads may keep for themselves, in all

/// The numbers of the directions that have a weight.
Batch thatCount(const DirectionSet& directions) {
  Batch numbers;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (directions[i].weight > 0) numbers.push_back(i);
  }
  return numbers;
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

/// Where anything is asked for: low_y > high_y if nowhere.
Extent extentOf(const VoxelSet& where) {
  const auto none = [&](int y) {
    const std::size_t next = y + 1 < where.bits().size().y ? where.firstOfRow(y + 1, 0) : where.count();
    return next == where.firstOfRow(y, 0);
  };
  Extent extent{0, where.bits().size().y - 1};
  while (extent.low_y <= extent.high_y && none(extent.low_y)) ++extent.low_y;
  while (extent.low_y <= extent.high_y && none(extent.high_y)) --extent.high_y;
  return extent;
}

/// Calls work(block) for each block of a batch.
template <typename Work>
void sweepBlocks(const BitVolume& occupied, const DirectionSet& directions, const Batch& batch,
                 const Extent& extent, const Work& work) {
  std::vector<const LatticeDirection*> chosen;
  for (const std::size_t i : batch) chosen.push_back(&directions[i]);
  sweepBatch(occupied, chosen, extent, [&](const Band& band) {
    for (int z = band.z0; z < band.z1; z += static_cast<int>(kRows)) {
      work(Block{band.y, z, static_cast<std::size_t>(std::min(static_cast<int>(kRows), band.z1 - z)), band});
    }
  });
}

lanes::Adders addersOf(const DirectionSet& directions, const Batch& batch) {
  std::vector<std::uint16_t> weights;
  for (const std::size_t i : batch) weights.push_back(directions[i].weight);
  return lanes::Adders(weights);
}

/// Lets subtract(sums, adders, block) take what is blocked away from the sums. In small worlds each thread
/// takes its share of the directions into sums of its own, so that none waits for another after each slice.
template <typename Subtract>
void sumUp(const BitVolume& occupied, const DirectionSet& directions, Extent extent,
           std::vector<std::uint16_t>& sums, const Subtract& subtract) {
  const auto sweep = [&](const Batch& numbers, const Extent& within, std::uint16_t* into) {
    for (const Batch& batch : batchesOf(occupied, directions, numbers, kSummedAtOnce)) {
      const lanes::Adders adders = addersOf(directions, batch);
      sweepBlocks(occupied, directions, batch, within,
                  [&](const Block& block) { subtract(into, adders, block); });
    }
  };
  const Batch counting = thatCount(directions);
  const auto threads = static_cast<std::size_t>(threadCount());
  if (!isSmall(occupied) || threads == 1 || threads * sums.size() > kMostOwnSums) {
    sweep(counting, extent, sums.data());
    return;
  }
  extent.shared = false;
  std::vector<std::vector<std::uint16_t>> shares(threads);
  parallelForEach(threads, [&](std::size_t t) {
    Batch dealt;
    for (std::size_t i = t; i < counting.size(); i += threads) dealt.push_back(counting[i]);
    shares[t].resize(sums.size());
    sweep(dealt, extent, shares[t].data());
  });
  parallelFor(sums.size(), [&](std::size_t begin, std::size_t end) {
    for (const auto& share : shares) {
      for (std::size_t i = begin; i < end; ++i) sums[i] = static_cast<std::uint16_t>(sums[i] + share[i]);
    }
  });
}

/// Calls take(w, r, word, number of its first place) for those words of a block in which places lie and
/// anything is blocked, w by w, and begin(w) before those of each w.
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
  ExposureField field{{size, std::vector<std::uint16_t>(voxels, wholeSum(directions))}};
  const auto subtract = [&](std::uint16_t* all, const lanes::Adders& adders, const Block& block) {
    std::array<std::uint16_t, 64 * kRows> blocked;
    for (std::size_t x = 0; x < nx; x += 64) {
      if (!block.anything(x / 64)) continue;
      adders.sums(block.band.blocked.data(), block.at(x / 64), blocked.data());
      for (std::size_t r = 0; r < block.rows; ++r) {
        std::uint16_t* const sums =
            all + field.index({static_cast<int>(x), block.y, block.z + static_cast<int>(r)});
        const std::size_t n = std::min<std::size_t>(64, nx - x);
        for (std::size_t i = 0; i < n; ++i)
          sums[i] = static_cast<std::uint16_t>(sums[i] - blocked[64 * r + i]);
      }
    }
  };
  sumUp(occupied, directions, {0, size.y - 1}, field.values, subtract);
  return field;
}

ExposureField sweepExposure(const BitVolume& occupied, const DirectionSet& directions,
                            std::shared_ptr<const VoxelSet> where) {
  ExposureField field{
      {occupied.size(), std::vector<std::uint16_t>(where->count(), wholeSum(directions)), where}};
  const auto subtract = [&](std::uint16_t* sums, const lanes::Adders& adders, const Block& block) {
    std::array<std::uint16_t, 64 * kRows> blocked;
    forEachAsked(
        *where, block,
        [&](std::size_t w) { adders.sums(block.band.blocked.data(), block.at(w), blocked.data()); },
        [&](std::size_t, std::size_t r, Word asked, std::size_t place) {
          for (; asked != 0; asked &= asked - 1, ++place) {
            sums[place] = static_cast<std::uint16_t>(
                sums[place] - blocked[64 * r + static_cast<std::size_t>(std::countr_zero(asked))]);
          }
        });
  };
  sumUp(occupied, directions, extentOf(*where), field.values, subtract);
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
  // 64 directions by 64 voxels change rows for columns.
  const auto clear = [&](const Batch& batch, const Block& block) {
    forEachAsked(
        *where, block, [](std::size_t) {},
        [&](std::size_t w, std::size_t r, Word asked, std::size_t place) {
          for (std::size_t n = 0; n < batch.size();) {
            const std::size_t column = batch[n] / 64;
            alignas(64) std::array<Word, 64> square{};
            for (; n < batch.size() && batch[n] / 64 == column; ++n)
              square[batch[n] % 64] = block.band.blocked[n][block.at(w) + r];
            lanes::transpose(square.data());
            Word* row = table.bits.data() + place * table.words() + column;
            for (Word left = asked; left != 0; left &= left - 1, row += table.words())
              *row &= ~square[static_cast<std::size_t>(std::countr_zero(left))];
          }
        });
  };
  Batch all(directions.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  Extent extent = extentOf(*where);
  const auto batches = batchesOf(occupied, directions, all, 64);
  const auto sweep = [&](std::size_t b) {
    sweepBlocks(occupied, directions, batches[b], extent,
                [&](const Block& block) { clear(batches[b], block); });
  };
  // Batches whose directions have no word of the table in common can be swept at the same time.
  extent.shared = !isSmall(occupied) ||
                  std::adjacent_find(batches.begin(), batches.end(), [](const Batch& a, const Batch& b) {
                    return a.back() / 64 >= b.front() / 64;
                  }) != batches.end();
  if (extent.shared) {
    for (std::size_t b = 0; b < batches.size(); ++b) sweep(b);
  } else {
    parallelForEach(batches.size(), sweep);
  }
  return table;
}

}  // namespace espalier::sim
