#include "render/model/plant_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/model/drawn_bark.h"
#include "render/model/drawn_leaf.h"
#include "render/model/leaf_feet.h"
#include "render/model/leaves.h"
#include "render/model/limbs.h"
#include "render/model/meeting_limbs.h"
#include "render/model/radii.h"
#include "render/model/stem_curves.h"
#include "render/model/stem_surface.h"
#include "render/model/tubes.h"
#include "sim/base/stop.h"

namespace espalier::render {
namespace {

using sim::NodeId;
using sim::Vec3;

constexpr double kBarkRadii = 50.0;  // width of a repeat of the bark, in radii of a twig
constexpr int kStalkSides = 3;
constexpr float kStalkGreen = 0.6f;  // how far they are coloured as leaves rather than as bark

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
  std::int32_t last() const { return last_; }

 private:
  std::int32_t last_ = 1;
};

/// How high on its plant an element stands, 0..1.
class Height {
 public:
  explicit Height(const sim::Plant& plant) {
    for (const sim::PlacedElement& element : plant.elements) {
      low_ = std::min(low_, element.position_vx.y);
      high_ = std::max(high_, element.position_vx.y);
    }
  }
  float of(const sim::PlacedElement& element) const {
    return high_ > low_ ? static_cast<float>((element.position_vx.y - low_) / (high_ - low_)) : 0.0f;
  }

