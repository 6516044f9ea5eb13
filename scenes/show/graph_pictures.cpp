#include "scenes/show/graph_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "render/image/graph_drawing.h"
#include "render/image/legend.h"
#include "render/voxels/pale_scene.h"
#include "render/voxels/visibility.h"
#include "scenes/show/growth_graph.h"
#include "scenes/show/picture_memory.h"
#include "sim/base/parallel.h"
#include "sim/world/ray.h"

namespace espalier::scenes {
namespace {

/// Whether the scene stands between a place and the eye. A place in one of its surfaces is seen from before
/// that surface.
class Sight {
 public:
  Sight(const sim::World& world, const sim::BitVolume& bare, const sim::Bricks& bricks, sim::Vec3 eye_m)
      : world_(world), bare_(bare), bricks_(bricks), eye_vx_(sim::voxelFromWorld(world.frame(), eye_m)) {}

  bool hides(sim::Vec3 at_m) const {
    sim::Vec3 at = sim::voxelFromWorld(world_.frame(), at_m);
    const sim::Voxel voxel = sim::voxelAt(at);
    if (bare_.at(voxel)) {
      const auto surface = world_.surfaceAt(voxel);
      const sim::Vec3 normal = surface ? sim::Vec3(surface->normal) : sim::Vec3(0.0);
      at += (glm::dot(normal, eye_vx_ - at) < 0.0 ? -kBefore : kBefore) * normal;
    }
    const double distance = glm::length(at - eye_vx_);
    if (!(distance > kBefore)) return false;
    const auto hit = sim::firstHit(bare_, bricks_, eye_vx_, (at - eye_vx_) / distance);
    return hit && hit->t < distance - kBefore;
  }

 private:
  static constexpr double kBefore = 1.5;  ///< voxel widths: what is so near does not hide

  const sim::World& world_;
  const sim::BitVolume& bare_;
  const sim::Bricks& bricks_;
  sim::Vec3 eye_vx_;
};

bool same(const render::Camera& a, const render::Camera& b) {
  return a.eye_m == b.eye_m && a.target_m == b.target_m && a.fov_deg == b.fov_deg;
}

render::SwatchLegend legendOf(const render::PointGraph& graph, bool points) {
  render::SwatchLegend legend;
  const bool attracted = !graph.waiting.empty() || !graph.ended.empty();
  legend.title = !points ? "out-trees" : attracted ? "nodes and attractors" : "nodes";
  const render::GraphColours colours = render::graphColours();
  const auto count = [&](std::size_t many, sim::Colour colour, const char* one, const char* more) {
    if (many > 0) legend.swatches.push_back({colour, fmt::format("{} {}", many, many == 1 ? one : more)});
  };
  const auto starts = static_cast<std::size_t>(std::count_if(
      graph.nodes.begin(), graph.nodes.end(), [](const render::SpaceNode& node) { return node.parent < 0; }));
  if (points) {
    count(graph.nodes.size(), colours.node, "node", "nodes");
  } else {
    count(starts, colours.node, "start", "starts");
    count(graph.nodes.size() - starts, colours.edge, "segment", "segments");
  }
  count(graph.waiting.size(), colours.waiting, "attractor waits", "attractors wait");
  if (points) count(graph.ended.size(), colours.ended, "was reached or given up", "were reached or given up");
  return legend;
}

}  // namespace

struct GraphPictures::View {
  render::Camera camera;
  render::Image ground;
  GrowthGraph whole;
  render::GraphSizes sizes;
};

GraphPictures::GraphPictures(const PicturesWanted& wanted, const Finished& finished)
    : wanted_(wanted), finished_(finished) {}
GraphPictures::~GraphPictures() = default;

std::unique_ptr<const GraphPictures::View> GraphPictures::viewBy(const render::Camera& camera) const {
  const sim::Frame& frame = finished_.world.frame();
  const sim::BitVolume& bare = finished_.bare;
  auto view = std::make_unique<View>();
  view->camera = camera;
  view->whole = growthGraph(finished_.growth, frame);
  if (bare.count() > 0) {
    const sim::Bricks bricks(bare);
    view->ground = render::paleScene(
        render::see(frame, bare, bricks, camera, wanted_.width_px, wanted_.height_px, mostFragments(wanted_)),
        bare);
    const Sight sight(finished_.world, bare, bricks, camera.eye_m);
    const auto look = [&](auto& things) {
      sim::parallelForEach(
          things.size(), [&](std::size_t i) { things[i].point.hidden = sight.hides(things[i].point.at_m); });
    };
    look(view->whole.nodes);
    look(view->whole.attractors);
  } else {
    view->ground = render::paper(wanted_.width_px, wanted_.height_px);
  }
  render::PointGraph all;
  all.nodes = view->whole.nodes;
  for (const SeenAttractor& attractor : view->whole.attractors) all.waiting.push_back(attractor.point);
  view->sizes = render::sizesFor(all, camera, wanted_.width_px, wanted_.height_px);
  return view;
}

render::Image GraphPictures::draw(const ImageSpec& image, const render::Camera& camera) {
  if (!view_ || !same(view_->camera, camera)) {
    view_.reset();  // before the next takes as much
    view_ = viewBy(camera);
  }
  const int last = finished_.growth.iterations;
  const int iterations = std::min(image.iteration.value_or(last), last);
  const render::PointGraph graph = graphAfter(view_->whole, iterations);
  const bool points = image.kind == ImageKind::points;
  render::Image picture = view_->ground;
  (points ? render::drawPoints : render::drawGraph)(picture, graph, camera, view_->sizes);

  render::SwatchLegend legend = legendOf(graph, points);
  if (!image.caption.empty()) legend.title = image.caption;
  legend.note = iterations < last
                    ? fmt::format("after {} of {} iterations", iterations, last)
                    : fmt::format("after {} iteration{}", iterations, iterations == 1 ? "" : "s");
  if (!view_->whole.sets.empty()) legend.note += "\nattractors: " + view_->whole.sets;
  render::drawLegend(picture, legend);
  return picture;
}

}  // namespace espalier::scenes
