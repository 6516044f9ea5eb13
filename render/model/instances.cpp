#include "render/model/instances.h"

#include <array>

#include "render/model/leaves.h"
#include "render/model/tubes.h"

namespace espalier::render {
namespace {

using sim::Vec3;

Placement placementAt(const ModelMesh& mesh, std::size_t vertex) {
  Placement place;
  place.exposure = mesh.exposures[vertex];
  place.youth = mesh.youths[vertex];
  place.order = mesh.orders[vertex];
  if (!mesh.tints.empty()) place.tint = mesh.tints[vertex];
  return place;
}

/// An empty mesh that looks like another.
ModelMesh likeOf(const ModelMesh& mesh) {
  ModelMesh like;
  like.name = mesh.name;
  like.base_colour = mesh.base_colour;
  like.picture = mesh.picture;
  like.emits = mesh.emits;
  like.alpha = mesh.alpha;
  return like;
}

}  // namespace

Instances bladesAsInstances(const ModelMesh& blades, const sim::Plant& plant, const LeafFeet& feet,
                            std::size_t shape, const sim::Frame& frame) {
  Instances result;
  result.shape = likeOf(blades);
  result.tinted = !blades.tints.empty();
  appendElement(result.shape, {}, plant.shapes[shape], {Vec3(0.0), frame.voxel_m, frame.size}, {}, 0);
  for (std::size_t v = 0; v < blades.pieces.size(); ++v) {
    if (v > 0 && blades.pieces[v] == blades.pieces[v - 1]) continue;
    const sim::PlacedElement element = feet.of(plant.elements[blades.pieces[v]]).element;
    Placement place = placementAt(blades, v);
    place.position_m = sim::Vec3f(sim::worldFromVoxel(frame, element.position_vx));
    place.turn = glm::quat(glm::normalize(glm::quat_cast(glm::dmat3(element.x, element.y, element.z))));
    place.scale = sim::Vec3f(static_cast<float>(element.scale));
    result.places.push_back(place);
  }
  return result;
}

Instances stalksAsInstances(const ModelMesh& stalks, int sides) {
  Instances result;
  result.shape = likeOf(stalks);
  result.stalks = true;
  result.tinted = !stalks.tints.empty();
  const std::array<TubeStation, 2> unit{TubeStation{Vec3(0, 0, 0), 1.0, 0.0f, 0.0f},
                                        TubeStation{Vec3(0, 1, 0), 1.0, 0.0f, 0.0f}};
  appendTube(result.shape, unit, sides, 0);
  const auto count = static_cast<std::size_t>(sides);
  for (std::size_t first = 0; first + count < stalks.positions_m.size(); first += count + 1) {
    Vec3 base(0.0);
    for (std::size_t s = 0; s < count; ++s) base += Vec3(stalks.positions_m[first + s]);
    base /= static_cast<double>(sides);
    const Vec3 along = Vec3(stalks.positions_m[first + count]) - base;
    const Vec3 out = Vec3(stalks.positions_m[first]) - base;
    const double length = glm::length(along), radius = glm::length(out);
    if (!(length > 0.0 && radius > 0.0)) continue;
    Placement place = placementAt(stalks, first);
    // The ring of one along +y begins at +z.
    const Vec3 y = along / length, z = glm::normalize(out - glm::dot(out, y) * y);
    place.position_m = sim::Vec3f(base);
    place.turn = glm::quat(glm::normalize(glm::quat_cast(glm::dmat3(glm::cross(y, z), y, z))));
    place.scale = sim::Vec3f(Vec3(radius, length, radius));
    result.places.push_back(place);
  }
  return result;
}

}  // namespace espalier::render
