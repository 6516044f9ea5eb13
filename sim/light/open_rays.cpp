#include "sim/light/open_rays.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

#include "sim/base/parallel.h"
#include "sim/light/look.h"

namespace espalier::sim {
namespace {

using looking::kFar;
using looking::kLegs;
using looking::kNear;
using looking::kSteps;

constexpr std::size_t kGroup = 64 * ClearBricks::kWords;

int farthest(Voxel o) {
  return std::max({std::abs(o.x), std::abs(o.y), std::abs(o.z)});
}

/// Voxel i of a ray from voxel 0.
Voxel crossed(const LatticeDirection& direction, std::size_t i) {
  const std::size_t period = direction.crossed.size();
  return direction.crossed[i % period] + static_cast<int>(i / period) * direction.v;
}

/// In bits of the volume.
std::int64_t stepOf(const BitVolume& shape, Voxel o) {
  const std::int64_t row = std::int64_t{o.y} * shape.size().z + o.z;
  return row * shape.rowWords() * BitVolume::kWordBits + o.x;
}

void include(looking::Mask& mask, std::size_t direction) {
  mask.words[direction / 64] |= std::uint64_t{1} << (direction % 64);
}

looking::Ray rayOf(const BitVolume& shape, const LatticeDirection& direction, std::size_t near) {
  looking::Ray ray{};
  ray.near = near;
  for (std::size_t i = 0; i < kSteps; ++i) {
    const Voxel o = crossed(direction, near + i);
    ray.steps[i] = stepOf(shape, o);
    for (std::size_t within = 0; within < kFar; ++within) {
      if (std::abs(o.y) <= static_cast<int>(within)) ray.within_y[within] = static_cast<std::uint8_t>(i + 1);
      if (std::abs(o.z) <= static_cast<int>(within)) ray.within_z[within] = static_cast<std::uint8_t>(i + 1);
    }
  }
  for (std::size_t leg = 0; leg < kLegs.size(); ++leg)
    ray.beyond[leg] = crossed(direction, near + kLegs[leg]);
  return ray;
}

/// Adds direction i of a group, whose voxels from `near` on are no longer near.
void addWalk(const BitVolume& shape, const LatticeDirection& direction, std::size_t i, std::size_t near,
             looking::Walks& walks) {
  const looking::Ray& ray = walks.rays.emplace_back(rayOf(shape, direction, near));
  for (int axis = 0; axis < 3; ++axis) {
    for (int in = 0; in < ClearBricks::kSide; ++in) {
      const int to = (in + ray.beyond[0][axis] + ClearBricks::kSide) / ClearBricks::kSide;
      include(walks.leaving[static_cast<std::size_t>(axis)][static_cast<std::size_t>(in)]
                           [static_cast<std::size_t>(to)],
              i);
    }
  }
  walks.first_step.push_back(walks.period_steps.size());
  for (const Voxel o : direction.crossed) walks.period_steps.push_back(stepOf(shape, o));
  walks.first_run.push_back(walks.runs.size());
  Voxel first(0);
  for (std::size_t k = 0; k < direction.crossed.size(); ++k) {
    const Voxel o = direction.crossed[k];
    if (k > 0 && farthest(o - first) <= ClearBricks::kSide) continue;
    walks.runs.push_back(static_cast<std::uint32_t>(k));
    first = o;
  }
  walks.runs.push_back(static_cast<std::uint32_t>(direction.crossed.size()));
}

/// Adds the legs of a direction from its voxel `k` on, up to the end of the longest way through the world.
void addLegs(const BitVolume& shape, const LatticeDirection& direction, std::size_t k, looking::Legs& legs) {
  const Voxel size = shape.size();
  looking::Legs::Ray& ray = legs.rays.emplace_back();
  const std::size_t period = direction.crossed.size();
  ray.first = legs.x.size();
  for (;;) {
    const Voxel first = crossed(direction, k), far = glm::abs(first);
    legs.x.push_back(static_cast<std::int16_t>(first.x));
    legs.y.push_back(static_cast<std::int16_t>(first.y));
    legs.z.push_back(static_cast<std::int16_t>(first.z));
    legs.along.push_back(static_cast<std::int16_t>(far[Horizons::depthAxis(direction.v)]));
    legs.period.push_back(static_cast<std::int32_t>(k / period));
    legs.step.push_back(static_cast<std::uint16_t>(k % period));
    std::size_t voxels = 0;
    for (; farthest(crossed(direction, k) - first) <= looking::kLeg; ++k, ++voxels) {
      for (int axis = 0; axis < 3; ++axis) {
        std::int32_t& span = ray.spans[static_cast<std::size_t>(axis)];
        span = std::max(span, std::abs(crossed(direction, k)[axis] - first[axis]));
      }
    }
    legs.voxels.push_back(static_cast<std::uint8_t>(voxels));
    if (far.x >= size.x || far.y >= size.y || far.z >= size.z) break;
  }
  ray.count = legs.x.size() - 1 - ray.first;
  const std::size_t whole = (legs.x.size() + Horizons::kLanes - 1) / Horizons::kLanes * Horizons::kLanes;
  for (auto* const numbers : {&legs.x, &legs.y, &legs.z}) numbers->resize(whole);
  legs.along.resize(whole, std::numeric_limits<std::int16_t>::max());
  legs.period.resize(whole);
  legs.step.resize(whole);
  legs.voxels.resize(whole);
  ray.first_step = legs.steps.size();
  ray.period = stepOf(shape, direction.v);
  constexpr std::size_t kLongest = 3 * looking::kLeg + 1;  // none is crossed without a step along an axis
  for (std::size_t step = 0; step < period + kLongest; ++step)
    legs.steps.push_back(stepOf(shape, crossed(direction, step)));
}

looking::Group groupOf(const BitVolume& shape, std::span<const LatticeDirection> directions,
                       std::size_t number) {
  const bool down =
      std::any_of(directions.begin(), directions.end(), [](const auto& d) { return d.v.y < 0; });
  const bool coarse = ClearBricks::isCoarse(shape.size());
  constexpr int kAcross = 2 * kNear + 1;
  looking::Group group{directions, number, down ? -kNear : 0, {}, {}, {}};
  group.crossing.resize(static_cast<std::size_t>(kAcross * (kNear + 1 - group.lowest)));
  for (std::size_t i = 0; i < directions.size(); ++i) {
    std::size_t near = 0;
    for (; farthest(crossed(directions[i], near)) <= kNear; ++near) {
      const Voxel o = crossed(directions[i], near);
      const int row = (o.y - group.lowest) * kAcross + o.z + kNear;
      const auto x = static_cast<std::size_t>(o.x + kNear);
      for (std::size_t pattern = 0; pattern < 16; ++pattern) {
        if (((pattern >> (x % 4)) & 1u) != 0)
          include(group.crossing[static_cast<std::size_t>(row)][x / 4][pattern], i);
      }
    }
    coarse ? addLegs(shape, directions[i], near, group.legs)
           : addWalk(shape, directions[i], i, near, group.walks);
  }
  auto& steps = coarse ? group.legs.steps : group.walks.period_steps;
  steps.resize(steps.size() + looking::kAtOnce);
  return group;
}

}  // namespace

OpenRays::OpenRays(const BitVolume& shape, const DirectionSet& directions)
    : directions_(std::make_shared<const DirectionSet>(directions)) {
  std::vector<looking::Group> groups;
  for (std::size_t first = 0; first < directions.size(); first += kGroup) {
    const std::size_t count = std::min(directions.size() - first, kGroup);
    groups.push_back(groupOf(shape, std::span(*directions_).subspan(first, count), first));
  }
  groups_ = std::make_shared<const std::vector<looking::Group>>(std::move(groups));
}

ClearAhead::ClearAhead() = default;
ClearAhead::~ClearAhead() = default;
ClearAhead::ClearAhead(ClearAhead&&) noexcept = default;
ClearAhead& ClearAhead::operator=(ClearAhead&&) noexcept = default;

void OpenRays::look(const BitVolume& occupied, ClearAhead& ahead, const Bricks* filled) const {
  std::optional<Bricks> scanned;
  if (filled == nullptr) filled = &scanned.emplace(occupied);
  const bool known = ahead.known();
  if (ClearBricks::isCoarse(occupied.size())) {
    if (known) return ahead.filled_ahead_->follow(*filled, *directions_);
    ahead.filled_ahead_ = std::make_unique<FilledAhead>(occupied.size(), *filled, *directions_);
    return;
  }
  for (std::size_t g = 0; g < groups_->size(); ++g) {
    const auto directions = (*groups_)[g].directions;
    if (known) {
      ahead.of_groups_[g].follow(*filled, directions);
    } else {
      ahead.of_groups_.emplace_back(occupied.size(), *filled, directions);
    }
  }
}

void OpenRays::look(const BitVolume& occupied, const ClearAhead& ahead, std::span<const Voxel> places,
                    std::uint64_t* open) const {
  for (std::size_t g = 0; g < groups_->size(); ++g, open += ClearBricks::kWords) {
    const looking::Group& group = (*groups_)[g];
    ahead.filled_ahead_ ? looking::look(occupied, group, *ahead.filled_ahead_, places, open, words())
                        : looking::look(occupied, group, ahead.of_groups_[g], places, open, words());
  }
}

std::vector<std::uint64_t> OpenRays::from(const BitVolume& occupied, std::span<const Voxel> places,
                                          ClearAhead& ahead, const Bricks* filled) const {
  look(occupied, ahead, filled);
  std::vector<std::uint64_t> open(places.size() * words());
  parallelFor(places.size(), 16, [&](std::size_t begin, std::size_t end) {
    look(occupied, ahead, places.subspan(begin, end - begin), open.data() + begin * words());
  });
  return open;
}

RaysInside::RaysInside(const OpenRays& rays, const BitVolume& occupied, ClearAhead& ahead,
                       const Bricks* filled)
    : rays_(rays), occupied_(occupied), ahead_(ahead) {
  rays.look(occupied, ahead, filled);
}

std::vector<std::uint64_t> RaysInside::from(Voxel place) const {
  std::vector<std::uint64_t> open(rays_.words());
  rays_.look(occupied_, ahead_, {&place, 1}, open.data());
  return open;
}

}  // namespace espalier::sim
