#include "scenes/gallery/figures.h"

namespace espalier::scenes {

GalleryDocument tanaka2020() {
  return {
      .name = "tanaka_2020",
      .title = "Directed graphs by extended space colonization",
      .by = "T. Tanaka, T. Ito and T. Kikuchi, 2020 (in Japanese)",
      .about =
          "The report before that one: the same method with fewer controls, roots beside trunk and branches, "
          "and stones "
          "that crack along a tree. Figures 1 to 3 are a title picture and drawings of graphs.",
      .mark = "D",
      .figures = {
          {.name = "tanaka_2020_4",
           .title = "A graph by space colonization",
           .scene = "attractor_places",
           .pictures = {{"attractor_places", "graph", "", "Out-trees on and in a body"}},
           .rules = {},
           .paper = "A graph that space colonization makes: it has no loops, hangs together, and all of its "
                    "edges lead away "
                    "from the start, which makes it an out-tree.",
           .agrees = {"One start, no loops, every edge from an older node to a younger one."},
           .differs = {"What theirs grew in is not told."},
           .numbers = {{"Segments", "not told", Measured::segments}}},

          {.name = "tanaka_2020_5",
           .title = "Where points are placed",
           .scene = "attractor_places",
           .pictures = {{"attractor_places", "placed", "", "On a surface and in a volume"}},
           .rules = {},
           .paper = "Points on the surface of a model at random by area (left), and in its volume (right).",
           .agrees = {"The same two placings, side by side."},
           .differs = {"The body is a wren of ours."},
           .numbers = {}},

          {.name = "tanaka_2020_6",
           .title = "A narrow-band level set",
           .scene = "level_set",
           .pictures = {{"level_set", "level_set", "", "Signed distances near a surface"}},
           .rules = {},
           .paper = "The level set that tells a model's inside: active voxels near the surface alone.",
           .agrees = {"An OpenVDB level set with the same band."},
           .differs = {"Of a wren, and coloured."},
           .numbers = {}},

          {.name = "tanaka_2020_7",
           .title = "Groups of points",
           .scene = "attractor_places",
           .pictures = {{"attractor_places", "types", "", "Nodes and attractors"}},
           .rules = {},
           .paper = "Points in two groups, 0 and 1: starts, and what they connect to; on a surface and in a "
                    "volume.",
           .agrees = {"Both, in two colours, on a surface and in a volume."},
           .differs = {"Seen while trees grow."},
           .numbers = {}},

          {.name = "tanaka_2020_8",
           .title = "Nodes that are used many times",
           .scene = "nodes_again",
           .pictures = {{"nodes_again", "graph", "", "Left so, right mended"}},
           .rules = {},
           .paper = "The shape that comes of nodes which start edges again and again.",
           .agrees = {"The left tree is that shape."},
           .differs = {"Its remedy, a distance within which points are deleted, stands beside it."},
           .numbers = {}},

          {.name = "tanaka_2020_9",
           .title = "Growth by space colonization",
           .scene = "w_dome",
           .pictures = {{"w_dome", "step_5", "A", "After 5 iterations"},
                        {"w_dome", "step_15", "B", "After 15"},
                        {"w_dome", "step_30", "C", "After 30"},
                        {"w_dome", "step_45", "D", "After 45"}},
           .rules = {},
           .paper = "How the graph grows until no points can be connected any more.",
           .agrees = {"It ends when attractors are used up or none is in reach, and says which."},
           .differs = {"The space is a dome of ours."},
           .numbers = {}},

          {.name = "tanaka_2020_10",
           .title = "With a field, and without",
           .scene = "whorls",
           .pictures = {{"whorls", "ball_360", "A", "With a field"}, {"whorls", "ball_0", "B", "Without"}},
           .rules = {},
           .paper = "The same start with a vector field (left) and without (right).",
           .agrees = {"Whorls against spokes, from the same points and start."},
           .differs = {"Which angle theirs has is not told; ours is 360 degrees."},
           .numbers = {}},

          {.name = "tanaka_2020_11",
           .title = "Growth by a field",
           .scene = "whorls",
           .pictures = {{"whorls", "ball_360_10", "A", "10 steps"},
                        {"whorls", "ball_360_20", "B", "20"},
                        {"whorls", "ball_360_40", "C", "40"},
                        {"whorls", "ball_360", "D", "At the end"}},
           .rules = {},
           .paper = "Steps of growth in a vector field.",
           .agrees = {"Four steps of the same tree."},
           .differs =
               {"Limbs keep the length of a step; by the printed equation 16 the field would lengthen them."},
           .numbers = {}},

          {.name = "tanaka_2020_12",
           .title = "What can be modelled",
           .scene = "split_boulder",
           .pictures = {{"roots", "vines", "A", "A tree with its roots"},
                        {"lightning", "vines", "B", "Lightning"},
                        {"frost_pane", "vines", "C", "Frost"},
                        {"vessels", "vines", "D", "Vessels"},
                        {"split_boulder", "whole", "E", "A stone that cracked"},
                        {"split_boulder", "exploded", "F", "Its pieces"},
                        {"ivy_in_cracks", "vines", "G", "What grows in the cracks"}},
           .rules = {},
           .paper =
               "Models of the report: a tree of trunk, branches and roots, lightning, frost, vessels, and a "
               "body that is "
               "divided along a graph: its points nearer to a node than a threshold are deleted (3.7.5).",
           .agrees =
               {"Each of them; the threshold is the kerf, a key.",
                "A crack leaves several closed pieces, whose volumes add up to the stone's less the kerf's."},
           .differs = {"A stone is cut as a level set and not by deleting points, and by a sheet that the "
                       "tree is swept into.",
                       "Vessels have Murray's angles, which the report could not yet give them.",
                       "Ivy grows in the crack afterwards."},
           .numbers = {{"Time", "not told", Measured::time}}},
      }};
}

}  // namespace espalier::scenes
