#include "sim/sweep/sweep_batch.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>

#include "sim/base/parallel.h"
#include "sim/sweep/slice_ring.h"

// A world is swept slice by slice, all directions of a batch at once. Each direction keeps the blocked bits
// of the last slices that it still needs in a ring, and so does the world its own bits, laid out anew for the
// vectors. A slice is cut into bands of rows: the threads' work, and as much as stays in a core's cache until
// the bits of all directions have been counted there. Where nothing stands and nothing is blocked, nothing is
// done.
namespace espalier::sim {
namespace {

using lanes::Blocks;
using lanes::kRows;
using lanes::Word;

constexpr std::size_t kCacheWords = std::size_t{48}
                                    << 10;  // of blocked bits in a band: less than a core's cache
constexpr std::size_t kRingBytes = std::size_t{1} << 20;  // of a batch: what a core's own cache holds
constexpr std::size_t kMostReads = 3 * (kLongestComponent + 1) + 1;

SliceLayout layoutFor(const BitVolume& occupied, std::span<const LatticeDirection* const> batch) {
  std::size_t across = 0;
  for (const auto* d : batch) across = std::max(across, static_cast<std::size_t>(std::abs(d->v.z)));
  return {static_cast<std::size_t>(occupied.rowWords()) - 1,
          (static_cast<std::size_t>(occupied.size().z) + kRows - 1) / kRows, (across / kRows + 2) * kRows};
}

int slotsFor(const BitVolume& occupied, Voxel v) {
  return std::min(std::abs(v.y), occupied.size().y - 1) + 1;
}

/// The world's last slices, and which of their blocks differ from those of the slice before.
struct WorldRing {
  WorldRing(const SliceLayout& layout, int slots) : slices(layout, slots), changed(layout, slots) {}
  SliceRing slices;
  BlockFlags changed;
  int last_change = 0;  ///< the last slice that differs from the one before, or the first that is swept
};

/// Flags of the blocks of a band, for each w: as they are now, and as they were.
struct BandFlags {
  explicit BandFlags(std::size_t words) : now(words), before(words) {}
  std::vector<Blocks> now, before;

  void fetch(const BlockFlags& flags, int slice, std::size_t first, std::size_t count) {
    for (std::size_t w = 0; w < now.size(); ++w) now[w] = before[w] = flags.get(slice, w, first, count);
  }
  void store(BlockFlags& flags, int slice, std::size_t first) const {
    for (std::size_t w = 0; w < now.size(); ++w) flags.flip(slice, w, first, now[w] ^ before[w]);
  }
};

/// One direction: what it reads, and what it has found blocked.
class Sweep {
 public:
  Sweep(const BitVolume& occupied, const LatticeDirection& direction, const SliceLayout& layout)
      : v_(direction.v),
        rows_(occupied.size().z),
        layout_(layout),
        ring_(layout, slotsFor(occupied, direction.v)),
        period_(layout, 1) {
    for (const Voxel o : direction.crossed) {
      const Part part{std::abs(o.y), o.x >> 6, o.z, static_cast<std::uint32_t>(shifts_.size()), 0, false};
      if (parts_.empty() || !parts_.back().sameWords(part)) parts_.push_back(part);
      if ((o.x & 63) == 0) {
        parts_.back().unmoved = true;
      } else {
        shifts_.push_back(static_cast<std::uint64_t>(o.x & 63));
        ++parts_.back().count;
      }
    }
    end_ = parts_.back();
    end_.first += end_.unmoved ? 0 : end_.count - 1;
    end_.count = end_.unmoved ? 0 : 1;
  }

  bool level() const { return v_.y == 0; }
  const SliceRing& blocked() const { return ring_; }

  /// Some blocks of rows of a slice. Afterwards blocked.now[w] says in which of them anything is blocked.
  void run(const WorldRing& world, int slice, std::size_t first, std::size_t count, BandFlags& period,
           BandFlags& blocked) {
    Reads reads;
    // Where walls go straight up, what a period's parts block stays.
    const bool same = world.last_change < slice - parts_.back().ahead;
    const std::size_t n = same ? 0 : gatherParts(world, slice, first, reads);
    if (endsInside(slice)) reads[n] = readOfEnd(slice, first);
    const lanes::Read* const end = endsInside(slice) ? &reads[n] : nullptr;
    period.fetch(period_.filled(), 0, first, count);
    blocked.fetch(ring_.filled(), slice, first, count);
    lanes::unite(std::span(reads).first(n), end, {layout_.line(), layout_.flagLine()},
                 {period_.slice(0) + first * kRows, period.now.data()},
                 {ring_.slice(slice) + first * kRows, blocked.now.data()}, layout_.words, count);
    period.store(period_.filled(), 0, first);
    blocked.store(ring_.filled(), slice, first);
  }

