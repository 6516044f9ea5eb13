#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ostream>

#include "scenes/read_scene.h"
#include "tests/scenes/scratch.h"

/// A corpus of broken files: each with the place and the words that its author must be shown, and nothing
/// else.
namespace espalier::scenes {
namespace {

struct BadFile {
  const char* name;
  const char* text;
  std::vector<const char*>
      messages;  ///< the beginning ("3:8: unknown key 'x'") or, after "...", a part of each
};

void PrintTo(const BadFile& bad, std::ostream* out) {
  *out << bad.name;
}

const char* const kPlant = "plants: [{rules: {}, seeds: [[0, 0, 0]]}]\n";

// Rule files begin with "espalier: rules" on line 1.
const std::vector<BadFile> kBadRules = {
    // the words of the language
    {"misspelt key",
     "random_tree:\n  lenght: 2\n",
     {"3:3: unknown key 'lenght'; expected one of length, branch_age_range, branch_angle, wander, trials; "
      "did you mean 'length'?"}},
    {"unknown section",
     "requires: {}\n",
     {"2:1: unknown key 'requires'; expected one of espalier, name, base"}},
    {"unknown section, meant", "requires: {}\n", {"...did you mean 'require'?"}},
    {"American colour", "stem: {color: \"#ffffff\"}\n", {"...did you mean 'colour'?"}},
    {"Greene's seekprox", "random_tree: {seekprox: 1.5}\n", {"2:15: unknown key 'seekprox'"}},
    {"Greene's seekprox, meant",
     "random_tree: {seekprox: 1.5}\n",
     {"...did you mean 'prefer.proximity' (Greene's seekprox)?"}},
    {"Greene's maxprox", "maxprox: 3\n", {"...did you mean 'require.proximity.max' (Greene's maxprox)?"}},
    {"Greene's expected_frequency",
     "elements: [{expected_frequency: 1.5, polygons: [[[0,0,0],[1,0,0],[0,1,0]]]}]\n",
     {"...did you mean 'elements[].per_segment' (Greene's expected_frequency)?"}},
    {"Greene's upward bias",
     "bias: {vertical_bias: .08}\n",
     {"...did you mean 'bias.up' (Greene's vertical_bias)?"}},
    {"a key in the wrong place", "branch_angle: 60\n", {"...did you mean 'random_tree.branch_angle'?"}},
    {"a scene's key", "meshes: []\n", {"2:1: unknown key 'meshes'"}},
    {"merge key", "bias:\n  <<: {up: 1}\n", {"3:3: unknown key '<<'"}},
    {"unknown process",
     "propagate: random_trees\n",
     {"2:12: propagate is 'random_trees'; expected one of random_tree; did you mean 'random_tree'?"}},
    // numbers
    {"octal",
     "random_tree: {branch_angle: 010}\n",
     {"2:29: random_tree.branch_angle is '010', which starts with a zero, which some programs take for "
      "octal; expected a number from 0 to 180 (degrees)"}},
    {"hexadecimal", "light: {boost: 0x2}\n", {"2:16: light.boost is '0x2', which is no number"}},
    {"decimal comma",
     "light:\n  boost: 1,5\n",
     {"3:10: light.boost is '1,5', which is no number (a decimal point, not a comma)"}},
    {"not a number", "light: {boost: .nan}\n", {"2:16: light.boost is '.nan', which is no number"}},
    {"infinity", "light: {boost: .inf}\n", {"2:16: light.boost is '.inf', which is no number"}},
    {"too large", "light: {boost: 1e999}\n", {"2:16: light.boost is '1e999', which is too large"}},
    {"a unit where none can be",
     "random_tree: {branch_angle: 60 degrees}\n",
     {"2:29: random_tree.branch_angle is '60 degrees', which is no number"}},
    {"a number in quotes",
     "light: {boost: \"1.8\"}\n",
     {"2:16: light.boost is '1.8', which is text in quotes; expected a number from 0.1 to 10 (factor)"}},
    {"out of range",
     "bias: {up: 1.5}\n",
     {"2:12: bias.up is '1.5', which is out of range; expected a number from 0 to 1 (weight)"}},
    {"negative length",
     "random_tree: {length: -2}\n",
     {"2:23: random_tree.length is '-2', which is out of range; expected a length that is more than 0, at "
      "most 1000 (voxel widths)"}},
    {"no length at all",
     "random_tree: {length: 0}\n",
     {"2:23: random_tree.length is '0', which is out of range"}},
    {"a fraction of a trial",
     "random_tree: {trials: {min: 1.5}}\n",
     {"2:29: random_tree.trials.min is '1.5', which is no whole number; expected a whole number from 1 to "
      "100000 (trials)"}},
    {"a word for a number", "bias: {up: slightly}\n", {"2:12: bias.up is 'slightly', which is no number"}},
    {"nothing for a number",
     "bias:\n  up:\n  light: 1\n",
     {"3:3: bias.up has no value; expected a number from 0 to 1 (weight), a range [a, b] of such, or a "
      "curve"}},
    {"a list for a number",
     "light: {boost: [1, 2]}\n",
     {"2:16: light.boost is a list; expected a number from 0.1 to 10"}},
    {"a mapping for a number",
     "light: {boost: {max: 2}}\n",
     {"2:16: light.boost is a mapping; expected a number"}},
    {"yes for true",
     "require: {clear: yes}\n",
     {"2:18: require.clear is 'yes', which is neither; expected true or false"}},
    {"True for true",
     "require: {clear: True}\n",
     {"2:18: require.clear is 'True', which is neither; expected true or false"}},
    {"1 for true", "require: {clear: 1}\n", {"2:18: require.clear is '1', which is neither"}},
    // ranges, curves, lengths
    {"a range the wrong way round",
     "bias: {up: [0.5, 0.1]}\n",
     {"2:12: bias.up is a range from 0.5 down to 0.1"}},
    {"a range of three", "bias: {up: [0, 0.1, 0.2]}\n", {"2:12: bias.up is a list of 3"}},
    {"a range that leaves its bounds",
     "bias: {up: [0.5, 2]}\n",
     {"2:18: bias.up is '2', which is out of range"}},
    {"ages the wrong way round",
     "random_tree: {branch_age_range: [3, 1]}\n",
     {"2:33: random_tree.branch_age_range is a range from 3 down to 1; expected a whole number from 1 to "
      "10000 (iterations), or a range [a, b] of such"}},
    {"age zero",
     "random_tree: {branch_age_range: [0, 1]}\n",
     {"2:34: random_tree.branch_age_range is '0', which is out of range"}},
    {"a curve over nothing",
     "bias: {up: {points: [[0, 0], [1, 1]]}}\n",
     {"2:12: bias.up is a mapping without 'over'"}},
    {"a curve without points", "bias: {up: {over: age}}\n", {"2:12: bias.up is a mapping without 'points'"}},
    {"a curve over something unknown",
     "bias: {up: {over: ages, points: [[0, 0], [1, 1]]}}\n",
     {"2:19: bias.up.over is 'ages'; expected exposure, age (iterations) or height (metres); did you mean "
      "'age'?"}},
    {"a curve that turns back",
     "bias: {up: {over: age, points: [[0, 0], [5, 1], [5, 0.5]]}}\n",
     {"2:49: bias.up.points has x = 5 after 5; expected x to rise"}},
    {"a curve of one point",
     "bias: {up: {over: age, points: [[0, 0]]}}\n",
     {"2:32: bias.up.points is a list; expected a list of 2 to 256 points [x, y]"}},
    {"a curve out of bounds",
     "bias: {up: {over: age, points: [[0, 0], [5, 7]]}}\n",
     {"2:45: bias.up is '7', which is out of range"}},
    {"a curve with a stray key",
     "bias: {up: {over: age, point: [], points: [[0, 0], [5, 1]]}}\n",
     {"2:24: unknown key 'point' in a curve; expected over and points; did you mean 'points'?"}},
    {"an unknown unit",
     "random_tree: {length: 2 inches}\n",
     {"2:23: random_tree.length is '2 inches', which has no unit that is known (mm, cm, m, vx)"}},
    {"two units in a range",
     "random_tree: {length: [2, 12 cm]}\n",
     {"2:27: random_tree.length has '12 cm' after a number in another unit"}},
    // colours, elements
    {"an unquoted #",
     "stem:\n  colour: #a05f46\n",
     {"3:3: stem.colour has no value (an unquoted # begins a comment); expected a colour such as \"#4f7a2c\" "
      "in quotes"}},
    {"a colour's name", "stem: {colour: green}\n", {"2:16: stem.colour is 'green', which is no colour"}},
    {"a short colour", "stem: {colour: \"#fff\"}\n", {"2:16: stem.colour is '#fff', which is no colour"}},
    {"a colour in bytes",
     "stem: {colour: [160, 95, 70]}\n",
     {"2:17: stem.colour is '160', which is out of range", "2:22: stem.colour is '95'",
      "2:26: stem.colour is '70'"}},
    {"elements that are a mapping",
     "elements: {leaf: {trials: 3}}\n",
     {"2:11: elements is a mapping; expected a list, each entry a mapping with some of the keys name, "
      "trials"}},
    {"an element without polygons",
     "elements:\n  - name: leaf\n",
     {"3:5: the key 'polygons' is missing here; expected a list of polygons"}},
    {"an element of no polygons",
     "elements:\n  - name: leaf\n    polygons: []\n",
     {"4:5: an element without polygons; expected at least one"}},
    {"a polygon of two corners",
     "elements:\n  - polygons: [[[0,0,0],[1,0,0]]]\n",
     {"3:16: a polygon of 2 corners; expected at least 3"}},
    {"a polygon without area",
     "elements:\n  - polygons: [[[0,0,0],[1,0,0],[3,0,0]]]\n",
     {"3:16: a polygon without area"}},
    {"a polygon that repeats a corner",
     "elements:\n  - polygons: [[[0,0,0],[1,0,0],[1,0,0],[0,1,0]]]\n",
     {"3:16: corners 2 and 3 are the same point"}},
    {"a polygon that is not flat",
     "elements:\n  - polygons: [[[0,0,0],[1,0,0],[1,1,1],[0,1,0]]]\n",
     {"3:16: corner 1 lies 0.204 off the polygon's plane; expected a flat polygon"}},
    {"a corner of two numbers",
     "elements:\n  - polygons: [[[0,0,0],[1,0],[0,1,0]]]\n",
     {"3:25: elements[0].polygons has a list of 2 where three numbers should stand"}},
    {"two elements of one name",
     "elements:\n  - polygons: [[[0,0,0],[1,0,0],[0,1,0]]]\n  - polygons: [[[0,0,0],[1,0,0],[0,1,0]]]\n",
     {"4:5: two elements are named 'leaf'"}},
    {"a name with a slash",
     "elements:\n  - {name: ../leaf, polygons: [[[0,0,0],[1,0,0],[0,1,0]]]}\n",
     {"3:12: elements[0].name is '../leaf', which has characters that a file name should not have"}},
    // between keys
    {"trials the wrong way round",
     "random_tree:\n  trials: {min: 300, max: 150}\n",
     {"3:17: random_tree.trials.min is 300 and random_tree.trials.max is 150; expected the first to be at "
      "most the second"}},
    {"trials against the default",
     "random_tree:\n  trials: {max: 20}\n",
     {"3:17: random_tree.trials.min is 150 (by default) and random_tree.trials.max is 20; expected"}},
    {"exposure the wrong way round",
     "require: {exposure: {min: 0.8, max: 0.3}}\n",
     {"2:27: require.exposure.min is 0.8 and require.exposure.max is 0.3; expected the first to be less than "
      "the second"}},
    {"proximity the wrong way round",
     "require: {proximity: {min: 3, max: 3}}\n",
     {"2:28: require.proximity.min is 3 and require.proximity.max is 3"}},
    {"no light",
     "light: {blend: {sun: 0, sky: 0}}\n",
     {"2:9: both weights are 0; expected sun or sky to be more than 0"}},
    // rule sets within
    {"an empty section",
     "bias:\n",
     {"2:1: bias has no value; expected a mapping with some of the keys up, gravity, light, away, toward, "
      "twist"}},
    {"a section that is a word", "bias: up\n", {"2:7: bias is 'up'; expected a mapping"}},
    {"otherwise nothing",
     "otherwise:\n",
     {"2:1: otherwise is nothing; expected the path of a rule file, or a mapping of rule keys"}},
    {"otherwise a missing file",
     "otherwise: none.yaml\n",
     {"2:12: none.yaml: cannot be opened (No such file or directory)"}},
    {"a base that is a mapping",
     "base: {name: x}\n",
     {"2:7: base is a mapping; expected the path of a rule file, relative to this file"}},
    {"a base that is a scene",
     "base: scene.yaml\n",
     {"scene.yaml:1:11: this is a scene file; expected a rule file (espalier: rules)"}},
    {"regions that are a list",
     "regions: [wall]\n",
     {"2:10: regions is a list of 1; expected a mapping from region names to 'forbid'"}},
    {"a region that is forbiden",
     "regions: {wall: forbiden}\n",
     {"2:17: regions.wall is 'forbiden'; expected 'forbid', the path of a rule file, or a mapping of rule "
      "keys; did you mean 'forbid'?"}},
    {"a region with rules and more",
     "regions: {wall: {rules: {}, bias: {up: 1}}}\n",
     {"2:29: the key 'bias' beside 'rules', which names a whole rule set; expected it alone; did you mean "
      "'base' instead of 'rules'?"}},
    {"a bad key in a region", "regions: {wall: {bias: {upp: 1}}}\n", {"2:25: unknown key 'upp'"}},
    {"a bad number in an otherwise",
     "otherwise: {bias: {up: 3}}\n",
     {"2:24: bias.up is '3', which is out of range"}},
    // YAML itself
    {"a key given twice",
     "bias:\n  up: 0.1\n  light: 0.2\n  up: 0.3\n",
     {"5:3: the key 'up' stands here again, after line 3 column 3; expected each key once"}},
    {"a tag", "name: !!str x\n", {"2:7: the tag 'tag:yaml.org,2002:str'; expected plain values"}},
    {"a private tag", "bias: !mine {up: 1}\n", {"2:7: the tag '!mine'"}},
    {"an anchor and an alias",
     "name: &a x\nbias: {up: *a}\n",
     {"2:7: an anchor (&name)", "3:12: an alias (*name)"}},
    {"an unclosed quote", "name: \"vine\nbias: {up: 1}\n", {"...quote"}},
    {"a quote closed two lines on",
     "name: \"vine\nbias: x\"\n",
     {"2:7: a text in quotes that runs over the end of its line; expected a closing \" on the same line"}},
    {"an unclosed bracket",
     "bias: {up: [0, 1}\nname: x\n",
     {"2:17: a closing bracket that does not fit what is open here"}},
    {"a bracket too many",
     "bias: {up: 1}}\n",
     {"2:14: a closing bracket that does not fit what is open here"}},
    {"two colons", "name: a: b\n", {"2:8: a ':' where no key can stand"}},
    {"a tab", "bias:\n\tup: 1\n", {"3:1: a tab before the first word"}},
    {"two documents", "---\nname: x\n", {"2:1: something after the end of the mapping"}},
    {"a list as a key", "[a, b]: 1\n", {"2:1: a list as a key; expected a name"}},
    {"two lines of text", "name: |\n  a\n  b\n", {"2:7: name is 'a b ', which has more than one line"}},
    {"a NUL in disguise", "name: \"a\\0b\"\n", {"2:7: the text 'a b' has control characters"}},
    {"bytes that are no text", "name: \xfe\n", {"2:7: byte 0xfe is no UTF-8; expected text in UTF-8"}},
    {"several at once",
     "bias: {up: 2, lihgt: 1}\nlight: {boost: 99}\nname: ''\n",
     {"2:12: bias.up is '2'", "2:15: unknown key 'lihgt'", "3:16: light.boost is '99'",
      "4:7: name is empty"}},
};

// Scene files begin with "espalier: scene" on line 1 and have an empty world of 2 x 2 x 2 m on line 2, unless
// the text begins with "world".
const std::vector<BadFile> kBadScenes = {
    {"no world",
     "world:\n",
     {"2:1: world has no value; expected a mapping with some of the keys voxel, resolution"}},
    {"no voxel size",
     "world: {layers: 4, bounds: {min: [0,0,0], max: [1,1,1]}}\n",
     {"2:1: neither voxel nor resolution is given; expected voxel: 4 cm, or resolution: 200"}},
    {"two voxel sizes",
     "world: {voxel: 4 cm, resolution: 100, bounds: {min: [0,0,0], max: [1,1,1]}}\n",
     {"2:34: both voxel and resolution are given; expected one of them"}},
    {"no mesh",
     "world: {voxel: 4 cm}\n",
     {"1:1: no mesh and no world.bounds; expected at least one mesh, or the bounds of an empty world"}},
    {"an empty list of meshes", "world: {voxel: 4 cm}\nmeshes: []\n", {"3:1: no mesh and no world.bounds"}},
    {"bounds the wrong way round",
     "world: {voxel: 4 cm, bounds: {min: [0,0,0], max: [1,-1,1]}}\n",
     {"2:45: max.y is -1 and min.y is 0; expected max to be more than min"}},
    {"half the bounds",
     "world: {voxel: 4 cm, bounds: {min: [0,0,0]}}\n",
     {"2:30: the key 'max' is missing here; expected a point [x, y, z] (metres)"}},
    {"bounds and margin",
     "world: {voxel: 4 cm, margin: 1, bounds: {min: [0,0,0], max: [1,1,1]}}\n",
     {"2:30: both bounds and margin are given"}},
    {"a world that is too large",
     "world: {voxel: 0.1 mm, bounds: {min: [0,0,0], max: [1,1,1]}}\n",
     {"2:16: voxels of 0.0001 m make a world of 1e+12; expected at most 4e+09 voxels, so at least 0.00063 "
      "m"}},
    {"voxels in voxels",
     "world: {voxel: 2 vx, bounds: {min: [0,0,0], max: [1,1,1]}}\n",
     {"2:16: world.voxel is '2 vx', which is in voxel widths, which a scene does not know"}},
    {"no voxel at all",
     "world: {voxel: 0, bounds: {min: [0,0,0], max: [1,1,1]}}\n",
     {"2:16: world.voxel is '0', which is out of range"}},
    {"half a layer",
     "world: {voxel: 1, layers: 4.5, bounds: {min: [0,0,0], max: [1,1,1]}}\n",
     {"2:27: world.layers is '4.5', which is no whole number"}},
    {"a mesh without a file",
     "meshes: [{name: wall}]\n",
     {"3:10: the key 'file' is missing here; expected a path, relative to this file"}},
    {"a mesh that is not there",
     "meshes:\n  - file: none.obj\n",
     {"4:11: there is no mesh file none.obj; expected one, or optional: true"}},
    {"a mesh of another kind",
     "meshes: [wall.fbx]\n",
     {"3:10: 'wall.fbx' is no mesh file that is known; expected .obj, .gltf, .glb, .ply or .stl"}},
    {"two meshes of one name",
     "meshes: [{file: a.obj}, {file: sub/a.obj}]\n",
     {"3:25: a second one of the meshes is called 'a'"}},
    {"regions of a mesh",
     "meshes: [{file: a.obj, regions: materials}]\n",
     {"3:33: meshes[0].regions is 'materials'; expected one of group, material; did you mean 'material'?"}},
    {"a turn in two numbers",
     "meshes: [{file: a.obj, rotate: [0, 90]}]\n",
     {"3:32: meshes[0].rotate has a list of 2 where three numbers should stand"}},
    {"a sky of another kind",
     "sky: {weighting: cosin}\n",
     {"3:18: sky.weighting is 'cosin'; expected one of uniform, cosine; did you mean 'cosine'?"}},
    {"a sun that leans too far",
     "sun: {tilt: 120}\n",
     {"3:13: sun.tilt is '120', which is out of range; expected a number from 0 to 90 (degrees)"}},
    {"a shadow at night",
     "sun: {shadow_hour: 20}\n",
     {"3:20: sun.shadow_hour is '20', which is out of range; expected a number from 6 to 18 (hours)"}},
    {"a plant without rules",
     "plants: [{seeds: [[0, 0, 0]]}]\n",
     {"3:10: the key 'rules' is missing here; expected the path of a rule file, or a mapping of rule keys"}},
    {"a plant without seeds",
     "plants: [{rules: {}}]\n",
     {"3:10: a plant without seeds; expected seeds: [[x, y, z], ...] or scatter"}},
    {"a plant of no seeds", "plants: [{rules: {}, seeds: []}]\n", {"3:10: a plant without seeds"}},
    {"a plant of no rule file",
     "plants: [{rules: vine.yaml, seeds: [[0, 0, 0]]}]\n",
     {"3:18: vine.yaml: cannot be opened (No such file or directory)"}},
    {"a plant whose rules are a scene",
     "plants: [{rules: scene.yaml, seeds: [[0, 0, 0]]}]\n",
     {"scene.yaml:1:11: this is a scene file"}},
    {"bad rules in place",
     "plants: [{rules: {bias: {up: 2}}, seeds: [[0, 0, 0]]}]\n",
     {"3:30: bias.up is '2', which is out of range"}},
    {"a seed outside",
     "plants:\n  - rules: {}\n    seeds:\n      - [0, 0, 0]\n      - [0, 7, 0]\n",
     {"7:9: the seed [0, 7, 0] lies outside the world; expected it within [-1, -1, -1] and [1, 1, 1]"}},
    {"a seed of four",
     "plants: [{rules: {}, seeds: [[0, 0, 0, 0]]}]\n",
     {"3:30: plants[0].seeds has a list of 4 where three numbers should stand"}},
    {"two plants of one name",
     "plants: [{rules: {}, name: a, seeds: [[0,0,0]]}, {rules: {}, name: a, seeds: [[0,0,0]]}]\n",
     {"3:68: a second one of the plants is called 'a'"}},
    {"scattered without a count",
     "plants: [{rules: {}, scatter: {region: bed}}]\n",
     {"3:31: the key 'count' is missing here"}},
    {"scattering none",
     "plants: [{rules: {}, scatter: {region: bed, count: 0}}]\n",
     {"3:52: plants[0].scatter.count is '0', which is out of range"}},
    {"time that runs back",
     "iterations: -1\n",
     {"3:13: iterations is '-1', which is out of range; expected a whole number from 0 to 100000 "
      "(iterations)"}},
    {"a seed with a point", "seed: 1.0\n", {"3:7: seed is '1.0', which is no whole number"}},
    {"an image too small", "image: {width: 0}\n", {"3:16: image.width is '0', which is out of range"}},
    {"a camera without a target",
     "cameras: {main: {eye: [0, 0, 0]}}\n",
     {"3:17: the key 'target' is missing here"}},
    {"a camera that looks at itself",
     "cameras: {main: {eye: [0, 0, 1], target: [0, 0, 1]}}\n",
     {"3:34: the camera looks at the point where it stands"}},
    {"a camera list",
     "cameras: [{eye: [0,0,0], target: [1,1,1]}]\n",
     {"3:10: cameras is a list; expected a mapping from names, each to a mapping"}},
    {"an image of nothing known",
     "images: [vine]\n",
     {"3:10: images[0].kind is 'vine'; expected one of sun_exposure, sky_exposure"}},
    {"an image of nothing known, meant", "images: [vine]\n", {"...did you mean 'vines'?"}},
    {"an image without a kind", "images: [{name: x}]\n", {"3:10: the key 'kind' is missing here"}},
    {"an image without any camera",
     "images: [vines]\n",
     {"3:10: the image vines needs a camera and the scene has none"}},
    {"an image of an unknown camera",
     "cameras: {main: {eye: [0,0,0], target: [1,1,1]}}\nimages: [{kind: vines, camera: mian}]\n",
     {"4:32: no camera is called 'mian'; expected one of main; did you mean 'main'?"}},
    {"two images of one name",
     "cameras: {main: {eye: [0,0,0], target: [1,1,1]}}\nimages: [vines, {kind: vines}]\n",
     {"4:17: a second one of the images is called 'vines'"}},
    {"an image's name that leaves its folder",
     "images: [{kind: section, name: ../x}]\n",
     {"3:32: images[0].name is '../x', which has characters that a file name should not have"}},
    {"a sheet of nothing",
     "images: [contact_sheet]\n",
     {"3:10: a contact_sheet of no images; expected of: [name, ...]"}},
    {"a sheet of an unknown image",
     "images: [section, {kind: contact_sheet, of: [section, sectoin]}]\n",
     {"3:55: no image is called 'sectoin'; expected one of section; did you mean 'section'?"}},
    {"a sheet of itself",
     "images: [{kind: contact_sheet, of: [contact_sheet]}]\n",
     {"3:37: no image is called 'contact_sheet'; expected one of none"}},
    {"a cut through a portrait",
     "images: [{kind: attempts, at: 1 m}]\n",
     {"3:31: at means nothing to kind: attempts; expected it with kind: section"}},
    {"a section along w",
     "images: [{kind: section, axis: w}]\n",
     {"3:32: images[0].axis is 'w'; expected one of x, y, z"}},
    {"a rule's key", "bias: {up: 1}\n", {"3:1: unknown key 'bias'"}},
};

class BadFiles : public testing::TestWithParam<BadFile> {};
class BadScenes : public BadFiles {};

void expectMessages(const BadFile& bad, const std::string& name, const std::string& text) {
  const tests::Scratch scratch;
  scratch.write("scene.yaml", "espalier: scene\nworld: {voxel: 1, bounds: {min: [0,0,0], max: [1,1,1]}}\n");
  scratch.write("a.obj", "");
  scratch.write("sub/a.obj", "");
  const auto problems = checkFile(scratch.write(name, text));
  const auto shown = scratch.shown(problems);
  ASSERT_EQ(problems.size(), bad.messages.size()) << shown;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const std::string message = bad.messages[i];
    const auto line = scratch.shown({problems[i]});
    if (message.starts_with("...")) {
      EXPECT_NE(line.find(message.substr(3)), line.npos) << line;
    } else {
      const auto start = message.find(".yaml:") == message.npos || message.find(".yaml:") > message.find(' ')
                             ? name + ":" + message
                             : message;
      EXPECT_EQ(line.substr(0, start.size()), start);
    }
    EXPECT_TRUE(line.find("expected") != line.npos) << line;
  }
}

TEST_P(BadFiles, AreRefusedWithPlaceAndReason) {
  expectMessages(GetParam(), "r.yaml", std::string("espalier: rules\n") + GetParam().text);
}

TEST_P(BadScenes, AreRefusedWithPlaceAndReason) {
  const std::string text = GetParam().text;
  const std::string world =
      text.starts_with("world") ? "" : "world: {voxel: 4 cm, bounds: {min: [-1, -1, -1], max: [1, 1, 1]}}\n";
  expectMessages(GetParam(), "s.yaml", "espalier: scene\n" + world + text);
}

std::string testName(const testing::TestParamInfo<BadFile>& info) {
  std::string name;
  for (const char c : std::string(info.param.name))
    name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Rules, BadFiles, testing::ValuesIn(kBadRules), testName);
INSTANTIATE_TEST_SUITE_P(Scenes, BadScenes, testing::ValuesIn(kBadScenes), testName);

TEST(BadHeaders, AreRefused) {
  const tests::Scratch scratch;
  const auto shown = [&](const std::string& text) {
    return scratch.shown(checkFile(scratch.write("f.yaml", text)));
  };
  EXPECT_EQ(shown(""), "f.yaml:1:1: an empty file; expected 'espalier: rules' or 'espalier: scene' first");
  EXPECT_EQ(shown("# only words\n"),
            "f.yaml:1:1: an empty file; expected 'espalier: rules' or 'espalier: scene' first");
  EXPECT_EQ(
      shown("name: x\n"),
      "f.yaml:1:1: the file does not say what it is; expected 'espalier: rules' or 'espalier: scene' first");
  EXPECT_EQ(shown("espallier: rules\n"),
            "f.yaml:1:1: the file does not say what it is; expected 'espalier: rules' or 'espalier: scene' "
            "first; did you mean 'espalier'?");
  EXPECT_EQ(shown("espalier: rule\n"),
            "f.yaml:1:11: espalier is 'rule'; expected rules or scene; did you mean 'rules'?");
  EXPECT_EQ(shown("espalier: rules/2\n"),
            "f.yaml:1:11: the version '2' of the language; expected rules/1, the only one that there is");
  EXPECT_EQ(shown("espalier: [rules]\n"), "f.yaml:1:11: espalier is a list; expected rules or scene");
  EXPECT_EQ(shown("- espalier: rules\n"),
            "f.yaml:1:1: a list at the top; expected a mapping that begins with 'espalier: rules' or "
            "'espalier: scene'");
  EXPECT_EQ(shown("espalier\n"),
            "f.yaml:1:1: 'espalier' at the top; expected a mapping that begins with 'espalier: rules' or "
            "'espalier: scene'");
  EXPECT_EQ(shown("espalier: rules/1\n"), "");
  EXPECT_EQ(
      shown(std::string(
                "espalier: scene/1\nworld: {resolution: 9, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}\n") +
            kPlant),
      "");
}

}  // namespace
}  // namespace espalier::scenes
