#include "render/model/diced.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/stop.h"
#include "sim/tile/dice.h"

namespace espalier::render {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr std::size_t kChunk = 256;  // triangles that one task cuts
constexpr std::size_t kAtOnce = 64;  // chunks that are cut before their corners are joined

/// On the plane between voxels where it is as near as single precision tells.
double onPlane(double place) {
  constexpr double kNear = 1e-5;
  const double plane = std::floor(place) + 0.5;
  return std::abs(place - plane) < kNear ? plane : place;
}

template <class Positions>
Uncut uncutOf(const std::string& name, const Positions& positions_m, const std::vector<Triangle>& triangles,
              const sim::Frame& frame) {
  Uncut uncut{name, {}, triangles};
  uncut.corners_vx.reserve(positions_m.size());
  for (const auto& position : positions_m) {
    const sim::Vec3 p = sim::voxelFromWorld(frame, sim::Vec3(position));
    uncut.corners_vx.emplace_back(onPlane(p.x), onPlane(p.y), onPlane(p.z));
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (std::ranges::max(triangles[t]) < positions_m.size()) continue;
    throw sim::InputError(fmt::format("mesh '{}': triangle {} uses vertex {} of {}", name, t,
                                      std::ranges::max(triangles[t]), positions_m.size()));
  }
  return uncut;
}

std::array<sim::Vec3, 3> cornersOf(const Uncut& mesh, std::size_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  return {mesh.corners_vx[t[0]], mesh.corners_vx[t[1]], mesh.corners_vx[t[2]]};
}

std::size_t chunksOf(const Uncut& mesh) {
  return (mesh.triangles.size() + kChunk - 1) / kChunk;
}

template <class Visit>
void diceChunk(const Uncut& mesh, std::size_t chunk, sim::Voxel size, const Visit& visit) {
  const std::size_t last = std::min((chunk + 1) * kChunk, mesh.triangles.size());
  for (std::size_t t = chunk * kChunk; t < last; ++t) {
    sim::throwIfStopped();
    sim::dice(cornersOf(mesh, t), size, visit);
  }
}

/// The fragments of a chunk, one after the other.
struct Fragments {
  std::vector<sim::Vec3f> corners_m;
  std::vector<sim::Colour> colours;  // of each fragment
  std::vector<std::uint8_t> counts;  // of its corners
};

/// Gives each place and colour one number, in the order in which they come: a table of open addresses.
class Joined {
 public:
  explicit Joined(DicedMesh& mesh) : mesh_(mesh) {}

  std::uint32_t number(sim::Vec3f position, sim::Colour colour) {
    if (2 * mesh_.positions_m.size() >= slots_.size()) grow();
    std::uint32_t& slot = slotOf(position, colour);
    if (slot == kEmpty) {
      slot = static_cast<std::uint32_t>(mesh_.positions_m.size());
      mesh_.positions_m.push_back(position);
      mesh_.colours.push_back(colour);
    }
    return slot;
  }

 private:
  static constexpr std::uint32_t kEmpty = 0xffffffffu;

  void grow() {
    slots_.assign(std::max<std::size_t>(2 * slots_.size(), 64), kEmpty);
    for (std::uint32_t i = 0; i < mesh_.positions_m.size(); ++i)
      slotOf(mesh_.positions_m[i], mesh_.colours[i]) = i;
  }
  /// Where its number stands, or is to stand.
  std::uint32_t& slotOf(sim::Vec3f position, sim::Colour colour) {
    const std::size_t last = slots_.size() - 1;
    for (std::size_t slot = hash(position, colour) & last;; slot = (slot + 1) & last) {
      const std::uint32_t at = slots_[slot];
      if (at == kEmpty || (mesh_.positions_m[at] == position && mesh_.colours[at] == colour))
        return slots_[slot];
    }
  }

  static std::size_t hash(sim::Vec3f p, sim::Colour c) {
    std::uint64_t h = 0;
    for (const float value : {p.x, p.y, p.z, c.r, c.g, c.b}) {
      h = (h ^ std::bit_cast<std::uint32_t>(value + 0.0f)) * 0x9e3779b97f4a7c15u;  // + 0: of -0 too
      h ^= h >> 29;
    }
    return static_cast<std::size_t>(h);
  }

  DicedMesh& mesh_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace

Uncut uncut(const sim::Mesh& mesh, const sim::Frame& frame) {
  return uncutOf(mesh.name, mesh.vertices_m, mesh.triangles, frame);
}

Uncut uncut(const ModelMesh& mesh, const sim::Frame& frame) {
  return uncutOf(mesh.name, mesh.positions_m, mesh.triangles, frame);
}

std::size_t fragmentsOf(const Uncut& mesh, sim::Voxel size) {
  std::vector<std::size_t> counts(chunksOf(mesh));
  sim::parallelForEach(counts.size(), [&](std::size_t chunk) {
    diceChunk(mesh, chunk, size, [&](sim::Voxel, std::span<const sim::Vec3>) { ++counts[chunk]; });
  });
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

double dicedBytes(std::size_t fragments) {
  constexpr double kBytesAFragment =
      300.0;  // measured: corners before and after they are joined, their table
  return kBytesAFragment * static_cast<double>(fragments);
}

DicedMesh diced(const Uncut& mesh, const sim::Frame& frame, const ColourOfVoxel& colour) {
  DicedMesh result;
  result.name = mesh.name;
  Joined joined(result);
  std::vector<Fragments> chunks;
  for (std::size_t first = 0; first < chunksOf(mesh); first += kAtOnce) {
    chunks.assign(std::min(kAtOnce, chunksOf(mesh) - first), {});
    sim::parallelForEach(chunks.size(), [&](std::size_t i) {
      Fragments& mine = chunks[i];
      diceChunk(mesh, first + i, frame.size, [&](sim::Voxel voxel, std::span<const sim::Vec3> fragment) {
        for (const sim::Vec3& corner : fragment)
          mine.corners_m.emplace_back(sim::worldFromVoxel(frame, corner));
        mine.colours.push_back(colour(voxel));
        mine.counts.push_back(static_cast<std::uint8_t>(fragment.size()));
      });
    });
    for (const Fragments& fragments : chunks) {
      std::size_t corner = 0;
      for (std::size_t f = 0; f < fragments.counts.size(); ++f) {
        const auto number = [&] {
          return joined.number(fragments.corners_m[corner++], fragments.colours[f]);
        };
        const std::uint32_t hub = number();
        std::uint32_t before = number();
        for (int i = 2; i < fragments.counts[f]; ++i) {
          const std::uint32_t next = number();
          if (hub != before && before != next && next != hub) result.triangles.push_back({hub, before, next});
          before = next;
        }
      }
      result.fragments += fragments.counts.size();
    }
  }
  return result;
}

}  // namespace espalier::render
