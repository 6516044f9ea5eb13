#include "scenes/show/graph_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "render/image/graph_drawing.h"
#include "render/image/legend.h"
#include "render/voxels/pale_scene.h"
#include "render/voxels/visibility.h"
#include "scenes/show/field_pictures.h"
#include "scenes/show/growth_graph.h"
#include "scenes/show/picture_memory.h"
#include "scenes/show/sight.h"
#include "sim/base/counted.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"

namespace espalier::scenes {
namespace {

bool same(const render::Camera& a, const render::Camera& b) {
  return a.eye_m == b.eye_m && a.target_m == b.target_m && a.fov_deg == b.fov_deg;
}

render::SwatchLegend legendOf(const render::PointGraph& graph, bool points) {
  render::SwatchLegend legend;
  const bool attracted = !graph.waiting.empty() || !graph.ended.empty();
  legend.title = !points ? "out-trees" : attracted ? "nodes and attractors" : "nodes";
  const render::GraphColours colours = render::graphColours();
  const auto count = [&](std::size_t many, sim::Colour colour, const char* one, const char* more) {
    if (many > 0) legend.swatches.push_back({colour, sim::counted(many, one, more)});
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

const UsedField& fieldOf(const PicturesWanted& wanted, const ImageSpec& image) {
  for (const UsedField& field : wanted.fields) {
    if (image.field.empty() || field.name == image.field) return field;
  }
  throw sim::InputError(fmt::format("image '{}' needs a field", image.name));
}

}  // namespace

struct GraphPictures::View {
  render::Camera camera;
  render::Image ground;
  std::optional<sim::Bricks> bricks;
  std::optional<Sight> sight;  // where the scene stands
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
  view->whole = growthGraph(finished_.grown != nullptr ? *finished_.grown : finished_.growth, frame);
  if (bare.count() > 0) {
    const sim::Bricks& bricks = view->bricks.emplace(bare);
    view->ground = render::paleScene(
        render::see(frame, bare, bricks, camera, wanted_.width_px, wanted_.height_px, mostFragments(wanted_)),
        bare);
    const Sight& sight = view->sight.emplace(finished_.world, bare, bricks, camera.eye_m);
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
  if (image.kind == ImageKind::field) {
    render::Image picture = view_->ground;
    const UsedField& field = fieldOf(wanted_, image);
    drawField(picture, ShownField(finished_.growth, field),
              image.caption.empty() ? "guide field " + field.name : image.caption, finished_.world.frame(),
              camera, view_->sight ? &*view_->sight : nullptr);
    return picture;
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
                    : "after " + sim::counted(static_cast<std::uint64_t>(iterations), "iteration");
  if (!view_->whole.sets.empty()) legend.note += "\nattractors: " + view_->whole.sets;
  render::drawLegend(picture, legend);
  return picture;
}

}  // namespace espalier::scenes
