#include <gtest/gtest.h>

#include <string>

#include "tests/scenes/read/bad_file.h"

/// What diffusion may not say.
namespace espalier::scenes {
namespace {

using tests::BadFile;
using tests::BadRules;

// Rule files begin with "espalier: rules" on line 1.
const std::vector<BadFile> kBadDiffusion = {
    {"nothing to lay",
     "propagate: diffusion\n",
     {"2:12: diffusion lays elements, and there are none; expected some under elements"}},
    {"an element without polygons",
     "propagate: diffusion\nelements: [{name: slab}]\n",
     {"3:12: an element without polygons; expected "}},
    {"edges of what does not lie flat",
     "propagate: diffusion\ndiffusion: {around: edges}\n"
     "elements: [{polygons: [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]}]\n",
     {"3:21: edges, and no element lies flat; expected elements with pose: surface, or another way around"}},
    {"steps that are not there",
     "propagate: diffusion\ndiffusion: {around: steps}\n"
     "elements: [{pose: surface, polygons: [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]}]\n",
     {"3:21: steps that are not there; expected steps: [[ALONG X, ALONG Y], ...]"}},
    {"steps for nothing",
     "propagate: diffusion\ndiffusion: {around: ring, steps: [[1 cm, 0]]}\n"
     "elements: [{pose: surface, polygons: [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]}]\n",
     {"3:27: steps beside another way around; expected around: steps, or no steps"}},
    {"a gap the wrong way round",
     "propagate: diffusion\ndiffusion: {gap: {min: 3 cm, max: 1 cm}}\n"
     "elements: [{pose: surface, polygons: [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]}]\n",
     {"3:24: diffusion.gap.min is 0.03 m and diffusion.gap.max is 0.01 m; expected the first to be at most"}},
    {"a fill of nothing",
     "propagate: diffusion\ndiffusion: {fill: 0}\n"
     "elements: [{pose: surface, polygons: [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]}]\n",
     {"3:19: diffusion.fill is '0', which is out of range; expected"}},
    {"a way around that nobody knows",
     "propagate: diffusion\ndiffusion: {around: edge}\n"
     "elements: [{pose: surface, polygons: [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]}]\n",
     {"3:21: diffusion.around is 'edge'; expected one of ring, gaussian, edges, steps; did you mean "
      "'edges'?"}},
    {"a body of two units",
     "elements:\n  - {thick: 2 cm, polygons: [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]}\n",
     {"3:13: a length beside polygons of plain numbers; expected a number, as they are"}},
    {"a body of two units, the other way",
     "elements:\n  - {thick: 2, polygons: [[[0, 0, 0], [1 cm, 0, 0], [0, 1 cm, 0]]]}\n",
     {"3:13: a number beside polygons of lengths; expected a length too, such as 3 cm"}},
    {"a way that other sets of a plant do not grow",
     "propagate: diffusion\n"
     "elements: [{pose: surface, polygons: [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]}]\n"
     "otherwise: {propagate: random_tree}\n",
     {"4:24: otherwise propagates otherwise than the rule set that it belongs to"}},
};

INSTANTIATE_TEST_SUITE_P(Diffusion, BadRules, testing::ValuesIn(kBadDiffusion), tests::testName);

}  // namespace
}  // namespace espalier::scenes
