#include "studio/wire/plant_frames.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "render/model/radii.h"
#include "studio/wire/frame.h"

namespace espalier::studio {
namespace {

std::uint16_t in16(double value) {
  return static_cast<std::uint16_t>(std::clamp(value, 0.0, 65535.0));
}

std::uint8_t in255(float share) {
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(share, 0.0f, 1.0f)));
}

std::string header(const OfPlant& of, std::initializer_list<std::size_t> counts) {
  std::string bytes;
  put(bytes, of.version);
  put(bytes, of.plant);
  for (const std::size_t count : counts) put(bytes, static_cast<std::uint32_t>(count));
  put(bytes, of.iteration);
  return bytes;
}

}  // namespace

std::string nodesFrame(const OfPlant& of, const sim::Plant& plant, const sim::Frame& frame,
                       std::size_t first) {
  const sim::Skeleton& skeleton = plant.skeleton;
  const std::size_t total = skeleton.parent.size();
  const std::vector<float>* const exposure = sim::find(skeleton, "exposure");
  const std::vector<float>* const order = sim::find(skeleton, "order");
  std::string bytes = header(of, {first, total - first, total});
  std::vector<float> positions, radii = render::stemRadii(skeleton, plant.girth);
  std::vector<std::int32_t> parents;
  std::vector<std::uint16_t> born, orders;
  std::vector<std::uint8_t> exposures;
  for (std::size_t n = first; n < total; ++n) {
    const sim::Vec3 at_m = sim::worldFromVoxel(frame, skeleton.position_vx[n]);
    for (int axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>(at_m[axis]));
    parents.push_back(skeleton.parent[n]);
    born.push_back(in16(skeleton.born[n]));
    orders.push_back(order != nullptr ? in16(static_cast<double>((*order)[n])) : std::uint16_t{0});
    exposures.push_back(exposure != nullptr ? in255((*exposure)[n]) : std::uint8_t{255});
  }
  for (float& radius : radii) radius *= static_cast<float>(frame.voxel_m);
  put(bytes, parents);
  put(bytes, positions);
  put(bytes, radii);
  put(bytes, born);
  put(bytes, orders);
  put(bytes, exposures);
  return frameOf(FrameKind::nodes, bytes);
}

std::vector<std::string> elementFrames(const OfPlant& of, const sim::Plant& plant, const sim::Frame& frame,
                                       std::size_t first) {
  struct OfShape {
    std::size_t before = 0, count = 0;
    std::vector<float> positions, scales;
    std::vector<std::int16_t> rotations;
    std::vector<std::uint16_t> born;
    std::vector<std::uint8_t> exposures;
  };
  std::vector<OfShape> shapes(plant.shapes.size());
  for (std::size_t e = 0; e < plant.elements.size(); ++e) {
    const sim::PlacedElement& element = plant.elements[e];
    OfShape& shape = shapes[static_cast<std::size_t>(element.shape)];
    if (e < first) {
      ++shape.before;
      continue;
    }
    ++shape.count;
    const sim::Vec3 at_m = sim::worldFromVoxel(frame, element.position_vx);
    for (int axis = 0; axis < 3; ++axis) shape.positions.push_back(static_cast<float>(at_m[axis]));
    shape.scales.push_back(static_cast<float>(element.scale));
    const glm::dquat turn = glm::quat_cast(glm::dmat3(element.x, element.y, element.z));
    for (const double part : {turn.x, turn.y, turn.z, turn.w})
      shape.rotations.push_back(
          static_cast<std::int16_t>(std::lround(32767.0 * std::clamp(part, -1.0, 1.0))));
    shape.born.push_back(in16(element.born));
    shape.exposures.push_back(in255(element.exposure));
  }
  std::vector<std::string> frames;
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    const OfShape& shape = shapes[s];
    if (shape.count == 0 && first > 0) continue;
    std::string bytes = header(of, {s, shape.before, shape.count});
    put(bytes, shape.positions);
    put(bytes, shape.scales);
    put(bytes, shape.rotations);
    put(bytes, shape.born);
    put(bytes, shape.exposures);
    frames.push_back(frameOf(FrameKind::elements, bytes));
  }
  return frames;
}

}  // namespace espalier::studio
