#include <gtest/gtest.h>

#include <string>

#include "tests/scenes/read/bad_file.h"

/// What bias, require and senses may not say.
namespace espalier::scenes {
namespace {

using tests::BadFile;
using tests::BadRules;

// Rule files begin with "espalier: rules" on line 1.
const std::vector<BadFile> kBadVerbs = {
    {"a sense that is not there",
     "senses: {crowd: {of: others}}\nbias: {senses: {crown: 0.1}}\n",
     {"3:24: the rule set has no sense 'crown'; expected one of crowd; did you mean 'crowd'?"}},
    {"a curve over a sense that is not there",
     "bias: {up: {over: crowd, points: [[0, 0], [1, 0.1]]}}\n",
     {"2:19: bias.up.over is 'crowd'; expected exposure, age (iterations), height (metres) or a sense"}},
    {"a curve over a misspelt sense",
     "senses: {crowd: {of: others}}\nbias: {up: {over: crown, points: [[0, 0], [1, 0.1]]}}\n",
     {"...a sense of this rule set: crowd; did you mean 'crowd'?"}},
    {"a height within something",
     "senses: {rise: {measure: height, within: 3}}\n",
     {"2:42: within says nothing of a height, which goes all the way down"}},
    {"how far a plant is from itself",
     "senses: {gap: {measure: distance, of: plants}}\n",
     {"2:39: the distance to plants is none, as a plant touches itself; expected others, scene, lines, "
      "surfaces or a region"}},
    {"a density of lines",
     "senses: {line: {of: lines}}\n",
     {"2:21: lines are too thin for it; expected measure: distance or nearness, or the voxels of another"}},
    {"a way along a sense that is not there",
     "senses: {gap: {of: others}}\nrequire: {along: {gas: {min: 1}}}\n",
     {"3:19: the rule set has no sense 'gas'; expected one of gap; did you mean 'gap'?"}},
    {"readings along a segment the wrong way round",
     "senses: {gap: {of: others}}\nrequire: {along: {gap: {min: 2, max: 1}}}\n",
     {"3:19: min is 2 and max is 1; expected the first to be at most the second"}},
    {"a fork a hundred and one segments away",
     "random_tree: {fork_apart: 101}\n",
     {"2:27: random_tree.fork_apart is '101', which is out of range"}},
    {"how far it is to everything",
     "senses: {gap: {measure: distance}}\n",
     {"2:25: the distance to everything is none, as a plant touches itself"}},
    {"a sense by a name that curves have",
     "senses: {age: {of: others}}\n",
     {"2:10: a sense named 'age', which curves have already; expected another name"}},
    {"readings the wrong way round",
     "senses: {gap: {of: others}}\nrequire: {senses: {gap: {min: 2, max: 1}}}\n",
     {"3:20: min is 2 and max is 1; expected the first to be at most the second"}},
    {"a light that is too strong",
     "bias: {light: -1.5}\n",
     {"2:15: bias.light.amount is '-1.5', which is out of range"}},
    {"a place and a way",
     "bias: {towards: [{point: [0, 0, 0], direction: [1, 0, 0], amount: 0.1}]}\n",
     {"2:18: expected either a point or a direction"}},
    {"no way at all",
     "bias: {towards: [{direction: [0, 0, 0], amount: 0.1}]}\n",
     {"2:19: [0, 0, 0] is no direction; expected one that leads somewhere"}},
    {"an unknown pose",
     "elements:\n  - texture: ivy\n    pose: hangs\n",
     {"4:11: elements[0].pose is 'hangs'; expected one of free, hang, stand, light, surface, aside; did you "
      "mean "
      "'hang'?"}},
    {"too much of a difference by height",
     "elements:\n  - {texture: ivy, varies: {height: 3.5}}\n",
     {"3:37: elements[0].varies.height is '3.5', which is out of range"}},
    {"a fork of none", "random_tree: {fork: 0}\n", {"2:21: random_tree.fork is '0', which is out of range"}},
    {"ages of growth the wrong way round",
     "require: {age: {min: 9, max: 3}}\n",
     {"2:22: require.age.min is 9 and require.age.max is 3; expected the first to be at most"}},
};

INSTANTIATE_TEST_SUITE_P(Verbs, BadRules, testing::ValuesIn(kBadVerbs), tests::testName);

}  // namespace
}  // namespace espalier::scenes
