#include "sim/sweep.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <span>

#include "sim/parallel.h"
#include "sim/sense/exposure.h"

namespace espalier::sim {
namespace {

// The hot loops are compiled for several x86 levels; the loader picks the best one that the processor has.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define ESPALIER_HOT __attribute__((target_clones("arch=skylake-avx512", "avx2", "default")))
#else
#define ESPALIER_HOT
#endif

using Word = std::uint64_t;

/// out |= in moved down by `shift` voxels: bit x of out gets bit x + shift of in. |shift| < 64; reads one
/// word before or behind the range.
ESPALIER_HOT void orShifted(Word* __restrict out, const Word* __restrict in, std::size_t words, int shift) {
  if (shift == 0) {
    for (std::size_t w = 0; w < words; ++w) out[w] |= in[w];
  } else if (shift > 0) {
    for (std::size_t w = 0; w < words; ++w) out[w] |= (in[w] >> shift) | (in[w + 1] << (64 - shift));
  } else {
    const Word* const before = in - 1;
    for (std::size_t w = 0; w < words; ++w) out[w] |= (in[w] << -shift) | (before[w] >> (64 + shift));
  }
}

/// For each byte, a mask of eight 16-bit lanes: where the bit is set, all ones.
constexpr auto kLanes = [] {
  std::array<std::array<std::uint16_t, 8>, 256> lanes{};
  for (std::size_t byte = 0; byte < 256; ++byte) {
    for (std::size_t bit = 0; bit < 8; ++bit) lanes[byte][bit] = ((byte >> bit) & 1u) != 0 ? 0xffff : 0;
  }
  return lanes;
}();

/// sums[x] += weight for every set bit.
ESPALIER_HOT void addWhereSet(std::uint16_t* __restrict sums, const Word* __restrict bits, int data_words,
                              std::uint16_t weight) {
  for (int w = 0; w < data_words; ++w, sums += 64) {
    if (bits[w] == 0) continue;  // open sky above: by far the most common word outdoors
    for (int byte = 0; byte < 8; ++byte) {
      const auto& lanes = kLanes[(bits[w] >> (8 * byte)) & 0xffu];
      std::uint16_t* const eight = sums + 8 * byte;
      for (std::size_t i = 0; i < 8; ++i)
        eight[i] = static_cast<std::uint16_t>(eight[i] + (lanes[i] & weight));
    }
  }
}

/// One direction's sweep: the blocked bits of the slices that the slice at hand still needs, in a ring.
class Sweep {
 public:
  Sweep(const BitVolume& occupied, const LatticeDirection& direction)
      : occupied_(occupied),
        direction_(direction),
        slice_words_(static_cast<std::size_t>(occupied.rowWords()) *
                     static_cast<std::size_t>(occupied.size().z)),
        ring_(1 + (slice_words_ + 1) * static_cast<std::size_t>(direction.v.y + 1)) {}

  /// Computes slice y, whose higher ones are done, and adds the weight to the sums of the blocked voxels.
  void run(int y, std::span<std::uint16_t> sums) {
    const int data_words = occupied_.rowWords() - 1;
    const int ny = occupied_.size().y, nz = occupied_.size().z;
    Word* const out = ring(y, 0);
    std::fill_n(out, slice_words_, Word{0});
    for (const Voxel o : direction_.crossed) {
      if (y + o.y < ny) orSlice(y, occupied_.row(y + o.y, 0), o);
    }
    if (y + direction_.v.y < ny) orSlice(y, ring(y + direction_.v.y, 0), direction_.v);
    // Whole slices are shifted at once, which lets bits run over into the zero words between the rows.
    for (int z = 0; z < nz; ++z) ring(y, z)[data_words] = 0;
    for (int z = 0; z < nz; ++z) {
      addWhereSet(sums.data() + static_cast<std::size_t>(z) * static_cast<std::size_t>(data_words) * 64,
                  ring(y, z), data_words, direction_.weight);
    }
  }

 private:
  /// Slice y |= the slice `from` seen by o: row z takes row z + o.z where there is one.
  void orSlice(int y, const Word* from, Voxel o) {
    const int nz = occupied_.size().z, first = std::max(0, -o.z), rows = nz - std::abs(o.z);
    if (rows <= 0) return;
    const auto row_words = static_cast<std::size_t>(occupied_.rowWords());
    orShifted(ring(y, first), from + static_cast<std::size_t>(first + o.z) * row_words,
              static_cast<std::size_t>(rows) * row_words, o.x);
  }

