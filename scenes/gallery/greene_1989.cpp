#include "scenes/gallery/figures.h"

namespace espalier::scenes {

GalleryDocument greene1989() {
  return {
      .name = "greene_1989",
      .title = "Voxel Space Automata",
      .by = "Ned Greene, SIGGRAPH 1989",
      .about = "How plants grow that sense a world of voxels: what is near, how much sun and sky they see.",
      .mark = "",
      .figures = {
          {.name = "figure_1",
           .title = "A polygon and a line in a space of 8 x 8 x 8 voxels",
           .scene = "figure_1",
           .pictures = {{"figure_1", "figure_1", "", "A polygon, a line and their voxels"}},
           .rules = {},
           .paper =
               "A cube of space cut into eight voxels a side, with a polygon and a line in it, and the "
               "voxels that "
               "stand for them. A voxel is tiled if the primitive passes through its cube. By such voxels "
               "growth senses its world.",
           .agrees =
               {"The same space, one polygon, one line.",
                "The same rule: a cube is occupied exactly if the primitive meets it. It is decided in whole "
                "numbers, without a tolerance."},
           .differs = {"Where the paper's polygon and line lie is not told; ours are our own.",
                       "We draw cubes that one can look into, with their shades on the walls, so that "
                       "polygon and line "
                       "are seen inside of them."},
           .numbers = {{"Voxels", "8 x 8 x 8", Measured::world},
                       {"Occupied voxels", "not told", Measured::occupied},
                       {"Time", "not told", Measured::time}}},

          {.name = "figure_2",
           .title = "A random walk in a flat world",
           .scene = "figure_2",
           .pictures = {{"figure_2", "figure_2", "", "Every trial, and the skeleton"}},
           .rules = {},
           .paper =
               "A tree's skeleton feels its way through a world that is one voxel thick. At the left all "
               "attempts to "
               "place a segment and the voxels that successful ones took: fans of lines are trials that "
               "failed. At "
               "the right the skeleton that came of it.",
           .agrees =
               {"Two frames with the same contents: trials that failed (red), voxels taken (green), the "
                "skeleton.",
                "Fans stand where limbs meet a wall or each other, as there."},
           .differs =
               {"We grow it among walls, of which the paper tells nothing, so that avoiding them is seen.",
                "Directions are drawn from a cone around the last segment; the paper names a distribution "
                "with "
                "parameters and does not give it."},
           .numbers = {{"Voxels", "not told", Measured::world},
                       {"Iterations", "not told", Measured::iterations},
                       {"Segments", "not told", Measured::segments},
                       {"Time", "not told", Measured::time}}},

          {.name = "figure_3",
           .title = "Biases and constraints around a column",
           .scene = "figure_3",
           .pictures = {{"figure_3a", "column_layers", "A", "Boundary layers"},
                        {"figure_3", "figure_3b", "B", "Upward bias"},
                        {"figure_3", "figure_3c", "C", "And proximity"},
                        {"figure_3", "figure_3d", "D", "And a helical twist"}},
           .rules = {},
           .paper =
               "A: a column in cross-section with four boundary layers around it, whose voxels know how "
               "near it is. "
               "B: growth with a slight bias upwards. C: the same, but on average the voxels of a segment "
               "must lie "
               "within two voxels of the column. D: biases upwards and to wind around it, and proximity.",
           .agrees = {"Four layers; in C and D nothing strays from the column, in B most of it does.",
                      "The twist pushes each trial to one side of the plane through the last segment and the "
                      "centre of "
                      "mass nearby, as the paper has it; all limbs wind the same way."},
           .differs = {"Three columns stand side by side in one world, each with three plants at its foot; "
                       "how many the "
                       "paper has is not told.",
                       "The column stands on a base, and stems are modelled with thickness and bark; sizes "
                       "and weights "
                       "of the biases are ours.",
                       "Our layers are counted over all 26 neighbours of a voxel, so that they grow squarer "
                       "outwards; "
                       "the paper says adjacent and leaves open how."},
           .numbers = {{"Boundary layers", "four", Measured::said, "four"},
                       {"Proximity of C and D", "two voxels on average", Measured::said,
                        "two voxels on average"},
                       {"Voxels", "not told", Measured::world},
                       {"Iterations", "not told", Measured::iterations},
                       {"Time", "not told", Measured::time}}},

          {.name = "figure_4",
           .title = "The rules of the vines",
           .scene = "garden_wall",
           .pictures = {{"garden_wall", "vines", "", "What these rules grow on a wall in the sun"}},
           .rules = "courtyard_vine",
           .paper = "The growth rules of figure 5's vines as a listing: 17 seeds at the base of the walls, "
                    "the limbs' "
                    "length, branching, upward bias and trials, how near to the wall they keep, how much "
                    "light they "
                    "need, "
                    "and a leaf of two polygons.",
           .agrees = {"Every number of the listing stands in our rule set, with the same meaning.",
                      "The leaf has the same ten corners."},
           .differs =
               {"Our words are others: each trial is bent by bias, rejected by require, and what is left "
                "is ranked "
                "by prefer.",
                "Three of the 17 seeds are printed; our courtyard has these and 14 of our own. Seeds "
                "belong to scenes, rules to plants.",
                "Our rules also say what the stem looks like. In the courtyard's bed, as that scene adds, "
                "vines branch less and grow steeper until they meet a wall.",
                "The paper has a listing here and no picture; ours is of the same rules on another wall, "
                "which looks to the sun."},
           .numbers = {{"Limb", "length 2.4", Measured::said, "length: 2.4"},
                       {"Branching", "branch_age_range 1 3, branch_angle 60", Measured::said,
                        "branch_age_range: [1, 3], branch_angle: 60"},
                       {"Upwards", "vertical_bias .08", Measured::said, "bias: up: 0.08"},
                       {"Trials", "no_of_trials_min 150, max 300", Measured::said,
                        "trials: {min: 150, max: 300}"},
                       {"Proximity", "seekprox 1.5, maxprox 3.0", Measured::said,
                        "prefer: proximity: 1.5, require: proximity: {max: 3.0}"},
                       {"Light", "blend sun=0.8 sky=0.2, exposure min=0.3 max=1.0, boost 1.8", Measured::said,
                        "blend: {sun: 0.8, sky: 0.2}, exposure: {min: 0.3, max: 1.0}, boost: 1.8"},
                       {"Leaves", "number_of_trials 30, expected_frequency 1.5", Measured::said,
                        "trials: 30, per_segment: 1.5"},
                       {"Segments", "not told", Measured::segments}}},

          {.name = "figure_5",
           .title = "The courtyard",
           .scene = "courtyard",
           .pictures = {{"courtyard", "vines", "", "The courtyard with vines, flowers and paving"}},
           .rules = {},
           .paper =
               "A walled court with a window in its tallest wall. Vines cover the walls where there is light "
               "enough, "
               "flowering plants lean away from the wall and into the open, and the floor is paved by tiles "
               "of "
               "three "
               "shapes that a growth program laid. The polygons were diced to the voxels and given their "
               "colours, "
               "found by 100 random rays to the sky from each voxel; this leaves grains of noise on the "
               "wall.",
           .agrees =
               {"The same world and the same 51 iterations; a wall with a window, behind which the sun's way "
                "lies; "
                "17 vines by figure 4's rules; flowers with a bias to the light; paving by diffusion from "
                "three "
                "shapes, on which nothing grows.",
                "Vines run along the tops of the walls and keep off their shaded faces, and their leaves are "
                "larger "
                "and more there, by the boost of the rules."},
           .differs = {"The court's walls, its bed, the camera and the colours are ours: the paper gives its "
                       "figure, "
                       "not "
                       "its mesh.",
                       "Stems and leaves are modelled and drawn by casting rays at triangles, with sharp "
                       "shadows of the "
                       "sun; light of the sky comes from voxels as there. (espalier grow --diced first_pass "
                       "makes the "
                       "diced model.)",
                       "The sky is sampled along 128 fixed directions without noise (sampling: random has "
                       "the paper's "
                       "grains).",
                       "Our model has many times the polygons, as stems are round and leaves are more."},
           .numbers = {{"Voxels", "165 x 150 x 195", Measured::world},
                       {"Iterations", "51", Measured::iterations},
                       {"Boundary layers", "four", Measured::said, "four"},
                       {"Vines", "17 seeds", Measured::said, "17 seeds"},
                       {"Polygons", "about 27,000", Measured::triangles},
                       {"Time", "about 30 hours on a sun4", Measured::time},
                       {"Rays to the sky", "100 at random", Measured::said, "128 directions of the lattice"},
                       {"Colours", "a nonlinear table that makes dark parts brighter", Measured::said,
                        "a tone curve that opens the shadows (Reinhard 2002), then sRGB"}}},

          {.name = "figure_6",
           .title = "The courtyard's light",
           .scene = "courtyard",
           .pictures = {{"courtyard", "sun_exposure", "A", "Sun exposure"},
                        {"courtyard", "sky_exposure", "B", "Sky exposure"},
                        {"courtyard", "threshold", "C", "Enough light for the vines"},
                        {"courtyard", "shadow_matte", "D", "Shadow matte"},
                        {"courtyard", "surface_colour", "E", "Surface colour"},
                        {"courtyard", "first_pass", "F", "First pass in colour"}},
           .rules = {},
           .paper =
               "Six pictures of the court's voxels, a cube for each. A: the share of the sun's way that "
               "each voxel "
               "sees in a day. B: the share of the sky. C: where both, blended, suffice for the vines; it "
               "fits where "
               "they grew. D: shadows at one time of day. E: colours without light. F: D and B blended, "
               "times E, to "
               "look like a first pass of radiosity.",
           .agrees = {"The same six panels of the same kind of cubes, in the same order.",
                      "C is the paper's blend of 0.8 sun and 0.2 sky, from 0.3 on. The vines keep to it: of "
                      "the tall "
                      "wall they cover the top and not the face, which the sun never reaches.",
                      "The sun's way leans 20 degrees from the vertical behind the wall with the window."},
           .differs = {"A and B have colour maps and legends in place of greys.",
                       "Exposure is judged by a surface's own normal and evened over neighbours, so that no "
                       "pattern of rays is left, which the paper finds in its own A and B.",
                       "The camera and the court are ours, as in figure 5."},
           .numbers = {{"Voxels", "165 x 150 x 195", Measured::world},
                       {"Occupied voxels", "not told", Measured::occupied},
                       {"Sun's way", "20 degrees from the vertical", Measured::said,
                        "20 degrees, 48 positions"},
                       {"Time", "not told", Measured::time}}},

          {.name = "figure_7",
           .title = "A tendril finds the brightest spot",
           .scene = "tendril",
           .pictures = {{"tendril", "sky_tables", "", "What its tip saw of the sky"},
                        {"tendril", "vines", "", "The tendril"}},
           .rules = {},
           .paper =
               "A single tendril begins inside of a cube with one side open. In each of five iterations a "
               "table of "
               "latitudes and longitudes says which directions are open to its tip (column A); it is "
               "multiplied with "
               "a table of the sky's brightness (B, and below it the sky alone) and filtered, and the "
               "tendril grows "
               "straight at the brightest spot, marked by a cross: out of the open side, and up to the top "
               "of the "
               "sun's way.",
           .agrees = {"Five iterations, the cube, the tables A and B with their crosses, the background at "
                      "the bottom "
                      "left.",
                      "It leaves by the open side, and from its third segment on keeps within 12 degrees of "
                      "the top of "
                      "the sun's way."},
           .differs = {"Our tables show the sky above the horizon, in cells of ten degrees; how fine the "
                       "paper's are is "
                       "not "
                       "told.",
                       "A third column shows the filtered table, where the spot is found.",
                       "How bright the paper's sky is, is only drawn; ours is a gradient with a band of "
                       "light along the "
                       "sun's way."},
           .numbers = {{"Iterations", "five", Measured::iterations},
                       {"Bias to the light", "1", Measured::said, "bias: light: 1.0"},
                       {"Filter", "Lambert's cosine over a hemisphere", Measured::said, "the same"},
                       {"Voxels", "not told", Measured::world},
                       {"Time", "not told", Measured::time}}},

          {.name = "figure_8",
           .title = "With and without a bias to the light",
           .scene = "clusters",
           .pictures = {{"clusters", "vines", "", "Left without, right with the bias"}},
           .rules = {},
           .paper =
               "Two clusters of plants by the same rules, but for the one on the right a bias of 0.15 to the "
               "brightest spot of the sky, which makes it look more natural. The paper claims no more for it "
               "than "
               "that.",
           .agrees =
               {"The same rules left and right but for that bias, with the paper's weight and its light: all "
                "sky, "
                "no sun, no limits.",
                "Limbs at the left lie down and run along the ground; at the right they rise. Tips there "
                "point "
                "15 degrees nearer to the brightest spot, as a test measures."},
           .differs =
               {"The plants' own rules are ours, as the paper does not print them.",
                "At so small a bias the difference is plain in the outline and mild in a single limb."},
           .numbers = {{"Bias to the light", "seeksun_bias 0.15", Measured::said, "bias: light: 0.15"},
                       {"Light", "blend sun=0.0 sky=1.0", Measured::said, "blend: {sun: 0.0, sky: 1.0}"},
                       {"Iterations", "not told", Measured::iterations},
                       {"Voxels", "not told", Measured::world},
                       {"Time", "not told", Measured::time}}},

          {.name = "figure_9",
           .title = "A building drawn out in limbs",
           .scene = "gable",
           .pictures = {{"gable", "foliage", "A", "With foliage"},
                        {"gable", "limbs", "B", "Without"},
                        {"gable", "sketch", "C", "The crude model"}},
           .rules = {},
           .paper =
               "A model of the film \"Organic Architecture\": limbs grow along a crude model of a gabled "
               "building "
               "(C), with a rule set for each of its regions. Near the gables they turn away from the "
               "apices of the "
               "arches, at the roof's edge they grow down for a few iterations and stop, and the railing's "
               "tracery "
               "is tracked line by line: a primary rule set branches where lines fork, a secondary one goes "
               "on where "
               "that fails. A is the whole model with foliage, B the same without.",
           .agrees =
               {"The same three panels; the crude model is followed and stands in nobody's way.",
                "The same regions with the same habits: gables, the roof's edge, arches and the railing, "
                "whose lines are drawn out by limbs that branch at its forks and nowhere else."},
           .differs =
               {"The building is a small one of our own: the paper shows its model and tells no measures.",
                "Of the railing's lines at most a twentieth is left undrawn, as a test allows.",
                "It is drawn as figure 5 is, by rays at triangles and not by diced polygons.",
                "The paper grew the film's model at one resolution and drew panel A at another; ours has "
                "one."},
           .numbers = {{"Voxels", "300 x 300 x 300 for the film; 180 x 150 x 180 for panel A",
                        Measured::world},
                       {"Polygons", "about 650,000", Measured::triangles},
                       {"Time", "about 35 hours on a sun4, for panel A", Measured::time},
                       {"Iterations", "not told", Measured::iterations},
                       {"Segments", "not told", Measured::segments}}},
      }};
}

}  // namespace espalier::scenes
