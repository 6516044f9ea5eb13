#include "render/model/plant_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/model/leaves.h"
#include "render/model/stem_curves.h"
#include "render/model/tubes.h"
#include "sim/base/stop.h"

namespace espalier::render {
namespace {

using sim::NodeId;
using sim::Vec3;

constexpr double kTurnPerStation = 0.5;  // radians; finer than the eye sees on stems a voxel thick
constexpr int kMostStations = 6;         // in a segment
constexpr double kRootDepth = 1.0;       // voxel widths that a seed's stem reaches back into the ground
constexpr int kStalkSides = 3;

template <class T>
T at(const std::vector<T>& data, NodeId n) {
  return data[static_cast<std::size_t>(n)];
}

/// What a node sensed where it grew; full light for plants whose process does not say.
class Exposure {
 public:
  explicit Exposure(const sim::Skeleton& skeleton) : values_(sim::find(skeleton, "exposure")) {}
  float of(NodeId n) const { return values_ != nullptr ? at(*values_, n) : 1.0f; }

 private:
  const std::vector<float>* values_;
};

/// 0 for the first iteration .. 1 for the last in which anything of the plant was placed.
class Youth {
 public:
  explicit Youth(const sim::Plant& plant) {
    for (const std::int32_t born : plant.skeleton.born) last_ = std::max(last_, born);
    for (const sim::PlacedElement& element : plant.elements) last_ = std::max(last_, element.born);
  }
  float of(std::int32_t born) const {
    return std::clamp(static_cast<float>(born) / static_cast<float>(last_), 0.0f, 1.0f);
  }

