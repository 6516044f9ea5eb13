#pragma once
#include <string>
#include <vector>

#include "render/image/camera.h"
#include "render/image/image.h"
#include "scenes/show/shown_field.h"
#include "scenes/show/sight.h"
#include "sim/base/frame.h"

/// Images of kind field: a guide field as arrows over what the camera sees of the scene.
namespace espalier::scenes {

/// Places for arrows, and how far they are apart.
struct ArrowPlaces {
  std::vector<sim::Vec3> at_vx;
  double apart_vx = 0.0;
};

/// So many that arrows can be told from each other: where a field winds about normals, attractors of the
/// fronts that it bends; in space, lattices across its axis in a few layers, near such attractors. None where
/// the field says nothing.
ArrowPlaces arrowPlaces(const ShownField& field);

/// Draws arrows along s X_f, as long as it is strong, with the starts, the attractors and a legend.
/// `sight`: what the scene hides of it; null where nothing stands.
void drawField(render::Image& picture, const ShownField& field, const std::string& title,
               const sim::Frame& frame, const render::Camera& camera, const Sight* sight);

}  // namespace espalier::scenes
