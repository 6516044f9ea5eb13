#include "sim/world/band.h"

#include <algorithm>
#include <functional>
#include <vector>

#include "sim/base/parallel.h"

namespace espalier::sim {
namespace {

using Word = std::uint64_t;

void forEachSlice(const BitVolume& volume, const std::function<void(int)>& work) {
  parallelForEach(static_cast<std::size_t>(volume.size().y),
                  [&](std::size_t y) { work(static_cast<int>(y)); });
}

/// The bits of a row's last data word that lie inside the volume.
Word lastWord(Voxel size) {
  const int rest = size.x % BitVolume::kWordBits;
  return rest == 0 ? ~Word{0} : (Word{1} << rest) - 1;
}

void orRow(Word* out, const Word* in, int words) {
  for (int w = 0; w < words; ++w) out[w] |= in[w];
}

}  // namespace

BitVolume freeVoxels(const World& world) {
  const BitVolume& occupied = world.occupied();
  BitVolume open(occupied.size());
  const int words = occupied.rowWords() - 1;
  forEachSlice(occupied, [&](int y) {
    for (int z = 0; z < occupied.size().z; ++z) {
      for (int w = 0; w < words; ++w)
        open.row(y, z)[w] = ~(occupied.row(y, z)[w] | world.opaque().row(y, z)[w]);
      open.row(y, z)[words - 1] &= lastWord(occupied.size());
    }
  });
  return open;
}

BitVolume freeBand(const World& world, const BitVolume& around, int reach) {
  const BitVolume& occupied = world.occupied();
  const Voxel size = occupied.size();
  const int words = occupied.rowWords() - 1;
  BitVolume near = around;  // grown along x, then z within each slice
  forEachSlice(occupied, [&](int y) {
    for (int z = 0; z < size.z; ++z) {
      Word* const row = near.row(y, z);
      for (int step = 0; step < reach; ++step) {
        Word before = 0;
        for (int w = 0; w < words; ++w) {
          const Word here = row[w], behind = w + 1 < words ? row[w + 1] : 0;
          row[w] = here | (here << 1) | (before >> 63) | (here >> 1) | (behind << 63);
          before = here;
        }
        row[words - 1] &= lastWord(size);
      }
    }
    std::vector<Word> slice(near.row(y, 0), near.row(y, 0) + static_cast<std::ptrdiff_t>(near.rowWords()) *
                                                                 static_cast<std::ptrdiff_t>(size.z));
    for (int z = 0; z < size.z; ++z) {
      for (int from = std::max(0, z - reach); from <= std::min(size.z - 1, z + reach); ++from)
        orRow(near.row(y, z), slice.data() + static_cast<std::ptrdiff_t>(from) * near.rowWords(), words);
    }
  });
  BitVolume band(size);
  forEachSlice(occupied, [&](int y) {
    for (int z = 0; z < size.z; ++z) {
      Word* const out = band.row(y, z);
      for (int from = std::max(0, y - reach); from <= std::min(size.y - 1, y + reach); ++from)
        orRow(out, near.row(from, z), words);
      for (int w = 0; w < words; ++w) out[w] &= ~(occupied.row(y, z)[w] | world.opaque().row(y, z)[w]);
    }
  });
  return band;
}

}  // namespace espalier::sim
