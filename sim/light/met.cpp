#include "sim/light/met.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "sim/base/parallel.h"
#include "sim/light/lit_faces.h"
#include "sim/light/open_surfaces.h"

namespace espalier::sim {
namespace {

/// Set in a number whose receiver may turn its back to a ray that comes through the face.
constexpr std::uint32_t kSlants = std::uint32_t{1} << 31;

BitVolume inTheOpen(const BitVolume& opaque) {
  BitVolume open = opaque;
  parallelForEach(static_cast<std::size_t>(opaque.size().y), [&](std::size_t slice) {
    const int y = static_cast<int>(slice);
    for (int z = 0; z < opaque.size().z; ++z) {
      for (int w = 0; w < opaque.rowWords() - 1; ++w) {
        if (open.row(y, z)[w] != 0) open.row(y, z)[w] &= ~buriedBits(opaque, y, z, w);
      }
    }
  });
  return open;
}

/// Finds what a ray sees that ends in a voxel, by the face through which it came.
class Shown {
 public:
  explicit Shown(const Lighting& light)
      : light_(light),
        surfaces_(static_cast<std::uint32_t>(light.surfaces.size())),
        none_(surfaces_ + static_cast<std::uint32_t>(light.faces.size())) {}

  std::uint32_t none() const { return none_; }

  /// The voxel's surface if it looks that way, else the face; where there is neither, a surface that lies
  /// right before it: voxels of solids take light where their middle is inside, and a surface may lie in the
  /// next.
  std::uint32_t by(Voxel v, std::uint8_t face) const {
    std::uint32_t own = none_;
    if (light_.where->has(v)) {
      own = static_cast<std::uint32_t>(light_.where->number(v));
      const float ahead = facing(own, face);
      if (belongs(light_.surfaces[own].surface, face)) return ahead > kStraight ? own : own | kSlants;
    }
    if (const std::uint32_t judged = judgedFace(v, face, face); judged != none_) return judged;
    if (const std::uint32_t before = surfaceBefore(v, face); before != none_) return before;
    if (own != none_) return own | kSlants;
    const std::uint32_t any = judgedFace(v, 0, kFaces - 1);
    return any == none_ ? none_ : any | kSlants;
  }

 private:
  static constexpr float kStraight = 0.999f;  // cosine

  float facing(std::uint32_t surface, std::uint8_t face) const {
    return glm::dot(light_.surfaces[surface].surface.normal, Vec3f(kFaceNormals[face]));
  }

  /// The first of a voxel's faces first .. last that is judged by itself.
  std::uint32_t judgedFace(Voxel v, std::uint8_t first, std::uint8_t last) const {
    const auto at = std::lower_bound(light_.faces.begin(), light_.faces.end(), light_.faceKey(v, first));
    if (at == light_.faces.end() || *at > light_.faceKey(v, last)) return none_;
    return surfaces_ + static_cast<std::uint32_t>(at - light_.faces.begin());
  }

  /// The one around that looks most that way; in the voxel right before the face if there is one.
  std::uint32_t surfaceBefore(Voxel v, std::uint8_t face) const {
    std::uint32_t best = none_;
    float most = 0.0f;
    const auto look = [&](Voxel place) {
      if (!contains(light_.where->bits().size(), place) || !light_.where->has(place)) return;
      const auto number = static_cast<std::uint32_t>(light_.where->number(place));
      if (const float ahead = facing(number, face); ahead > most) {
        most = ahead;
        best = number;
      }
    };
    look(v + kFaceNormals[face]);
    if (best == none_) {
      for (int i = 0; i < 27; ++i) look(v + Voxel(i % 3, i / 9, i / 3 % 3) - 1);
    }
    return best == none_ || most > kStraight ? best : best | kSlants;
  }

  const Lighting& light_;
  std::uint32_t surfaces_, none_;
};

}  // namespace

Stops<std::uint32_t> receiversMet(const World& world, const Lighting& light) {
  Stops<std::uint32_t> stops(inTheOpen(world.opaque()));
  const Shown shown(light);
  for (std::uint8_t f = 0; f < kFaces; ++f) {
    auto& face = stops.faces[f];
    const std::vector<Voxel> voxels = face.where.voxels();
    parallelFor(voxels.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const bool entered = !world.opaque().at(voxels[i] + kFaceNormals[f]);
        face.values[i] = entered ? shown.by(voxels[i], f) : shown.none();
      }
    });
  }
  return stops;
}

SurfaceSensors sensorsOf(const World& world, const Lighting& light) {
  SurfaceSensors sensors = surfaceSensors(world, light.surfaces);
  addFaces(sensors, light.faces, world.opaque());
  return sensors;
}

std::vector<Voxel> viewpoints(const SurfaceSensors& sensors) {
  const std::vector<Voxel> places = sensors.places->voxels();
  std::vector<Voxel> from(sensors.surfaces.size(), Voxel(-1));
  parallelFor(from.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto taps = sensors.of(i);
      const auto most = std::max_element(taps.begin(), taps.end(),
                                         [](const auto& a, const auto& b) { return a.weight < b.weight; });
      if (most != taps.end()) from[i] = places[most->place];
    }
  });
  return from;
}

Met meet(const Stops<std::uint32_t>& stops, const SurfaceSensors& sensors,
         const std::vector<Voxel>& viewpoints, const DirectionSet& directions, std::size_t first,
         std::size_t count) {
  const auto receivers = static_cast<std::uint32_t>(viewpoints.size());
  const auto slices = static_cast<std::size_t>(stops.where.size().y);
  struct Look {
    std::uint32_t receiver;
    std::int32_t x, z;
  };
  std::vector<std::vector<Look>> from(slices);  // by the slice from which receivers look
  for (std::uint32_t i = 0; i < receivers; ++i) {
    const Voxel v = viewpoints[i];
    if (v.y >= 0) from[static_cast<std::size_t>(v.y)].push_back({i, v.x, v.z});
  }
  const auto lookAlong = [&](const LatticeDirection& direction, std::vector<std::uint32_t>& numbers) {
    const Vec3f unit(glm::normalize(Vec3(direction.v)));
    CarriedSweep<std::uint32_t> sweep(stops, direction, receivers);
    for (std::size_t i = 0; i < slices; ++i) {
      const std::size_t y = sweep.downwards() ? slices - 1 - i : i;
      sweep.run(static_cast<int>(y));
      for (const Look& look : from[y]) {
        const std::uint32_t* const row = sweep.row(look.z);
        if (!row) continue;
        const std::uint32_t seen = row[look.x], number = seen & ~kSlants;
        const bool back =
            (seen & kSlants) != 0 && glm::dot(sensors.surfaces[number].surface.normal, unit) >= 0.0f;
        if (!back) numbers[look.receiver] = number;
      }
    }
  };
  Met met{count, std::vector<std::uint32_t>(count * receivers)};
  // As many directions side by side as make a cache's line of each receiver's numbers.
  constexpr std::size_t kAtOnce = 16;
  parallelForEach((count + kAtOnce - 1) / kAtOnce, [&](std::size_t block) {
    const std::size_t begin = block * kAtOnce, some = std::min(kAtOnce, count - begin);
    std::vector<std::vector<std::uint32_t>> numbers(some, std::vector<std::uint32_t>(receivers, receivers));
    for (std::size_t d = 0; d < some; ++d) lookAlong(directions[first + begin + d], numbers[d]);
    for (std::size_t i = 0; i < receivers; ++i) {
      for (std::size_t d = 0; d < some; ++d) met.numbers[i * count + begin + d] = numbers[d][i];
    }
  });
  return met;
}

}  // namespace espalier::sim
