#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "render/image/camera.h"
#include "render/voxels/panels.h"
#include "sim/base/bits.h"
#include "sim/base/faces.h"
#include "sim/base/frame.h"
#include "sim/world/field.h"
#include "sim/world/ray.h"

namespace espalier::tests {

/// What the free voxel in front of a face holds. The field must outlive it.
inline render::FaceValue inFront(const sim::ExposureField& field) {
  return [&field](sim::Voxel v, std::uint8_t face) { return field.at(v + sim::kFaceNormals[face]); };
}

/// A garden small enough to hold in the head: paving, a wall with an arched window and a coping, steps, a bed
/// with a clipped ball in it. Colours as plain arrays and exposures by casting every ray, so that pictures
/// can be tested without the world, its grids or the sweeps.
class LittleGarden {
 public:
  /// Lengths in voxels at scale 1; a scale of 4 gives about the size of the courtyard of Greene 1989.
  explicit LittleGarden(int scale = 1)
      : scale_(scale),
        frame_{sim::Vec3(-1.5, 0.0, -1.2), 3.0 / (44.0 * scale), sim::Voxel(44, 34, 40) * scale},
        occupied_(frame_.size),
        colours_(cells()) {
    floor();
    wall();
    steps();
    bed();
  }

  const sim::Frame& frame() const { return frame_; }
  const sim::BitVolume& occupied() const { return occupied_; }
  sim::Colour colour(sim::Voxel v) const {
    return sim::contains(frame_.size, v) ? colours_[index(v)] : sim::Colour(0.0f);
  }

  /// Fraction of the free directions, at free voxels that touch something; 0 elsewhere.
  sim::ExposureField exposure(const std::vector<sim::Vec3>& directions) const {
    sim::ExposureField field{{frame_.size, std::vector<std::uint16_t>(cells())}};
    const sim::Bricks bricks(occupied_);
    forEach([&](sim::Voxel v) {
      if (occupied_.at(v) || !touches(v)) return;
      std::size_t open = 0;
      for (const sim::Vec3& d : directions)
        open += sim::firstHit(occupied_, bricks, sim::Vec3(v), d) ? 0u : 1u;
      field.values[field.index(v)] =
          static_cast<std::uint16_t>(open * sim::ExposureField::kWhole / directions.size());
    });
    return field;
  }

  /// Points of a spiral over the upper hemisphere, evenly spread.
  static std::vector<sim::Vec3> sky(int count = 96) {
    std::vector<sim::Vec3> directions;
    for (int i = 0; i < count; ++i) {
      const double y = (i + 0.5) / count, turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
      directions.push_back(glm::normalize(
          sim::Vec3(std::sqrt(1 - y * y) * std::cos(turn), y, std::sqrt(1 - y * y) * std::sin(turn))));
    }
    return directions;
  }

  static render::Camera camera() { return {{1.9, 1.7, 4.0}, {0.0, 0.75, 0.0}, 36}; }

  /// An arc from left to right, leaning towards the viewer.
  static std::vector<sim::Vec3> sunArc(int count = 48) {
    std::vector<sim::Vec3> directions;
    for (int i = 0; i < count; ++i) {
      const double angle = std::numbers::pi * (i + 0.5) / count;
      directions.push_back(
          sim::Vec3(-std::cos(angle), std::sin(angle) * std::cos(0.6), std::sin(angle) * std::sin(0.6)));
    }
    return directions;
  }