  /// A zero word lies before and behind each slice, so that none reads into another that is being written.
  Word* ring(int y, int z) {
    const auto slot = static_cast<std::size_t>(y % (direction_.v.y + 1));
    return ring_.data() + 1 + slot * (slice_words_ + 1) +
           static_cast<std::size_t>(z) * static_cast<std::size_t>(occupied_.rowWords());
  }

  const BitVolume& occupied_;
  const LatticeDirection& direction_;
  std::size_t slice_words_;
  std::vector<Word> ring_;
};

/// Sums of the weights of the blocked directions, into a whole field.
std::vector<std::uint16_t> blockedWeights(const BitVolume& occupied,
                                          std::span<const LatticeDirection> directions) {
  const Voxel size = occupied.size();
  const auto nx = static_cast<std::size_t>(size.x), nz = static_cast<std::size_t>(size.z);
  const auto padded = static_cast<std::size_t>(occupied.rowWords() - 1) * 64;
  std::vector<std::uint16_t> field(nx * static_cast<std::size_t>(size.y) * nz);
  std::vector<std::uint16_t> slice(padded * nz);
  std::vector<Sweep> sweeps;
  sweeps.reserve(directions.size());
  for (const auto& direction : directions) sweeps.emplace_back(occupied, direction);
  // All directions slice by slice, so that a slice's sums stay in the cache.
  for (int y = size.y - 1; y >= 0; --y) {
    std::fill(slice.begin(), slice.end(), std::uint16_t{0});
    for (Sweep& sweep : sweeps) sweep.run(y, slice);
    for (std::size_t z = 0; z < nz; ++z) {
      std::copy_n(slice.data() + z * padded, nx, field.data() + (static_cast<std::size_t>(y) * nz + z) * nx);
    }
  }
  return field;
}

}  // namespace

ExposureField sweepExposure(const BitVolume& occupied, const DirectionSet& directions) {
  int total = 0;
  for (const auto& direction : directions) total += direction.weight;
  const auto groups =
      std::clamp<std::size_t>(static_cast<std::size_t>(threadCount()), 1, directions.size() / 4 + 1);
  std::vector<std::vector<std::uint16_t>> blocked(groups);
  parallelFor(groups, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
      const std::size_t first = directions.size() * g / groups, last = directions.size() * (g + 1) / groups;
      blocked[g] = blockedWeights(occupied, std::span(directions).subspan(first, last - first));
    }
  });
  ExposureField field{occupied.size(), std::move(blocked[0])};
  parallelFor(field.sums.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = 1; g < groups; ++g) {
      for (std::size_t i = begin; i < end; ++i)
        field.sums[i] = static_cast<std::uint16_t>(field.sums[i] + blocked[g][i]);
    }
    for (std::size_t i = begin; i < end; ++i)
      field.sums[i] = static_cast<std::uint16_t>(total - field.sums[i]);
  });
  return field;
}

namespace {

/// Calls work(number, voxel) for each voxel of a set.
void forEachPlace(const VoxelSet& where, const std::function<void(std::size_t, Voxel)>& work) {
  const auto voxels = where.voxels();
  parallelFor(voxels.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) work(i, voxels[i]);
  });
}

}  // namespace

ExposureField sweepExposure(const BitVolume& occupied, const DirectionSet& directions,
                            std::shared_ptr<const VoxelSet> where) {
  ExposureField field{occupied.size(), std::vector<std::uint16_t>(where->count()), where};
  forEachPlace(*where, [&](std::size_t i, Voxel p) { field.sums[i] = lookOut(occupied, p, directions).sum; });
  return field;
}

OpenTable sweepOpen(const BitVolume& occupied, const DirectionSet& directions,
                    std::shared_ptr<const VoxelSet> where) {
  OpenTable table{where, directions.size(), {}};
  table.bits.resize(where->count() * table.words());
  forEachPlace(*where, [&](std::size_t i, Voxel p) {
    for (std::size_t d = 0; d < directions.size(); ++d) {
      if (reachesEdge(occupied, p, directions[d]))
        table.bits[i * table.words() + d / 64] |= std::uint64_t{1} << (d % 64);
    }
  });
  return table;
}

}  // namespace espalier::sim
