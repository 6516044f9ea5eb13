#include "scenes/gallery/tanaka_2022.h"

#include <iterator>
#include <utility>

namespace espalier::scenes {

std::vector<GalleryFigure> tanaka2022Method() {
  return {
      {.name = "tanaka_2022_2",
       .title = "An out-tree by space colonization",
       .scene = "w_dome",
       .pictures = {{"w_dome", "step_15", "A", "After 15 iterations"},
                    {"w_dome", "step_30", "B", "After 30"},
                    {"w_dome", "graph", "C", "The out-tree"}},
       .rules = {},
       .paper = "The algorithm that the rest stands on, by Runions and others: attractors fill a space, each "
                "acts on the "
                "node nearest to it within a radius, nodes grow by a step towards the mean of what acts on "
                "them, and "
                "what they come near to dies. It ends when no attractor is left. The figure shows the tree.",
       .agrees =
           {"Equations 3 to 8 hold as they are printed; a test compares the front node for node with a plain "
            "version that is written from them.",
            "All edges lead away from the start: no loop, one root."},
       .differs =
           {"By default an attractor acts on its nearest node, as Runions has it; that a node picks its "
            "nearest "
            "attractor, as the text also says, is an option (acts: on_every_node).",
            "Two attractors that pull a node to and fro cannot keep it there: the original goes on for ever.",
            "The space is a dome of ours; theirs is not told."},
       .numbers = {{"Iterations", "not told", Measured::iterations},
                   {"Segments", "not told", Measured::segments}}},

      {.name = "tanaka_2022_3",
       .title = "A narrow-band level set",
       .scene = "level_set",
       .pictures = {{"level_set", "level_set", "", "A wren: signed distances within three voxels"}},
       .rules = {},
       .paper = "A body as OpenVDB has it: of a grid only the voxels near the surface are active, and hold "
                "how far it is, "
                "negative inside. What is inside of a body follows from it.",
       .agrees = {"The library is the same, and the grid is one of its level sets.",
                  "Active voxels lie in a band at either side of the surface; the others are background."},
       .differs = {"The body is a wren of ours.", "Colours tell outside (blue) and inside (orange)."},
       .numbers = {{"Voxels", "not told", Measured::world}}},

      {.name = "tanaka_2022_4",
       .title = "Attractors on a surface, and in a volume",
       .scene = "attractor_places",
       .pictures = {{"attractor_places", "placed", "", "Left on the surface, right in the inside"}},
       .rules = {},
       .paper =
           "Points strewn at random over a model's surface, by its area (left), and in its volume (right).",
       .agrees = {"Both on one body; on the surface evenly by area, in the inside evenly by volume."},
       .differs = {"A scene may also ask for points that keep a distance from each other (spacing).",
                   "The body is a wren of ours."},
       .numbers = {}},

      {.name = "tanaka_2022_5",
       .title = "Two types of points",
       .scene = "attractor_places",
       .pictures = {{"attractor_places", "types", "", "Nodes red, attractors that wait blue"}},
       .rules = {},
       .paper = "Points carry a type, 0 or 1: nodes, from which trees start, are red, and attractors blue. A "
                "point that is "
                "reached changes its type.",
       .agrees = {"The same colours for the same types.",
                  "A table of points may carry the types, which a scene picks by type."},
       .differs = {"The figure here shows both types while a tree grows; those that were reached are pale."},
       .numbers = {}},

      {.name = "tanaka_2022_6",
       .title = "A node that is used many times",
       .scene = "nodes_again",
       .pictures = {{"nodes_again", "graph", "", "Left without, right with a kill distance"}},
       .rules = {},
       .paper = "What goes wrong without the change of types: the same nodes start limbs again and again. "
                "Attractors within "
                "a radius of nodes are deleted against it.",
       .agrees =
           {"Left is that fault, by rules that allow it (repeated): limbs fan out from few nodes and cross.",
            "Right is the remedy: attractors within the kill distance die."},
       .differs = {"Both stand side by side."},
       .numbers = {}},

      {.name = "tanaka_2022_7",
       .title = "A guide field turns by more and more",
       .scene = "whorls",
       .pictures = {{"whorls", "figure_7", "", "0, 120, 360 and 720 degrees, step by step"}},
       .rules = {},
       .paper = "Directions from the nearest start are turned about the normal by quaternions, and added to "
                "a node's way "
                "(equations 9 to 13). At 0 degrees an out-tree only spreads, at 120 it whorls, at 360 "
                "tightly; each row "
                "shows steps of growth.",
       .agrees =
           {"0 degrees only spreads from the start.",
            "The more degrees, the tighter the whorls, as tests measure: mean winding rises with the angle."},
       .differs = {"By the printed equation 360 degrees would be the same as 0. The turn builds up with the "
                   "distance from "
                   "the start here, so that it is not.",
                   "A step keeps its length, which equation 13 does not say.",
                   "There is a row of 720 degrees as well."},
       .numbers = {{"Angles", "0, 120, 360 degrees", Measured::said, "0, 120, 360, 720 degrees"}}},

      {.name = "tanaka_2022_8",
       .title = "The same on a body",
       .scene = "whorls",
       .pictures = {{"whorls", "figure_8", "", "Wrens at 0, 120, 360 and 720 degrees"}},
       .rules = {},
       .paper = "An out-tree by a guide field on the surface of a model.",
       .agrees =
           {"Limbs keep to the surface and whorl over it; the axis is the surface's own normal everywhere."},
       .differs = {"The body is a wren of ours, at four angles."},
       .numbers = {}},

      {.name = "tanaka_2022_9",
       .title = "A guide field in a volume",
       .scene = "whorls_volume",
       .pictures = {{"whorls_volume", "step_15", "A", "Attractors and nodes after 15 steps"},
                    {"whorls_volume", "graph", "B", "0, 360 and 720 degrees"}},
       .rules = {},
       .paper = "For bodies whose inside is filled, the field fills a box of voxels around them; the tree "
                "winds through it.",
       .agrees = {"The field fills the body's bounding box, on a grid of voxels, and bends the tree inside."},
       .differs = {"The axis is the upright one, for all of the box.",
                   "Three angles side by side; theirs shows one."},
       .numbers = {}},
  };
}

GalleryDocument tanaka2022() {
  GalleryDocument document = {.name = "tanaka_2022",
                              .title = "Controllable Field Space Colonization",
                              .by = "T. Tanaka and others",
                              .about =
                                  "Space colonization whose fronts are bent by guide fields, and what can be "
                                  "modelled by its out-trees: trees, "
                                  "lightning, frost, vessels, land. Of this document we had the text; what "
                                  "its figures show follows from "
                                  "captions and sections.",
                              .mark = "C",
                              .figures = tanaka2022Method()};
  std::vector<GalleryFigure> models = tanaka2022Models();
  document.figures.insert(document.figures.end(), std::make_move_iterator(models.begin()),
                          std::make_move_iterator(models.end()));
  return document;
}

}  // namespace espalier::scenes