  /// A whole slice of a direction that stays in it, word by word: they depend on each other.
  void runLevel(const WorldRing& world, int slice) {
    const std::size_t line = layout_.line();
    Word* const out = ring_.slice(slice);
    Reads reads;
    const std::size_t n = gatherParts(world, slice, 0, reads) + 1;
    reads[n - 1] = readOfEnd(slice, 0);
    for (int i = 0; i < rows_; ++i) {
      const auto z = static_cast<std::size_t>(v_.z > 0 ? rows_ - 1 - i : i);
      if (v_.z == 0) {
        runAlongRow(world.slices.slice(slice) + z, out + z);
        continue;
      }
      for (std::size_t at = z; at < z + layout_.words * line; at += line) {
        Word blocked = 0;
        for (const lanes::Read& read : std::span(reads).first(n)) {
          if (read.unmoved) blocked |= read.from[at];
          for (std::uint32_t s = 0; s < read.count; ++s)
            blocked |= (read.from[at] >> read.shifts[s]) | (read.from[at + line] << (64 - read.shifts[s]));
        }
        out[at] = blocked;
      }
    }
    for (std::size_t w = 0; w < layout_.words; ++w) ring_.look(slice, w);
  }

 private:
  /// What is read of one row, from one word on.
  struct Part {
    int ahead = 0;  // slices
    int words = 0, rows = 0;
    std::uint32_t first = 0, count = 0;  // in shifts_
    bool unmoved = false;
    bool sameWords(const Part& o) const { return ahead == o.ahead && words == o.words && rows == o.rows; }
  };

  using Reads = std::array<lanes::Read, kMostReads>;

  bool endsInside(int slice) const { return end_.ahead <= slice; }

  /// What a slice's blocks from `first` on read of those ahead that lie in the world.
  std::size_t gatherParts(const WorldRing& world, int slice, std::size_t first, Reads& reads) const {
    std::size_t n = 0;
    for (; n < parts_.size() && parts_[n].ahead <= slice; ++n)
      reads[n] = readOf(parts_[n], world.slices, world.changed, slice, first);
    return n;
  }

  /// What the period's end sees, if all of it lies in the world: a ray that has left does not come back.
  lanes::Read readOfEnd(int slice, std::size_t first) const {
    return readOf(end_, ring_, ring_.filled(), slice, first);
  }

  lanes::Read readOf(const Part& part, const SliceRing& source, const BlockFlags& changed, int slice,
                     std::size_t first) const {
    const int there = slice - part.ahead;
    const auto line = static_cast<std::ptrdiff_t>(layout_.line());
    const auto flags = [&](const BlockFlags& all) {
      const auto [word, bit] = all.from(there, static_cast<std::ptrdiff_t>(first) + (part.rows >> 3));
      return lanes::Flags{word + part.words * static_cast<std::ptrdiff_t>(layout_.flagLine()), bit};
    };
    return {source.slice(there) + part.words * line + part.rows + static_cast<std::ptrdiff_t>(first * kRows),
            flags(source.filled()),
            flags(changed),
            part.rows % 8 != 0,
            part.unmoved,
            part.count,
            shifts_.data() + part.first};
  }

  /// Along x a row depends on itself.
  void runAlongRow(const Word* in, Word* out) const {
    const auto line = static_cast<std::ptrdiff_t>(layout_.line()),
               words = static_cast<std::ptrdiff_t>(layout_.words);
    Word before = 0;  // all ones once something has been met
    for (std::ptrdiff_t i = 0; i < words; ++i) {
      const std::ptrdiff_t at = (v_.x > 0 ? words - 1 - i : i) * line;
      Word met = in[at];
      for (int step = 1; step < 64; step *= 2) met |= v_.x > 0 ? met >> step : met << step;
      met |= before;
      out[at] = v_.x > 0 ? (met >> 1) | (before << 63) : (met << 1) | (before & 1u);
      before = (met & (v_.x > 0 ? Word{1} : Word{1} << 63)) != 0 ? ~Word{0} : Word{0};
    }
  }