 private:
  std::int32_t last_ = 1;
};

int stationsIn(const Spline& curve, int segment) {
  const Vec3 a = curve.derivative(segment), middle = curve.derivative(segment + 0.5),
             b = curve.derivative(segment + 1);
  const auto turn = [](Vec3 from, Vec3 to) {
    const double lengths = glm::length(from) * glm::length(to);
    return lengths > 0 ? std::acos(static_cast<float>(std::clamp(glm::dot(from, to) / lengths, -1.0, 1.0)))
                       : 0.0f;
  };
  const double total = static_cast<double>(turn(a, middle) + turn(middle, b));
  return std::clamp(static_cast<int>(std::ceil(total / kTurnPerStation)), 1, kMostStations);
}

std::vector<TubeStation> stationsOf(const StemCurve& stem, const sim::Plant& plant, const sim::Frame& frame,
                                    const std::vector<float>& radii, const Youth& youth) {
  const sim::Skeleton& skeleton = plant.skeleton;
  const Exposure exposure(skeleton);
  std::vector<TubeStation> line;
  const auto add = [&](Vec3 p_vx, double radius_vx, float seen, float young) {
    const Vec3 centre_m = sim::worldFromVoxel(frame, p_vx);
    if (!line.empty() && glm::distance(centre_m, line.back().centre_m) < 1e-6 * frame.voxel_m) return;
    line.push_back({centre_m, radius_vx * frame.voxel_m, seen, young});
  };
  // At its fork a stem is as thick as its own first segment, not as its parent.
  const auto radiusAt = [&](std::size_t i) {
    return static_cast<double>(at(radii, stem.nodes[std::max<std::size_t>(i, 1)]));
  };

  const std::size_t segments = stem.nodes.size() - 1;
  if (stem.from_seed && segments > 0) {
    const Vec3 start = stem.curve.derivative(0.0);
    if (glm::length(start) > 0.0) {
      add(stem.curve.position(0.0) - kRootDepth * glm::normalize(start), radiusAt(0),
          exposure.of(stem.nodes[0]), youth.of(at(skeleton.born, stem.nodes[0])));
    }
  }
  for (std::size_t s = 0; s < segments; ++s) {
    const NodeId a = stem.nodes[s], b = stem.nodes[s + 1];
    const int pieces = stationsIn(stem.curve, static_cast<int>(s));
    for (int k = s == 0 ? 0 : 1; k <= pieces; ++k) {
      const double u = static_cast<double>(k) / pieces;
      const auto w = static_cast<float>(u);
      add(stem.curve.position(static_cast<double>(s) + u), radiusAt(s) + u * (radiusAt(s + 1) - radiusAt(s)),
          (1.0f - w) * exposure.of(a) + w * exposure.of(b),
          (1.0f - w) * youth.of(at(skeleton.born, a)) + w * youth.of(at(skeleton.born, b)));
    }
  }
  return line;
}

int sidesFor(double radius_vx, const PipeModel& pipe) {
  const double thick = radius_vx / static_cast<double>(pipe.tip_radius_vx);
  return std::clamp(static_cast<int>(std::lround(4.4 + 0.6 * thick)), 5, 10);
}

void appendStalk(ModelMesh& mesh, const sim::PlacedElement& element, Vec3 stem_vx, Vec3 base_vx,
                 double radius_vx, const sim::Frame& frame, float youth, std::uint32_t piece) {
  const double radius_m = radius_vx * frame.voxel_m;
  const std::array<TubeStation, 2> line{
      TubeStation{sim::worldFromVoxel(frame, stem_vx), radius_m, element.exposure, youth},
      TubeStation{sim::worldFromVoxel(frame, base_vx), radius_m, element.exposure, youth}};
  appendTube(mesh, line, kStalkSides, piece);
}

}  // namespace

PlantModel modelPlant(const sim::Plant& plant, const sim::Frame& frame, const ModelOptions& options) {
  const std::vector<float> radii = pipeRadii(plant.skeleton, options.pipe);
  const StemCurves curves = stemCurves(plant.skeleton, radii);
  const Youth youth(plant);

  PlantModel model;
  model.name = plant.name;
  model.stems.name = plant.name + " stems";
  model.stems.base_colour = plant.stem_colour;
  for (std::size_t s = 0; s < curves.stems.size(); ++s) {
    sim::throwIfStopped();
    std::vector<TubeStation> line = stationsOf(curves.stems[s], plant, frame, radii, youth);
    if (line.size() < 2) continue;
    const double thickest = line.front().radius_m / frame.voxel_m;
    line.back().radius_m *= 0.5;
    limitRadiusByBend(line);
    appendTube(model.stems, line, sidesFor(thickest, options.pipe), static_cast<std::uint32_t>(s));
  }

  for (const sim::ElementShape& shape : plant.shapes) {
    model.elements.push_back({});
    model.elements.back().name = plant.name + " " + shape.name;
    model.elements.back().base_colour = shape.colour;
  }
  for (std::size_t e = 0; e < plant.elements.size(); ++e) {
    sim::throwIfStopped();
    const sim::PlacedElement& element = plant.elements[e];
    const sim::ElementShape& shape = plant.shapes[static_cast<std::size_t>(element.shape)];
    ModelMesh& mesh = model.elements[static_cast<std::size_t>(element.shape)];
    const auto piece = static_cast<std::uint32_t>(e);
    const float young = youth.of(element.born);
    appendElement(mesh, element, shape, frame, young, piece);

    const bool on_stem = element.node >= 0 && element.node < plant.skeleton.size() &&
                         at(plant.skeleton.parent, element.node) != sim::kNoNode;
    if (!on_stem) continue;
    const Vec3 base = sim::placed(element, bladeBase(shape));
    const Vec3 stem = curves.onStem(plant.skeleton, element.node, element.position_vx);
    const auto stem_radius = static_cast<double>(at(radii, element.node));
    const double stalk_radius = 0.55 * static_cast<double>(options.pipe.tip_radius_vx);
    if (glm::distance(stem, base) > stem_radius + stalk_radius) {
      appendStalk(mesh, element, stem, base, stalk_radius, frame, young, piece);
    }
  }
  return model;
}

}  // namespace espalier::render
