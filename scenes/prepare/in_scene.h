#pragma once
#include "scenes/problem.h"
#include "scenes/scene.h"

namespace espalier::scenes {

/// Does a part of a scene's work; what is wrong has this place then, or is the scene's file as a whole where
/// the place has no path. A PlacedError has its own.
template <typename Work>
auto inScene(const Scene& scene, const Place& place, Work work) {
  try {
    return work();
  } catch (const PlacedError&) {
    throw;
  } catch (const sim::InputError& error) {
    throw PlacedError({problemAt(place, scene.file, error.what())});
  }
}
template <typename Work>
auto inScene(const Scene& scene, Work work) {
  return inScene(scene, {}, std::move(work));
}

}  // namespace espalier::scenes
