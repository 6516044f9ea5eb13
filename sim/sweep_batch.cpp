#include "sim/sweep_batch.h"

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "sim/parallel.h"

// A world is swept slice by slice, all directions of a batch at once. Each direction keeps the blocked bits
// of the last slices that it still needs in a ring, and so does the world its own bits, laid out anew for the
// vectors. A slice is cut into bands of rows: the threads' work, and as much as stays in a core's cache until
// the bits of all directions have been counted there.
namespace espalier::sim {
namespace {

using lanes::kRows;
using lanes::Word;

constexpr std::size_t kCacheWords = std::size_t{48}
                                    << 10;  // of blocked bits in a band: less than a core's cache
constexpr std::size_t kLeastRingBytes = std::size_t{256} << 20;

std::size_t roundedUp(std::size_t n) {
  return (n + kRows - 1) / kRows * kRows;
}

/// How a slice lies in memory: lines of the words of one w, each behind enough zeros for a ray that looks
/// beyond the first row or, from the line before, beyond the last; a line of zeros on either side of them.
struct Layout {
  std::size_t words;  // along x
  std::size_t rows;   // rounded up
  std::size_t pad;
  std::size_t line() const { return pad + rows; }
  std::size_t slice() const { return (words + 2) * line() + pad; }

  Layout(const BitVolume& occupied, std::span<const LatticeDirection* const> batch)
      : words(static_cast<std::size_t>(occupied.rowWords()) - 1),
        rows(roundedUp(static_cast<std::size_t>(occupied.size().z))),
        pad(kRows) {
    for (const auto* d : batch)
      pad = std::max(pad, roundedUp(static_cast<std::size_t>(std::abs(d->v.z)) + kRows));
  }
};

/// The last few slices, in the order of the sweep.
class Ring {
 public:
  Ring(const Layout& layout, int slots)
      : layout_(layout),
        slots_(slots),
        words_(hwy::AllocateAligned<Word>(layout.slice() * static_cast<std::size_t>(slots))) {
    std::fill_n(words_.get(), layout.slice() * static_cast<std::size_t>(slots), Word{0});
  }
  /// Word (0, 0) of a slice.
  Word* slice(int done) const {
    return words_.get() + static_cast<std::size_t>(done % slots_) * layout_.slice() + layout_.line() +
           layout_.pad;
  }

 private:
  Layout layout_;
  int slots_;
  hwy::AlignedFreeUniquePtr<Word[]> words_;
};

int slotsFor(const BitVolume& occupied, Voxel v) {
  return std::min(std::abs(v.y), occupied.size().y - 1) + 1;
}

/// One direction: what it reads, and what it has found blocked.
class Sweep {
 public:
  Sweep(const BitVolume& occupied, const LatticeDirection& direction, const Layout& layout)
      : v_(direction.v),
        rows_(occupied.size().z),
        layout_(layout),
        ring_(layout, slotsFor(occupied, direction.v)) {
    const auto line = static_cast<std::ptrdiff_t>(layout.line());
    for (const Voxel o : direction.crossed) {
      const Part part{std::abs(o.y), (o.x >> 6) * line + o.z, static_cast<std::uint32_t>(shifts_.size()), 0,
                      false};
      if (parts_.empty() || parts_.back().up != part.up || parts_.back().offset != part.offset)
        parts_.push_back(part);
      if ((o.x & 63) == 0) {
        parts_.back().unmoved = true;
      } else {
        shifts_.push_back(static_cast<std::uint64_t>(o.x & 63));
        ++parts_.back().count;
      }
    }
  }

  bool level() const { return v_.y == 0; }
  const Word* blocked(int done) const { return ring_.slice(done); }

  /// Rows z0 <= z < z1 of a slice.
  void run(const Ring& occupied, int done, std::size_t z0, std::size_t z1) {
    Reads reads;
    lanes::unite(gather(occupied, done, reads), layout_.line(), ring_.slice(done), layout_.words, z0, z1);
  }

  /// A whole slice of a direction that stays in it, word by word: they depend on each other.
  void runLevel(const Ring& occupied, int done) {
    Reads reads;
    const auto all = gather(occupied, done, reads);
    const std::size_t line = layout_.line();
    Word* const out = ring_.slice(done);
    if (v_.z == 0) {  // along a row
      for (std::size_t z = 0; z < static_cast<std::size_t>(rows_); ++z)
        runAlongRow(occupied.slice(done) + z, out + z);
      return;
    }
    for (int i = 0; i < rows_; ++i) {
      const auto z = static_cast<std::size_t>(v_.z > 0 ? rows_ - 1 - i : i);
      for (std::size_t at = z; at < z + layout_.words * line; at += line) {
        Word blocked = 0;
        for (const lanes::Read& read : all) {
          if (read.unmoved) blocked |= read.from[at];
          for (std::uint32_t s = 0; s < read.count; ++s)
            blocked |= (read.from[at] >> read.shifts[s]) | (read.from[at + line] << (64 - read.shifts[s]));
        }
        out[at] = blocked;
      }
    }
  }

