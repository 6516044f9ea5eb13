#include <gtest/gtest.h>

#include <string>

#include "tests/scenes/read/bad_file.h"

namespace espalier::scenes {
namespace {

using tests::BadFile;

// As in bad_scenes_test.cpp: what follows after "espalier: scene" and the line of an empty world.
const std::vector<BadFile> kBadAttractors = {
    {"a mesh that stands nowhere, and is solid",
     "meshes: [{file: none.obj, optional: true, tiled: false, solid: true}]\n",
     {"3:64: solid means nothing to a mesh with tiled: false; expected it without"}},
    {"no mesh that stands somewhere",
     "world: {voxel: 4 cm}\nmeshes: [{file: a.obj, tiled: false}]\n",
     {"3:1: no mesh and no world.bounds; expected at least one mesh"}},
    {"attractors from nowhere",
     "attractors:\n  crown: {count: 5}\n",
     {"4:3: attractors from nowhere; expected a solid such as dome: {radius: 6 m}, surface: MESH, inside: "
      "MESH, points: FILE or picture: {file: FILE, ...}"}},
    {"attractors from two places",
     "attractors: {crown: {dome: 6, at: [0, 0, 0], surface: wall}}\n",
     {"3:55: attractors by dome and surface; expected one of them"}},
    {"two solids",
     "attractors: {crown: {dome: 6, cone: {height: 1, radius: 1}, at: [0, 0, 0]}}\n",
     {"3:28: attractors by cone and dome; expected one of them"}},
    {"a solid that stands nowhere",
     "attractors: {crown: {dome: 6}}\n",
     {"3:14: a dome that stands nowhere; expected at: [x, y, z], where its foot is"}},
    {"no attractors",
     "attractors: {crown: {dome: 6, at: [0, 0, 0], count: 0}}\n",
     {"3:53: attractors.crown.count is '0', which is out of range; expected a whole number from 1 to "
      "10000000"}},
    {"a negative radius",
     "attractors: {crown: {dome: {radius: -6}, at: [0, 0, 0]}}\n",
     {"3:37: attractors.crown.dome.radius is '-6', which is out of range"}},
    {"a radius that is no number",
     "attractors: {crown: {dome: {radius: nan}, at: [0, 0, 0]}}\n",
     {"3:37: attractors.crown.dome.radius is 'nan', which is no length"}},
    {"an empty envelope",
     "attractors: {crown: {cone: {height: 0, radius: 2}, at: [0, 0, 0]}}\n",
     {"3:37: attractors.crown.cone.height is '0', which is out of range"}},
    {"a profile of three points",
     "attractors: {crown: {revolution: [[0, 1], [1, 1], [2, 1]], at: [0, 0, 0]}}\n",
     {"3:22: a profile of 3 points; expected four, the control points of a Bezier curve"}},
    {"a profile of five points",
     "attractors: {crown: {revolution: [[0, 1], [1, 1], [2, 1], [3, 1], [4, 1]], at: [0, 0, 0]}}\n",
     {"3:34: attractors.crown.revolution.profile has a list of 5, more than 4"}},
    {"a profile with a negative radius",
     "attractors: {crown: {revolution: {profile: [[0, 1], [1, -1], [2, 1], [3, 1]]}, at: [0, 0, 0]}}\n",
     {"3:57: attractors.crown.revolution.profile is '-1', which is out of range; expected a list of 1 to 4 "
      "points "
      "[a, b] (metres), b 0 to 100000"}},
    {"a profile that falls",
     "attractors: {crown: {revolution: {profile: [[0, 1], [2, 1], [1, 1], [3, 1]]}, at: [0, 0, 0]}}\n",
     {"3:22: a profile with the height 1 after 2; expected heights that do not fall"}},
    {"a profile without an inside",
     "attractors: {crown: {revolution: {profile: [[0, 0], [2, 0], [3, 0], [3, 0]]}, at: [0, 0, 0]}}\n",
     {"3:22: a profile without an inside; expected heights that rise and a radius above 0"}},
    {"a density of nothing",
     "attractors: {crown: {dome: 6, at: [0, 0, 0], density: [[0, 0], [1, 0]]}}\n",
     {"3:46: a density of 0 along the whole height; expected one above 0 somewhere"}},
    {"a density above the crown",
     "attractors: {crown: {dome: 6, at: [0, 0, 0], density: [[0, 1], [2, 1]]}}\n",
     {"3:46: a density of 1 at 2 of the height; expected a number of 0 or more at a share from 0 to 1"}},
    {"attractors on no mesh",
     "attractors: {crown: {surface: wall}}\n",
     {"3:31: no mesh is called 'wall', as there is none; expected one in the scene"}},
    {"attractors in another mesh",
     "meshes: [{file: walls.obj, optional: true}]\nattractors: {crown: {inside: wall}}\n",
     {"4:30: no mesh is called 'wall'; expected one of walls; did you mean 'walls'?"}},
    {"spacing in a solid",
     "attractors: {crown: {dome: 6, at: [0, 0, 0], spacing: 1}}\n",
     {"3:55: spacing means nothing to attractors by dome; expected it with a surface or a picture"}},
    {"waves without a spacing",
     "meshes: [{file: walls.obj, optional: true}]\nattractors: {crown: {surface: walls, count: 9, waves: "
     "2}}\n",
     {"4:55: waves means nothing to attractors by surface; expected it with a surface or a picture, and a "
      "spacing"}},
    {"a picture that is not there",
     "attractors: {towns: {picture: {file: none.png, top_left: [0, 0, 0], top_right: [1, 0, 0], bottom_left: "
     "[0, 0, 1]}}}\n",
     {"3:38: there is no picture none.png; expected one"}},
    {"a picture of another kind",
     "attractors: {towns: {picture: {file: towns.gif, top_left: [0, 0, 0], top_right: [1, 0, 0], "
     "bottom_left: [0, 0, 1]}}}\n",
     {"3:38: 'towns.gif' is no picture that is known; expected .exr, .hdr, .png or .jpg"}},
    {"a picture of two corners",
     "attractors: {towns: {picture: {file: none.png, top_left: [0, 0, 0], top_right: [1, 0, 0]}}}\n",
     {"3:31: the key 'bottom_left' is missing here; expected a point",
      "3:38: there is no picture none.png; expected one"}},
    {"a picture over a line",
     "attractors: {towns: {picture: {file: none.png, top_left: [0, 0, 0], top_right: [1, 0, 0], bottom_left: "
     "[2, 0, 0]}}}\n",
     {"3:22: a picture without an area; expected three corners that do not lie on one line",
      "3:38: there is no picture none.png; expected one"}},
    {"a spread in a picture, beside a mesh",
     "attractors: {towns: {surface: walls, picture: {file: none.png, top_left: [0, 0, 0], top_right: [1, 0, "
     "0], bottom_left: [0, 0, 1]}}}\n",
     {"3:38: attractors by surface and picture; expected one of them",
      "3:54: there is no picture none.png; expected one"}},
    {"waves in a picture without a spacing",
     "attractors: {towns: {waves: 2, picture: {file: none.png, top_left: [0, 0, 0], top_right: [1, 0, 0], "
     "bottom_left: [0, 0, 1]}}}\n",
     {"3:29: waves means nothing to attractors by picture; expected it with a surface or a picture, and a "
      "spacing",
      "3:48: there is no picture none.png; expected one"}},
    {"a density on a mesh",
     "meshes: [{file: walls.obj, optional: true}]\nattractors: {crown: {inside: walls, density: [[0, 1]]}}\n",
     {"4:37: density means nothing to attractors by inside; expected it with a solid"}},
    {"a type in a solid",
     "attractors: {crown: {dome: 6, at: [0, 0, 0], type: 1}}\n",
     {"3:52: type means nothing to attractors by dome; expected it with points"}},
    {"a type of seeds without a table",
     "plants: [{seeds: [[0, 0, 0]], type: 1, rules: {}}]\n",
     {"3:37: type means nothing without points; expected it with a table of points"}},
    {"a table of points that is not there",
     "attractors: {crown: {points: none.csv, count: 3}}\n",
     {"3:30: there is no table of points none.csv; expected one",
      "3:47: count means nothing to attractors by points; expected it with a solid, a mesh or a "
      "picture"}},
    {"an axis by no grid",
     "fields: {whorl: {axis: grid}}\n",
     {"3:10: an axis by a grid of no file; expected file: VOLUME.vdb"}},
    {"a volume that is not there",
     "fields: {whorl: {axis: grid, file: winds.vdb}}\n",
     {"3:36: there is no volume winds.vdb; expected one"}},
    {"a volume of another kind",
     "fields: {whorl: {axis: grid, file: winds.nvdb}}\n",
     {"3:36: 'winds.nvdb' is no volume that is known; expected a .vdb file"}},
    {"a grid beside a direction",
     "fields: {whorl: {grid: wind, file: winds.vdb}}\n",
     {"3:24: grid means nothing to another axis; expected it with axis: grid",
      "3:36: file means nothing to another axis; expected it with axis: grid",
      "3:36: there is no volume winds.vdb; expected one"}},
    {"a field within no mesh",
     "fields: {whorl: {within: crown}}\n",
     {"3:26: no mesh is called 'crown', as there is none; expected one in the scene"}},
    {"a table of points of another kind",
     "attractors: {crown: {points: points.xyz}}\n",
     {"3:30: 'points.xyz' is no table of points; expected a .csv file"}},
    {"rules that name other attractors",
     "attractors: {crown: {dome: 1, at: [0, 0, 0]}}\n"
     "plants: [{seeds: [[0, 0, 0]], rules: {propagate: colonization, colonization: {attractors: crowns}}}]\n",
     {"4:31: its rules name the attractors 'crowns'; expected one of crown; did you mean 'crown'?"}},
    {"rules that name attractors where there are none",
     "plants: [{seeds: [[0, 0, 0]], rules: {propagate: colonization, colonization: {attractors: crown}}}]\n",
     {"3:31: its rules name the attractors 'crown', and the scene has none; expected some under "
      "'attractors'"}},
    {"rules that name a field where there is none",
     "attractors: {crown: {dome: 1, at: [0, 0, 0]}}\n"
     "plants: [{seeds: [[0, 0, 0]], rules: {propagate: colonization, colonization: {attractors: crown, "
     "fields: [wind]}}}]\n",
     {"4:31: its rules name the fields 'wind', and the scene has none; expected some under 'fields'"}},
    {"attractors that are called as a crown is",
     "attractors: {crown of plant_1: {dome: 1, at: [0, 0, 0]}}\n"
     "plants: [{seeds: [[0, 0, 0]], rules: {propagate: colonization, colonization: {crown: {dome: 1}}}}]\n",
     {"3:14: the crown of the plants 'plant_1' is called so; expected another name"}},
    {"a field without a direction",
     "fields: {wind: {direction: [0, 0, 0]}}\n",
     {"3:17: a direction without length; expected one that is not [0, 0, 0]"}},
    {"a field in an empty box",
     "fields: {wind: {box: {min: [0, 1, 0], max: [1, 1, 1]}}}\n",
     {"3:17: a box without inside; expected each number of min to be less than that of max"}},
};

class BadAttractors : public testing::TestWithParam<BadFile> {};

TEST_P(BadAttractors, AreRefusedWithPlaceAndReason) {
  const std::string text = GetParam().text;
  const std::string world =
      text.starts_with("world") ? "" : "world: {voxel: 4 cm, bounds: {min: [-1, -1, -1], max: [1, 1, 1]}}\n";
  tests::expectMessages(GetParam(), "s.yaml", "espalier: scene\n" + world + text);
}

INSTANTIATE_TEST_SUITE_P(Corpus, BadAttractors, testing::ValuesIn(kBadAttractors), tests::testName);

}  // namespace
}  // namespace espalier::scenes