 private:
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

/// How thick a stalk is: thinner than a twig, and in proportion to a small blade.
double stalkRadius(const sim::Plant& plant, const sim::PlacedElement& element, Vec3 base_vx) {
  const double blade_vx = glm::distance(base_vx, sim::placed(element, {0.0, 1.0, 0.0}));
  return std::min(0.55 * plant.girth.twig_vx, 0.02 * blade_vx);
}

/// A stalk from the stem to a blade that does not begin on it.
void appendStalk(ModelMesh& mesh, const sim::Plant& plant, const LeafFoot& foot, const sim::Frame& frame,
                 float youth, std::uint32_t piece) {
  if (foot.radius_vx == 0.0) return;
  const sim::PlacedElement& element = foot.element;
  const Vec3 base = sim::placed(element, bladeBase(plant.shapes[static_cast<std::size_t>(element.shape)]));
  const double radius_vx = stalkRadius(plant, element, base);
  if (glm::distance(foot.stem_vx, base) <= foot.radius_vx + radius_vx) return;
  const double radius_m = radius_vx * frame.voxel_m;
  const std::array<TubeStation, 2> line{
      TubeStation{sim::worldFromVoxel(frame, foot.stem_vx), radius_m, element.exposure, youth},
      TubeStation{sim::worldFromVoxel(frame, base), radius_m, element.exposure, youth}};
  appendTube(mesh, line, kStalkSides, piece);
}

/// By what its colour is multiplied where a stem is as young: what grew last has the colour of shoots.
std::vector<sim::Colour> shootTints(const ModelMesh& stems, sim::Colour shoots) {
  const sim::Colour share = shoots / glm::max(stems.base_colour, sim::Colour(1e-3f));
  std::vector<sim::Colour> tints;
  tints.reserve(stems.youths.size());
  for (const float youth : stems.youths) tints.push_back(glm::mix(sim::Colour(1.0f), share, youth * youth));
  return tints;
}

void putAsInstances(PlantModel& model, const sim::Plant& plant, const LeafFeet& feet,
                    const sim::Frame& frame) {
  model.instances.push_back(stalksAsInstances(model.stalks, kStalkSides));
  for (std::size_t shape = 0; shape < model.elements.size(); ++shape)
    model.instances.push_back(bladesAsInstances(model.elements[shape], plant, feet, shape, frame));
  std::erase_if(model.instances, [](const Instances& one) { return one.places.empty(); });
  model.stalks = {};
  model.elements.clear();
}

}  // namespace

std::size_t triangleCount(const PlantModel& model) {
  std::size_t count = model.stems.triangles.size() + model.stalks.triangles.size();
  for (const ModelMesh& blades : model.elements) count += blades.triangles.size();
  for (const Instances& one : model.instances) count += one.shape.triangles.size() * one.places.size();
  return count;
}

PlantModel modelPlant(const sim::Plant& plant, const sim::Frame& frame, const ModelOptions& options) {
  const std::vector<float> radii = stemRadii(plant.skeleton, plant.girth);
  Blocked blocked;
  if (options.walls != nullptr) blocked = [&](Vec3 p_vx) { return options.walls->at(sim::voxelAt(p_vx)); };
  const StemCurves curves = stemCurves(plant.skeleton, radii, blocked);
  const Youth youth(plant);
  const Height height(plant);

  LimbData data{plant.skeleton, radii, {}, {}};
  const Exposure exposure(plant.skeleton);
  for (NodeId n = 0; n < plant.skeleton.size(); ++n) {
    data.exposures.push_back(exposure.of(n));
    data.youths.push_back(youth.of(at(plant.skeleton.born, n)));
  }

  PlantModel model;
  const double twig_m = plant.girth.twig_vx * frame.voxel_m;
  const double error_m = options.error * twig_m;
  const std::vector<Limb> limbs = limbsOf(curves, data, frame, error_m);
  model.stems = surfaceOf(limbs, kBarkRadii * twig_m, error_m);
  model.meeting_limbs = meetingLimbs(limbs);
  if (!radii.empty())
    model.thinnest_m = static_cast<double>(*std::min_element(radii.begin(), radii.end())) * frame.voxel_m;
  model.last_birth = youth.last();
  model.name = plant.name;
  model.stems.name = plant.name + " stems";
  model.stems.base_colour = plant.stem_colour;
  model.stems.emits = plant.stem_emits;
  model.stems.emits_share = plant.stem_emits_share;
  model.stems.alpha = plant.stem_alpha;
  if (plant.shoot_colour) model.stems.tints = shootTints(model.stems, *plant.shoot_colour);
  model.stems.picture = plant.bark.empty() ? plant.bark_picture : drawnBark(plant.stem_colour);
  sim::throwIfStopped();

  model.stalks.name = plant.name + " stalks";
  model.stalks.base_colour = plant.stem_colour;
  model.stalks.alpha = plant.stem_alpha;
  if (!plant.shapes.empty())
    model.stalks.base_colour = glm::mix(plant.stem_colour, plant.shapes.front().colour, kStalkGreen);
  for (const sim::ElementShape& shape : plant.shapes) {
    model.elements.push_back({});
    model.elements.back().name = plant.name + " " + shape.name;
    model.elements.back().base_colour = shape.colour;
    model.elements.back().emits = shape.emits;
    model.elements.back().alpha = shape.alpha;
    model.elements.back().picture = shape.picture;
    model.elements.back().body = shape.body;
    if (!shape.drawn.empty()) model.elements.back().picture = drawnLeaf(shape.drawn, shape.colour);
  }
  const LeafFeet feet(plant, curves, limbs, frame, blocked);
  for (std::size_t e = 0; e < plant.elements.size(); ++e) {
    sim::throwIfStopped();
    const LeafFoot foot = feet.of(plant.elements[e]);
    const sim::PlacedElement& element = foot.element;
    const sim::ElementShape& shape = plant.shapes[static_cast<std::size_t>(element.shape)];
    ModelMesh& mesh = model.elements[static_cast<std::size_t>(element.shape)];
    const auto piece = static_cast<std::uint32_t>(e);
    const float young = youth.of(element.born);
    appendElement(mesh, element, shape, frame, {young, height.of(plant.elements[e])}, piece);
    appendStalk(model.stalks, plant, foot, frame, young, piece);
  }
  const auto orderOf = [&](const sim::PlacedElement& element) {
    const bool on_plant = element.node >= 0 && element.node < plant.skeleton.size();
    return on_plant ? curves.orderAt(element.node) : std::uint8_t{0};
  };
  const auto addOrders = [&](ModelMesh& mesh) {
    for (const std::uint32_t piece : mesh.pieces) mesh.orders.push_back(orderOf(plant.elements[piece]));
  };
  addOrders(model.stalks);
  for (ModelMesh& mesh : model.elements) addOrders(mesh);
  if (options.instances) putAsInstances(model, plant, feet, frame);
  return model;
}

}  // namespace espalier::render