 private:
  /// What is read of one row, from one word on.
  struct Part {
    int up;  // slices ahead
    std::ptrdiff_t offset;
    std::uint32_t first, count;  // in shifts_
    bool unmoved;
  };
  using Reads = std::array<lanes::Read, 3 * (kLongestComponent + 1)>;

  /// What a slice reads of those ahead that lie in the world: a ray that has left does not come back.
  std::span<const lanes::Read> gather(const Ring& occupied, int done, Reads& reads) const {
    std::size_t n = 0;
    for (const Part& part : parts_) {
      if (part.up > done) return std::span(reads).first(n);
      reads[n++] = {occupied.slice(done - part.up) + part.offset, shifts_.data() + part.first, part.count,
                    part.unmoved};
    }
    const Part& end = parts_.back();  // and what is seen from the period's end
    reads[n++] = {ring_.slice(done - end.up) + end.offset,
                  shifts_.data() + end.first + end.count - !end.unmoved, end.unmoved ? 0u : 1u, end.unmoved};
    return std::span(reads).first(n);
  }

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
  Layout layout_;
  std::vector<Part> parts_;
  std::vector<std::uint64_t> shifts_;
  Ring ring_;
};

void layOut(const BitVolume& occupied, int y, const Layout& layout, Word* slice) {
  for (int z = 0; z < occupied.size().z; ++z) {
    const Word* const row = occupied.row(y, z);
    for (std::size_t w = 0; w < layout.words; ++w)
      slice[w * layout.line() + static_cast<std::size_t>(z)] = row[w];
  }
}

bool anything(const BitVolume& occupied, int y) {
  const Word* const first = occupied.row(y, 0);
  return std::any_of(first, first + static_cast<std::ptrdiff_t>(occupied.rowWords()) * occupied.size().z,
                     [](Word word) { return word != 0; });
}

}  // namespace

void sweepBatch(const BitVolume& occupied, std::span<const LatticeDirection* const> batch,
                const std::function<void(const Band&)>& count) {
  const Voxel size = occupied.size();
  const bool up = std::all_of(batch.begin(), batch.end(), [](const auto* d) { return d->v.y >= 0; });
  const auto slice = [&](int done) { return up ? size.y - 1 - done : done; };
  int first = 0;
  while (first < size.y && !anything(occupied, slice(first))) ++first;

  const Layout layout(occupied, batch);
  std::vector<Sweep> sweeps;
  std::vector<Sweep*> level;
  sweeps.reserve(batch.size());
  int slots = 1;
  for (const LatticeDirection* direction : batch) {
    sweeps.emplace_back(occupied, *direction, layout);
    if (sweeps.back().level()) level.push_back(&sweeps.back());
    slots = std::max(slots, slotsFor(occupied, direction->v));
  }
  const Ring world(layout, slots);
  const std::size_t cached = kCacheWords / (layout.words * batch.size()) / kRows * kRows;
  const std::size_t shared = roundedUp((layout.rows + static_cast<std::size_t>(threadCount()) - 1) /
                                       static_cast<std::size_t>(threadCount()));
  const std::size_t rows = std::clamp(cached, kRows, shared);
  const std::size_t bands = (layout.rows + rows - 1) / rows;
  for (int done = first; done < size.y; ++done) {
    layOut(occupied, slice(done), layout, world.slice(done));
    parallelForEach(level.size(), [&](std::size_t i) { level[i]->runLevel(world, done); });
    parallelForEach(bands, [&](std::size_t b) {
      const std::size_t z0 = b * rows, z1 = std::min(layout.rows, z0 + rows);
      std::vector<const Word*> blocked;
      blocked.reserve(sweeps.size());
      for (Sweep& sweep : sweeps) {
        if (!sweep.level()) sweep.run(world, done, z0, z1);
        blocked.push_back(sweep.blocked(done));
      }
      count({slice(done), static_cast<int>(z0), std::min(size.z, static_cast<int>(z1)), blocked,
             layout.line()});
    });
  }
}

void forEachBatch(const BitVolume& occupied, const DirectionSet& directions,
                  const std::function<void(std::span<const std::size_t>)>& take) {
  const std::size_t most = std::max(kLeastRingBytes, occupied.words().size() * sizeof(Word));
  for (const bool up : {true, false}) {
    std::vector<std::size_t> batch;
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      if ((directions[i].v.y >= 0) != up) continue;
      const std::array<const LatticeDirection*, 1> alone{&directions[i]};
      const std::size_t more = Layout(occupied, alone).slice() * sizeof(Word) *
                               static_cast<std::size_t>(slotsFor(occupied, directions[i].v));
      if (!batch.empty() && bytes + more > most) {
        take(batch);
        batch.clear();
        bytes = 0;
      }
      batch.push_back(i);
      bytes += more;
    }
    if (!batch.empty()) take(batch);
  }
}

}  // namespace espalier::sim
