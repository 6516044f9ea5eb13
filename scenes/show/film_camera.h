#pragma once
#include <optional>
#include <string>
#include <vector>

#include "render/image/camera.h"
#include "scenes/scene.h"
#include "sim/world/world.h"

namespace espalier::scenes {

/// The camera of a film, which stands still or moves. It passes those of its path at their times, and slows
/// down at both ends and where it turns back; what two that follow each other have alike stays so between
/// them. (Cubic Hermite curves of each number, monotone between its values: Fritsch and Butland 1984.)
class FilmCamera {
 public:
  /// Of a scene with a film, whose checks found nothing wrong.
  explicit FilmCamera(const Scene& scene);

  /// 0 as growth begins .. 1 as it ends. It stands before the first time of its path, and after the last.
  render::Camera at(double time) const;

 private:
  struct Key {
    double time = 0.0;
    render::Camera camera;
  };
  std::vector<Key> keys_;  // at least one
};

/// Throws PlacedError where a film's camera passes through what stands in a world, or through what it looks
/// at.
void requireFilmInTheOpen(const Scene& scene, const sim::World& world);

}  // namespace espalier::scenes
