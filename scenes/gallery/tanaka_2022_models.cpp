#include "scenes/gallery/tanaka_2022.h"

namespace espalier::scenes {

std::vector<GalleryFigure> tanaka2022Models() {
  return {
      {.name = "tanaka_2022_10",
       .title = "A tree by its parts",
       .scene = "broadleaf",
       .pictures = {{"broadleaf", "graph", "A", "Trunk, branches, twigs and roots"},
                    {"broadleaf", "foot", "B", "Swept stems"},
                    {"broadleaf", "vines", "C", "The tree"}},
       .rules = {},
       .paper = "Points in a volume, an out-tree for the trunk, others for branches that stand on the "
                "trunk's higher nodes "
                "along their normals, circles swept along all of them, as thick as nodes are old.",
       .agrees = {"Points fill volumes; stems are circles swept along the out-tree; branches leave the trunk "
                  "from a height on."},
       .differs = {"Orders of limbs are one front's: branches and twigs obey rules of their own, and no "
                   "second tree is set "
                   "onto the first.",
                   "Stems are as thick as the pipes of all their tips; by age is an option (stem: by: age).",
                   "It has leaves."},
       .numbers = {{"Segments", "not told", Measured::segments}, {"Time", "not told", Measured::time}}},

      {.name = "tanaka_2022_11",
       .title = "Lightning in the air",
       .scene = "lightning",
       .pictures = {{"lightning", "points", "A", "Attractors"},
                    {"lightning", "leader", "B", "The leader on its way"},
                    {"lightning", "graph", "C", "The out-tree"},
                    {"lightning", "vines", "D", "The bolt"}},
       .rules = {},
       .paper = "The process of a bolt in a volume: points, the out-tree, and its nodes moved by fractional "
                "Brownian motion "
                "(equation 14), which makes the way angular.",
       .agrees = {"The same three steps.",
                  "The noise is fractional Brownian motion of any Hurst exponent, as tests measure."},
       .differs =
           {"Limbs stay joined and keep out of solids when the noise moves them.",
            "The bolt lights cloud, land and houses by light that bounces, and it glows; theirs is a tube."},
       .numbers = {{"Time", "not told", Measured::time}}},

      {.name = "tanaka_2022_12",
       .title = "Lightning over a surface",
       .scene = "lightning_on_body",
       .pictures = {{"lightning_on_body", "points", "A", "Attractors on the surface"},
                    {"lightning_on_body", "vines", "B", "The discharge"}},
       .rules = {},
       .paper = "The same over a model's surface, from points that lie on it.",
       .agrees = {"The discharge hugs the body and branches over it."},
       .differs = {"The body is a wren of ours."},
       .numbers = {}},

      {.name = "tanaka_2022_13",
       .title = "Frost",
       .scene = "frost_pane",
       .pictures = {{"frost_pane", "points", "A", "Cores"},
                    {"frost_pane", "trunks", "B", "After 20 steps"},
                    {"frost_pane", "graph", "C", "The out-trees"},
                    {"frost_pane", "vines", "D", "Ice flowers"}},
       .rules = {},
       .paper = "Frost from its cores: a field that spreads from each start curls the trunks, and branches "
                "are set onto them.",
       .agrees = {"Cores, trunks that curl, ferns to both sides."},
       .differs = {"Side branches are the same front's, and crystals are elements that lie flat; none is set "
                   "on by height.",
                   "It grows on a window pane, drawn as ice."},
       .numbers = {}},

      {.name = "tanaka_2022_14",
       .title = "Radii and angles of forks",
       .scene = "vessels",
       .pictures = {{"vessels", "graph", "", "Out-trees whose forks have Murray's angles"}},
       .rules = {},
       .paper =
           "Murray's law: from the radii of a vessel and its two daughters follows the angle between these "
           "(equation 15), to which generated points are turned.",
       .agrees = {"The same equation; forks of the finished vessels are off by about one degree in the mean "
                  "over three radii."},
       .differs =
           {"Vessels are turned after they have grown and not while they do, so that none leaves the body.",
            "The figure there is a sketch of one fork; ours are those of a body."},
       .numbers = {}},

      {.name = "tanaka_2022_15",
       .title = "Vessels",
       .scene = "vessels",
       .pictures = {{"vessels", "points", "A", "Attractors in a body"},
                    {"vessels", "trunks", "B", "After 40 steps"},
                    {"vessels", "vines", "C", "Arteries and veins"}},
       .rules = {},
       .paper =
           "Vessels in the figure of a man: points in its volume, an out-tree from the heart, swept circles.",
       .agrees = {"The same steps, from one start at the heart."},
       .differs = {"Arteries and veins are two fronts that share no voxel.",
                   "The figure is modelled here, and simple."},
       .numbers = {{"Segments", "not told", Measured::segments}}},

      {.name = "tanaka_2022_16",
       .title = "Land after more and more iterations",
       .scene = "figure_16",
       .pictures = {{"figure_16", "figure_16", "", "After 20, 45 and 80 iterations, and at the end"}},
       .rules = {},
       .paper = "A comparison of numbers of iterations, beside the equation of sparse convolution noise. "
                "Whether those of the "
                "tree or of the noise are meant is not told.",
       .agrees = {"The same land at four numbers of iterations, side by side."},
       .differs = {"We compare the tree's: valleys reach farther back. Octaves of the noise are a key."},
       .numbers = {}},

      {.name = "tanaka_2022_17",
       .title = "From a tree to a mountain",
       .scene = "massif",
       .pictures = {{"massif", "tree", "A", "The tree in plan"},
                    {"massif", "plan", "B", "Its land from above"},
                    {"massif", "land", "C", "The mountain"}},
       .rules = {},
       .paper = "A tree is swept to a mesh and painted; where the paint is, land rises or falls, and sparse "
                "convolution noise "
                "(equation 16) makes its fine erosion.",
       .agrees = {"A tree becomes valleys, with ridges between them; the noise is the paper's, whose "
                  "spectrum a test holds to "
                  "its kernel's."},
       .differs = {"No paint is in between: lines rise by what they drain, and land rises from the nearest "
                   "of them, so that "
                   "water runs down from everywhere.",
                   "Noise leaves river beds alone."},
       .numbers = {{"Segments", "not told", Measured::segments}, {"Time", "not told", Measured::time}}},

      {.name = "tanaka_2022_18",
       .title = "What a guide field makes of a tree",
       .scene = "figure_18",
       .pictures = {{"figure_18", "graph", "", "Out-trees (a) to (d)"},
                    {"figure_18", "vines", "", "The trees"}},
       .rules = {},
       .paper = "(a) space colonization alone, (b) a field on the crown, (c) a strong one on the trunk, (d) "
                "one on the whole, "
                "in a crown that has the shape of the Stanford dragon.",
       .agrees = {"The same four trees, by one rule set and three fields."},
       .differs = {"The crown of (d) is a wren of ours."},
       .numbers = {}},

      {.name = "tanaka_2022_19",
       .title = "Beside an L-system",
       .scene = "pachira",
       .pictures = {{"lsystem_tree", "vines", "a", "An L-system's tree"},
                    {"pachira", "vines", "b", "A tree that twists"}},
       .rules = {},
       .paper = "(a) a tree by an L-system, (b) one by the method with a trunk that twists, as a pachira's "
                "does: no rules are "
                "to be written for it, and it comes in a single step.",
       .agrees = {"(a) is brought in as a skeleton that was made elsewhere; (b) twists by a strong field on "
                  "its trunks."},
       .differs = {"Four stems stand in a ring, as growers plait them."},
       .numbers = {}},

      {.name = "tanaka_2022_20",
       .title = "Frost on bubbles",
       .scene = "frost_bubble",
       .pictures = {{"frost_bubble", "vines", "", "0, 120, 360 and 720 degrees"}},
       .rules = {},
       .paper =
           "Bubbles that freeze at a rotation of (a) 0 degrees, (b) 120 from the bottom, (c) 360, (d) 720.",
       .agrees = {"The same angles; (b) begins at the bottom.", "The difference shows at a glance."},
       .differs = {"Bubbles lie on snow and are drawn as films that mirror."},
       .numbers = {{"Angles", "0, 120, 360, 720 degrees", Measured::said, "0, 120, 360, 720 degrees"}}},

      {.name = "tanaka_2022_21",
       .title = "Mountains and rivers",
       .scene = "ridges",
       .pictures = {{"massif", "land", "A", "Rivers between mountains"},
                    {"ridges", "land", "B", "A mountain by its ridges"},
                    {"mountain_forest", "vines", "C", "A wood on its slopes"}},
       .rules = {},
       .paper = "Examples of land by the method: shapes of mountains and rivers, which are trees in nature.",
       .agrees =
           {"Both: a tree of rivers with mountains between, and a tree of ridges with valleys between."},
       .differs = {"A wood grows on ours, by the same method again."},
       .numbers = {}},

      {.name = "tanaka_2022_22",
       .title = "Other objects",
       .scene = "branch_shell",
       .pictures = {{"coral", "vines", "A", "Coral"},
                    {"branch_shell", "vines", "B", "A hollow sculpture of branches"},
                    {"roads", "vines", "C", "Roads"},
                    {"delta", "vines", "D", "A river's delta"},
                    {"venation", "vines", "E", "Veins of leaves"}},
       .rules = {},
       .paper =
           "Other objects by the same out-trees. The text names none of them here; in its survey it tells of "
           "hollow "
           "sculptures of branches along a model's surface (2.4) and of roads from attraction points (2.2).",
       .agrees = {"Branches run along a body's surface and merge where they meet; several roots merge.",
                  "Roads come from attractors that a map of people strews, and close into loops."},
       .differs = {"Which objects theirs are we do not know: coral, delta and leaf are our choice."},
       .numbers = {}},
  };
}

}  // namespace espalier::scenes
