#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "render/image/camera.h"
#include "render/image/drawing.h"
#include "render/image/image.h"

/// Points and out-trees in space through a camera, drawn over a picture of display values with three
/// channels: as the nodes and attractors of space colonization are shown in Tanaka et al. 2022, figures 2 and
/// 5 to 10. What is near lies over what is far and is a little darker; what lies behind the eye is left out.
namespace espalier::render {

struct SpacePoint {
  sim::Vec3 at_m{0.0};
  bool hidden = false;  ///< something stands before it: it is drawn faintly
};

struct SpaceNode {
  SpacePoint point;
  std::int32_t parent = -1;  ///< its index, lower than its own; below 0 for a start
};

/// An out-tree or some, and points that are not of it.
struct PointGraph {
  std::vector<SpaceNode> nodes;
  std::vector<SpacePoint> waiting;  ///< attractors that pull, or would if a node came within reach
  std::vector<SpacePoint> ended;    ///< attractors that were reached or given up
};

/// How large things are drawn, so that several pictures of one growth show them alike.
struct GraphSizes {
  double point_m = 0.0;    ///< diameter of a point
  double start_m = 0.0;    ///< of a start
  double twig_m = 0.0;     ///< width of an edge that leads to an end
  double node_m = 0.0;     ///< diameter of a node on its edge; 0: so many stand there that none is drawn
  double nearest_m = 0.0;  ///< how far before the eye the nearest of all lies, and the farthest
  double farthest_m = 0.0;
};

/// Sizes that suit a picture of so many pixels and all that is ever drawn in it: by how closely it lies
/// there. What lies beside the picture has no say.
GraphSizes sizesFor(const PointGraph& all, const Camera& camera, int width_px, int height_px);

/// Nodes red, attractors that wait blue, those that have ended pale and below all others.
void drawPoints(Image& picture, const PointGraph& graph, const Camera& camera, const GraphSizes& sizes);

/// Edges dark, by the cube root of how many ends they lead to times as wide as a twig; nodes small and red,
/// starts larger, attractors that wait faint and blue.
void drawGraph(Image& picture, const PointGraph& graph, const Camera& camera, const GraphSizes& sizes);

/// The colours of a legend, display values.
struct GraphColours {
  sim::Colour node, waiting, ended, edge;
};
GraphColours graphColours();

}  // namespace espalier::render