 private:
  std::size_t cells() const {
    const sim::Voxel s = frame_.size;
    return static_cast<std::size_t>(s.x) * static_cast<std::size_t>(s.y) * static_cast<std::size_t>(s.z);
  }
  std::size_t index(sim::Voxel v) const {
    return static_cast<std::size_t>((v.y * frame_.size.z + v.z) * frame_.size.x + v.x);
  }
  template <typename Visit>
  void forEach(Visit visit) const {
    for (int y = 0; y < frame_.size.y; ++y)
      for (int z = 0; z < frame_.size.z; ++z)
        for (int x = 0; x < frame_.size.x; ++x) visit(sim::Voxel(x, y, z));
  }
  bool touches(sim::Voxel v) const {
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        for (int x = -1; x <= 1; ++x)
          if (occupied_.at(v + sim::Voxel(x, y, z))) return true;
    return false;
  }
  /// Fills where `inside` of the position in voxels at scale 1 says so.
  template <typename Inside>
  void fill(sim::Colour colour, float variation, Inside inside) {
    forEach([&](sim::Voxel v) {
      const sim::Vec3 p = (sim::Vec3(v) + 0.5) / static_cast<double>(scale_);
      const std::optional<int> tile = inside(p);
      if (!tile || occupied_.at(v)) return;
      occupied_.set(v);
      const float shade = static_cast<float>((*tile * 7919 % 101 + 101) % 101) / 100.0f - 0.5f;
      colours_[index(v)] = colour * (1.0f + variation * shade);
    });
  }

  void floor() {
    fill({0.42f, 0.38f, 0.32f}, 0.35f, [](sim::Vec3 p) -> std::optional<int> {
      if (p.y > 2) return std::nullopt;
      return static_cast<int>(p.x / 5) * 13 + static_cast<int>(p.z / 5) * 29;
    });
  }
  void wall() {
    const auto brick = [](sim::Vec3 p) {
      const int course = static_cast<int>(p.y / 2);
      return course * 31 + static_cast<int>((p.x + (course % 2) * 2) / 4) * 17;
    };
    fill({0.55f, 0.24f, 0.14f}, 0.5f, [&](sim::Vec3 p) -> std::optional<int> {
      if (p.z < 10 || p.z > 14 || p.x < 4 || p.x > 40 || p.y > 26) return std::nullopt;
      const bool square = std::abs(p.x - 24) < 5 && p.y > 10 && p.y <= 17;
      const bool arch = (p.x - 24) * (p.x - 24) + (p.y - 17) * (p.y - 17) < 25 && p.y > 17;
      if (square || arch) return std::nullopt;
      return brick(p);
    });
    fill({0.62f, 0.58f, 0.5f}, 0.15f, [](sim::Vec3 p) -> std::optional<int> {
      if (p.y <= 26 || p.y > 28 || p.z < 9 || p.z > 15 || p.x < 3 || p.x > 41) return std::nullopt;
      return static_cast<int>(p.x / 5);
    });
  }
  void steps() {
    fill({0.6f, 0.55f, 0.47f}, 0.2f, [](sim::Vec3 p) -> std::optional<int> {
      const int step = static_cast<int>((p.z - 14) / 3);
      if (p.z < 14 || p.x < 30 || p.x > 38 || step > 3 || p.y > 2 + 2 * (4 - step)) return std::nullopt;
      return step;
    });
  }
  void bed() {
    fill({0.16f, 0.1f, 0.06f}, 0.4f, [](sim::Vec3 p) -> std::optional<int> {
      if (p.y > 4 || p.x < 4 || p.x > 20 || p.z < 14 || p.z > 22) return std::nullopt;
      return static_cast<int>(p.x * 3) + static_cast<int>(p.z * 5);
    });
    fill({0.16f, 0.38f, 0.1f}, 0.5f, [](sim::Vec3 p) -> std::optional<int> {
      const sim::Vec3 d = p - sim::Vec3(12, 9.5, 19);
      if (glm::dot(d, d) > 36) return std::nullopt;
      return static_cast<int>(p.x * 5) + static_cast<int>(p.y * 11) + static_cast<int>(p.z * 3);
    });
  }

  int scale_;
  sim::Frame frame_;
  sim::BitVolume occupied_;
  std::vector<sim::Colour> colours_;
};

}  // namespace espalier::tests