  Voxel v_;
  int rows_;
  SliceLayout layout_;
  std::vector<Part> parts_;  // in the order of the ray
  Part end_;                 // the last voxel, of which what it sees is read
  std::vector<std::uint64_t> shifts_;
  SliceRing ring_;
  SliceRing period_;  // what the parts of the last slice block
};

/// Brings a slice of the world into its ring.
void layOut(const BitVolume& occupied, int y, const SliceLayout& layout, WorldRing& world, int slice,
            bool shared) {
  const std::size_t lines_at_once = std::max<std::size_t>(1, 8192 / (layout.blocks * kRows));
  const auto copy = [&](std::size_t begin, std::size_t end) {
    for (std::size_t w = begin; w < end; ++w) {
      Word* const line = world.slices.slice(slice) + w * layout.line();
      for (int z = 0; z < occupied.size().z; ++z) line[z] = occupied.row(y, z)[w];
      world.slices.look(slice, w);
      const Word* const before = world.slices.slice(slice + world.slices.slots() - 1) + w * layout.line();
      for (std::size_t first = 0; first < layout.blocks; first += lanes::kMostBlocks) {
        const std::size_t count = std::min(lanes::kMostBlocks, layout.blocks - first);
        world.changed.flip(slice, w, first,
                           world.changed.get(slice, w, first, count) ^
                               lanes::differing(line + first * kRows, before + first * kRows, count));
      }
    }
  };
  shared ? parallelFor(layout.words, lines_at_once, copy) : copy(0, layout.words);
}

bool sameSlices(const BitVolume& occupied, int y, int other) {
  const std::ptrdiff_t words = static_cast<std::ptrdiff_t>(occupied.rowWords()) * occupied.size().z;
  const Word* const first = occupied.row(y, 0);
  return std::equal(first, first + words, occupied.row(other, 0));
}

bool anything(const BitVolume& occupied, int y) {
  const Word* const first = occupied.row(y, 0);
  return std::any_of(first, first + static_cast<std::ptrdiff_t>(occupied.rowWords()) * occupied.size().z,
                     [](Word word) { return word != 0; });
}

}  // namespace

void sweepBatch(const BitVolume& occupied, std::span<const LatticeDirection* const> batch,
                const Extent& extent, const std::function<void(const Band&)>& count) {
  const Voxel size = occupied.size();
  const bool up = std::all_of(batch.begin(), batch.end(), [](const auto* d) { return d->v.y >= 0; });
  const auto yOf = [&](int slice) { return up ? size.y - 1 - slice : slice; };
  int begin = 0;
  while (begin < size.y && !anything(occupied, yOf(begin))) ++begin;

  const SliceLayout layout = layoutFor(occupied, batch);
  std::vector<Sweep> sweeps;
  std::vector<Sweep*> level;
  sweeps.reserve(batch.size());
  int slots = 2;  // a slice and the one before
  for (const LatticeDirection* direction : batch) {
    sweeps.emplace_back(occupied, *direction, layout);
    if (sweeps.back().level()) level.push_back(&sweeps.back());
    slots = std::max(slots, slotsFor(occupied, direction->v));
  }
  WorldRing world(layout, slots);
  const auto threads = extent.shared ? static_cast<std::size_t>(threadCount()) : 1;
  const std::size_t shared = std::min(lanes::kMostBlocks, (layout.blocks + threads - 1) / threads);
  const std::size_t blocks =
      std::clamp<std::size_t>(kCacheWords / (layout.words * batch.size() * kRows), 1, shared);
  const std::size_t bands = (layout.blocks + blocks - 1) / blocks;
  const int end = up ? size.y - extent.low_y : extent.high_y + 1;
  for (int slice = begin; slice < end; ++slice) {
    layOut(occupied, yOf(slice), layout, world, slice, extent.shared);
    if (slice == begin || !sameSlices(occupied, yOf(slice), yOf(slice - 1))) world.last_change = slice;
    parallelForEach(level.size(), [&](std::size_t i) { level[i]->runLevel(world, slice); });
    const auto band = [&](std::size_t b) {
      const std::size_t first = b * blocks, n = std::min(blocks, layout.blocks - first);
      std::vector<const Word*> blocked;
      blocked.reserve(sweeps.size());
      std::vector<Blocks> filled(layout.words);
      BandFlags period(layout.words), of_one(layout.words);
      for (Sweep& sweep : sweeps) {
        if (sweep.level()) {
          of_one.fetch(sweep.blocked().filled(), slice, first, n);
        } else {
          sweep.run(world, slice, first, n, period, of_one);
        }
        blocked.push_back(sweep.blocked().slice(slice));
        for (std::size_t w = 0; w < layout.words; ++w) filled[w] |= of_one.now[w];
      }
      if (yOf(slice) < extent.low_y || yOf(slice) > extent.high_y) return;
      const auto row = [&](std::size_t block) { return std::min(size.z, static_cast<int>(block * kRows)); };
      count({yOf(slice), row(first), row(first + n), blocked, layout.line(), filled});
    };
    if (extent.shared) {
      parallelForEach(bands, band);
    } else {
      for (std::size_t b = 0; b < bands; ++b) band(b);
    }
  }
}

bool isSmall(const BitVolume& occupied) {
  constexpr std::size_t kSmallSlice = std::size_t{64} << 10;  // bytes
  return static_cast<std::size_t>(occupied.rowWords()) * static_cast<std::size_t>(occupied.size().z) *
             sizeof(Word) <
         kSmallSlice;
}

std::vector<Batch> batchesOf(const BitVolume& occupied, const DirectionSet& directions, const Batch& numbers,
                             std::size_t least) {
  std::vector<Batch> batches;
  for (const bool up : {true, false}) {
    Batch batch;
    std::size_t bytes = 0;
    for (const std::size_t i : numbers) {
      if ((directions[i].v.y >= 0) != up) continue;
      const std::array<const LatticeDirection*, 1> alone{&directions[i]};
      batch.push_back(i);
      bytes += layoutFor(occupied, alone).slice() * sizeof(Word) *
               static_cast<std::size_t>(slotsFor(occupied, directions[i].v));
      if (bytes >= kRingBytes && batch.size() >= least) {
        batches.push_back(std::move(batch));
        batch.clear();
        bytes = 0;
      }
    }
    if (!batch.empty()) batches.push_back(std::move(batch));
  }
  return batches;
}

}  // namespace espalier::sim
