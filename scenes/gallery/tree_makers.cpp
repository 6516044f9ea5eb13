#include "scenes/gallery/figures.h"

namespace espalier::scenes {

GalleryDocument treeGen() {
  return {
      .name = "tree_gen",
      .title = "Trees by crown shapes",
      .by = "M. Prandini, D. Sforza and G. Varricchione, a program in C++",
      .about =
          "Space colonization under crowns that one chooses (cone, dome, cylinder, a Bezier profile), radii "
          "by pipes with an "
          "exponent of 2.05, pictures of leaves.",
      .mark = "",
      .figures = {
          {.name = "tree_gen_simple",
           .title = "A simple tree",
           .scene = "simple_tree",
           .pictures = {{"simple_tree", "vines", "", "DOME 2 6"}},
           .rules = {},
           .paper = "The first example: 800 attractors in a dome of 6 on a trunk of 2, with leaves.",
           .agrees = {"The same crown, attractors, lengths and number of iterations."},
           .differs = {"Leaves are drawn by the program, which needs no pictures from elsewhere.",
                       "Limbs see each other and the ground, and leaves take light."},
           .numbers = {{"Attractors", "800", Measured::said, "800"},
                       {"Segments", "not told", Measured::segments},
                       {"Time", "not told", Measured::time}}},
          {.name = "tree_gen_fir",
           .title = "A fir",
           .scene = "fir",
           .pictures = {{"fir", "vines", "", "CONE 2 10 5"}},
           .rules = {},
           .paper =
               "A cone of 10 by 5 on a trunk of 2, with a long reach (50 steps) and a picture of needles.",
           .agrees = {"The same crown and reach; sprays of needles."},
           .differs = {"Sprays stand in an order along their limbs."},
           .numbers = {{"Segments", "not told", Measured::segments}, {"Time", "not told", Measured::time}}},
          {.name = "tree_gen_cypress",
           .title = "A cypress",
           .scene = "cypress",
           .pictures = {{"cypress", "vines", "", "BEZIER 2 0 1 2 4.5 7 0.5 12 1"}},
           .rules = {},
           .paper = "1,000 attractors under a Bezier profile of 12 on a trunk of 2, with the picture of a "
                    "small branch.",
           .agrees = {"The same profile, from the four points that the command line names."},
           .differs = {"Shoots are drawn by the program."},
           .numbers = {{"Attractors", "1,000", Measured::said, "1,000"},
                       {"Segments", "not told", Measured::segments},
                       {"Time", "not told", Measured::time}}},
      }};
}

GalleryDocument splineTree() {
  return {
      .name = "spline_tree",
      .title = "Space colonization and generalized cylinders",
      .by = "I. Blancas, a program in Python",
      .about =
          "A tree's skeleton by space colonization, B-splines through it, and circles along them whose "
          "frames are carried "
          "without twist.",
      .mark = "",
      .figures = {
          {.name = "spline_tree_bare",
           .title = "A bare tree",
           .scene = "winter_tree",
           .pictures = {{"winter_tree", "tree", "A", "The tree"}, {"winter_tree", "forks", "B", "Its forks"}},
           .rules = {},
           .paper =
               "Uniform cubic B-splines with continuous curvature, circles in the planes of their tangents, "
               "frames that are "
               "turned by the quaternion between tangents, radii from the tips down, each reckoned once.",
           .agrees = {"The same curves and the same basis; frames are carried without twist; radii are the "
                      "pipes of all tips."},
           .differs =
               {"Limbs are joined at forks by collars and close at their tips: the surface is watertight.",
                "Bark is painted, and the tree stands in the light of a sky."},
           .numbers = {{"Segments", "not told", Measured::segments},
                       {"Triangles", "not told", Measured::triangles},
                       {"Time", "not told", Measured::time}}},
      }};
}

}  // namespace espalier::scenes
