#include <gtest/gtest.h>

#include <string>

#include "tests/scenes/read/bad_file.h"

namespace espalier::scenes {
namespace {

using tests::BadFile;

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
     {"2:16: voxels of 0.0001 m make a world of 1e+12; expected at most 1e+11 voxels, so at least 0.00022 "
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
     {"3:10: a mesh without a file; expected file: MESH.obj, or lines: [[[x, y, z],"}},
    {"lines and a file",
     "meshes: [{file: a.obj, lines: [[[0, 0, 0]]]}]\n",
     {"3:17: file means nothing to lines; expected one of them"}},
    {"solid lines",
     "meshes: [{lines: [[[0, 0, 0], [1, 0, 0]]], solid: true}]\n",
     {"3:51: solid means nothing to lines"}},
    {"a line of no place",
     "meshes: [{lines: [[]]}]\n",
     {"3:19: meshes[0].lines is an empty list; expected a list of lines, each a list of points [x, y, z]"}},
    {"a guide that stands nowhere",
     "meshes: [{file: a.obj, guide: true, tiled: false}]\n",
     {"3:31: a guide with tiled: false is felt by nobody"}},
    {"a solid guide",
     "meshes: [{file: a.obj, guide: true, solid: true}]\n",
     {"3:44: solid means nothing to a guide, which fills nothing"}},
    {"a picture of the sky that is not there",
     "sky: {background: {kind: picture, file: none.exr}}\n",
     {"3:41: there is no picture none.exr; expected one"}},
    {"a picture of the sky of another kind",
     "sky: {background: {kind: picture, file: a.obj}}\n",
     {"3:41: 'a.obj' is no picture that is known; expected .exr, .hdr, .png or .jpg"}},
    {"a picture without a file",
     "sky: {background: {kind: picture}}\n",
     {"3:7: kind: picture without a file; expected file: SKY.exr"}},
    {"a horizon of no gradient",
     "sky: {background: {kind: uniform, horizon: 0.5}}\n",
     {"3:44: horizon belongs to kind: gradient"}},
    {"a band without light",
     "sky: {background: {sun: {width: 12}}}\n",
     {"3:33: a band without brightness; expected brightness: 3 beside it"}},
    {"an image of what there is not",
     "images: [{kind: vines, show: [leaves]}]\ncameras: {main: {eye: [1, 1, 1], target: [0, 0, 0]}}\n",
     {"3:24: there is no 'leaves' to show; expected some of scene, stems, elements, guides"}},
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
     {"3:18: sky.weighting is 'cosin'; expected one of uniform, cosine, cie_overcast; did you mean "
      "'cosine'?"}},
    {"a sun that leans too far",
     "sun: {tilt: 120}\n",
     {"3:13: sun.tilt is '120', which is out of range; expected a number from 0 to 85 (degrees)"}},
    {"a shadow at night",
     "sun: {shadow_hour: 20}\n",
     {"3:20: the sun is not up at 20 h on the arc, where the shadows of pictures are drawn; expected "
      "shadow_hour: 6.1 to 17.9"}},
    {"a sky of two accuracies",
     "sky: {accuracy: 0.01, directions: 100}\n",
     {"3:35: both accuracy and directions are given; expected one of them"}},
    {"a sky that is too accurate",
     "sky: {accuracy: 0}\n",
     {"3:17: sky.accuracy is '0', which is out of range; expected a number from 0.001 to 0.5"}},
    {"an overcast sky that is too accurate",
     "sky: {weighting: cie_overcast, accuracy: 0.001}\n",
     {"3:42: a standard error of 0.001 for a cie_overcast sky would need more than 4096 directions; expected "
      "at least 0.0012"}},
    {"a sky of no directions",
     "sky: {directions: 0}\n",
     {"3:19: sky.directions is '0', which is out of range"}},
    {"rays on the lattice",
     "sky: {rays: 50}\n",
     {"3:13: rays mean nothing to sampling: lattice; expected accuracy, or sampling: random"}},
    {"directions at random",
     "sky: {sampling: random, directions: 64}\n",
     {"3:37: directions means nothing to sampling: random; expected rays"}},
    {"a real sun without a clock",
     "sun:\n  place: {latitude: 47, longitude: 8}\n  date: 2026-06-21\n",
     {"4:10: the key 'utc_offset' is missing here; expected a number from -14 to 14 (hours)"}},
    {"a real sun without a day",
     "sun:\n  place: {latitude: 47, longitude: 8, utc_offset: 1}\n",
     {"4:3: a place without a day; expected date: 2026-06-21, or dates: {from: 2026-03-21, to: 2026-09-23}"}},
    {"a day without a place",
     "sun: {date: 2026-06-21}\n",
     {"3:13: date belongs to a real sun; expected place: {latitude: 47.4, longitude: 8.5, utc_offset: 1} "
      "beside it"}},
    {"two suns at once",
     "sun:\n  tilt: 20\n  place: {latitude: 47, longitude: 8, utc_offset: 1}\n  date: 2026-06-21\n",
     {"4:9: tilt belongs to the inclined arc and place to the real sun; expected one of the two suns"}},
    {"a day and a range of days",
     "sun:\n  place: {latitude: 47, longitude: 8, utc_offset: 1}\n  date: 2026-06-21\n"
     "  dates: {from: 03-21, to: 06-21}\n",
     {"6:3: both date and dates are given; expected one of them"}},
    {"a day that does not exist",
     "sun:\n  place: {latitude: 47, longitude: 8, utc_offset: 1}\n  date: 2026-02-30\n",
     {"5:9: sun.date is '2026-02-30', which is a day that does not exist; expected a date such as "
      "2026-06-21, or 06-21 (of 2017)"}},
    {"a day the other way round",
     "sun:\n  place: {latitude: 47, longitude: 8, utc_offset: 1}\n  date: 21.6.2026\n",
     {"5:9: sun.date is '21.6.2026', which is no date; expected a date such as 2026-06-21"}},
    {"days that run back",
     "sun:\n  place: {latitude: 47, longitude: 8, utc_offset: 1}\n"
     "  dates: {from: 2026-06-21, to: 2026-03-21}\n",
     {"5:33: the last day is 2026-03-21 and the first 2026-06-21; expected it not to be before"}},
    {"two years of days",
     "sun:\n  place: {latitude: 47, longitude: 8, utc_offset: 1}\n"
     "  dates: {from: 2024-01-01, to: 2026-01-01}\n",
     {"4:3: a sun of 732 days; expected at most 366: a year"}},
    {"hours that run back",
     "sun:\n  place: {latitude: 47, longitude: 8, utc_offset: 1}\n  date: 06-21\n"
     "  hours: {from: 17, to: 9}\n",
     {"6:3: hours from 17 to 9; expected the first to be before the last"}},
    {"steps of nothing",
     "sun:\n  place: {latitude: 47, longitude: 8, utc_offset: 1}\n  date: 06-21\n  step: 0\n",
     {"6:9: sun.step is '0', which is out of range; expected a number from 1 to 1440 (minutes)"}},
    {"a sun at night",
     "sun:\n  place: {latitude: 47, longitude: 8, utc_offset: 1}\n  date: 2026-06-21\n"
     "  hours: {from: 0, to: 3}\n",
     {"4:3: sun at 47 N 8 E, 2026-06-21, 0 to 3 h: the sun is never up; expected a day or hours with sun"}},
    {"a polar night",
     "sun:\n  place: {latitude: 80, longitude: 8, utc_offset: 1}\n  date: 2026-12-21\n",
     {"4:3: sun at 80 N 8 E, 2026-12-21: the sun is never up; expected a day or hours with sun"}},
    {"shadows at night",
     "sun:\n  place: {latitude: 47, longitude: 8, utc_offset: 1}\n  date: 2026-06-21\n  shadow_hour: 23\n",
     {"6:16: the sun is not up at 23 h on 2026-06-21, where the shadows of pictures are drawn; expected "
      "shadow_hour: "}},
    {"a plant without rules",
     "plants: [{seeds: [[0, 0, 0]]}]\n",
     {"3:10: the key 'rules' is missing here; expected the path of a rule file, the name of one of the "
      "library, or a mapping of rule keys"}},
    {"a plant without seeds",
     "plants: [{rules: {}}]\n",
     {"3:10: a plant without seeds; expected seeds: [[x, y, z], ...], scatter"}},
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
    {"a keyed seed outside",
     "plants: [{rules: {}, seeds: [{key: a, at: [0, 7, 0]}]}]\n",
     {"3:39: the seed [0, 7, 0] lies outside the world"}},
    {"a seed without a place",
     "plants: [{rules: {}, seeds: [{key: a}]}]\n",
     {"3:30: the key 'at' is missing here; expected a point [x, y, z] (metres)"}},
    {"a seed with a stray key",
     "plants: [{rules: {}, seeds: [{at: [0, 0, 0], kye: a}]}]\n",
     {"3:46: unknown key 'kye'; expected one of at, key; did you mean 'key'?"}},
    {"a key of a seed given twice",
     "plants:\n  - rules: {}\n    seeds: [{at: [0, 0, 0], key: a}, [0, 0, 0], {at: [0, 1, 0], key: a}]\n"
     "  - {rules: {}, name: b, seeds: [{at: [0, 0, 0], key: a}]}\n",
     {"5:70: a second seed of this plant has the key 'a'; expected keys that differ"}},
    {"a key of a seed that goes on and on",
     "plants: [{rules: {}, seeds: [{at: [0, 0, 0], key: "
     "abcdefghijklmnopqrstuvwxyzabcdefghijklmnopqrstuvwxyzabcdefghijklmnopqrstuvwxyzabcdefghijklmnopqrstuvwxy"
     "z}]}]\n",
     {"3:51: plants[0].seeds[0].key is a text of 104 characters, more than 100; expected a text on one line, "
      "of "
      "at most 100 characters"}},
    {"a seed that is a word",
     "plants: [{rules: {}, seeds: [[0, 0, 0], door]}]\n",
     {"3:41: plants[0].seeds[1].at is 'door'; expected a point [x, y, z] (metres)"}},
    {"a seed of four",
     "plants: [{rules: {}, seeds: [[0, 0, 0, 0]]}]\n",
     {"3:30: plants[0].seeds[0].at has a list of 4 where three numbers should stand"}},
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
    {"a camera that is a word",
     "cameras: {main: front}\n",
     {"3:17: cameras.main is 'front'; expected a mapping with some of the keys eye, target, fov"}},
    {"a point for a list of points",
     "plants: [{rules: {}, seeds: [0, 0, 0]}]\n",
     {"3:29: plants[0].seeds has a list of single values where a list of points should stand"}},
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
     {"3:37: no image is called 'contact_sheet', as there is none; expected one in the scene"}},
    {"a cut through a portrait",
     "images: [{kind: attempts, at: 1 m}]\n",
     {"3:31: at means nothing to kind: attempts; expected it with kind: section or narrow_band"}},
    {"a plant in a section",
     "images: [{kind: section, plant: moss}]\n",
     {"3:33: plant means nothing to kind: section; expected it with kind: threshold"}},
    {"a plant that does not stand here",
     "plants: [{name: moss, rules: {}, seeds: [[0, 0, 0]]}]\ncameras: {a: {eye: [1, 1, 1], target: [0, 0, "
     "0]}}\n"
     "images: [{kind: threshold, plant: mos}]\n",
     {"5:35: no plant is called 'mos'; expected one of moss; did you mean 'moss'?"}},
    {"a moment of a vine",
     "cameras: {a: {eye: [1, 1, 1], target: [0, 0, 0]}}\nimages: [{kind: vines, iteration: 3}]\n",
     {"4:35: iteration means nothing to kind: vines; expected it with kind: points or graph"}},
    {"a moment before the beginning",
     "cameras: {a: {eye: [1, 1, 1], target: [0, 0, 0]}}\nimages: [{kind: graph, iteration: -1}]\n",
     {"4:35: images[0].iteration is '-1', which is out of range"}},
    {"points without any camera", "images: [points]\n", {"3:10: the image points needs a camera"}},
    {"a graph without any camera", "images: [graph]\n", {"3:10: the image graph needs a camera"}},
    {"a mesh in a section",
     "images: [{kind: section, mesh: wall}]\n",
     {"3:32: mesh means nothing to kind: section; expected it with kind: narrow_band"}},
    {"a narrow_band of a mesh that stands nowhere",
     "meshes: [{file: a.obj, name: wall}, {file: a.obj, name: ball, tiled: false}]\nimages: [{kind: "
     "narrow_band, "
     "mesh: ball}]\n",
     {"4:36: the mesh 'ball' stands nowhere (tiled: false); expected one of wall"}},
    {"a band of nothing",
     "images: [narrow_band]\n",
     {"3:10: a narrow_band of no mesh; expected one that stands in the scene's world"}},
    {"a band of an unknown mesh",
     "meshes: [{file: a.obj, name: wall}]\nimages: [{kind: narrow_band, mesh: wal}]\n",
     {"4:36: no mesh is called 'wal'; expected one of wall; did you mean 'wall'?"}},
    {"a section along w",
     "images: [{kind: section, axis: w}]\n",
     {"3:32: images[0].axis is 'w'; expected one of x, y, z"}},
    {"a rule's key", "bias: {up: 1}\n", {"3:1: unknown key 'bias'"}},
};

class BadScenes : public testing::TestWithParam<BadFile> {};

TEST_P(BadScenes, AreRefusedWithPlaceAndReason) {
  const std::string text = GetParam().text;
  const std::string world =
      text.starts_with("world") ? "" : "world: {voxel: 4 cm, bounds: {min: [-1, -1, -1], max: [1, 1, 1]}}\n";
  tests::expectMessages(GetParam(), "s.yaml", "espalier: scene\n" + world + text);
}

INSTANTIATE_TEST_SUITE_P(Corpus, BadScenes, testing::ValuesIn(kBadScenes), tests::testName);

TEST(BadHeaders, AreRefused) {
  const tests::Scratch scratch;
  const auto shown = [&](const std::string& text) {
    return scratch.shown(readRulesOrScene(scratch.write("f.yaml", text)).problems());
  };
  const std::string none =
      "f.yaml:1:1: the file does not say what it is; expected 'espalier: rules' or 'espalier: scene' first";
  EXPECT_EQ(shown(""), "f.yaml:1:1: an empty file; expected 'espalier: rules' or 'espalier: scene' first");
  EXPECT_EQ(shown("# only words\n---\n"),
            "f.yaml:1:1: an empty file; expected 'espalier: rules' or 'espalier: scene' first");
  EXPECT_EQ(shown("name: x\n"), none);
  EXPECT_EQ(shown("espallier: rules\n"), none + "; did you mean 'espalier'?");
  EXPECT_EQ(shown("- espalier: rules\n"), none + "; did you mean 'espalier'?");
  EXPECT_EQ(shown("espalier\n"), none + "; did you mean 'espalier'?");
  EXPECT_EQ(shown("espalier: rule\n"),
            "f.yaml:1:11: espalier is 'rule'; expected rules or scene; did you mean 'rules'?");
  EXPECT_EQ(shown("espalier: rules/2\n"),
            "f.yaml:1:11: the version '2' of the language; expected rules/1, the only one that there is");
  EXPECT_EQ(shown("espalier: [rules]\n"), "f.yaml:1:11: espalier is a list; expected rules or scene");
  for (const char* good :
       {"espalier: rules/1\n", "name: x\nespalier: rules\n", "'espalier': rules", "  espalier: rules",
        "# a comment\n\n---\n\"espalier\" : rules\n", "{espalier: rules}", "{name: x, espalier: rules}",
        "{\n  name: x,\n  espalier: rules\n}\n",
        "\xEF\xBB\xBF"
        "espalier: rules\r\n"})
    EXPECT_EQ(shown(good), "") << good;
  EXPECT_EQ(
      shown(std::string(
                "espalier: scene/1\nworld: {resolution: 9, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}\n") +
            "plants: [{rules: {}, seeds: [[0, 0, 0]]}]\n"),
      "");
}

/// Texts that nobody meant to show to whoever reads an error.
const std::vector<std::string> kForeign = {"root:x:0:0:root:/root:/bin/bash\nsecret:x:1:1::/:/bin/sh\n",
                                           "secret: [unclosed\n",
                                           "secret\n",
                                           "- secret\n",
                                           "a: 1\na: secret\nsecret: 2\n  b: 3\n",
                                           "\tsecret: 1\n",
                                           "secret \x01\xff\n",
                                           "services:\n  secret: 1\n  espalier: secret\n",
                                           "secret 12:03 espalier: stopped\n",
                                           "key: |\n  espalier: secret\n",
                                           "{secret: 1}\n",
                                           "%SECRET\nsecret: &secret *secret\n"};

TEST(ForeignFiles, AreNotRepeatedAndWhoAsksForThemIsNamed) {
  for (const std::string& text : kForeign) {
    const tests::Scratch scratch;
    const auto foreign = scratch.write("foreign", text).string();
    const auto expectSilence = [&](const std::string& shown, const std::string& place) {
      EXPECT_TRUE(shown.starts_with(place)) << shown << "\nof\n" << text;
      EXPECT_NE(shown.find("the file does not say what it is; expected 'espalier: rules'"), shown.npos)
          << shown;
      for (const char* word : {"secret", "SECRET", "root:", "0x", "U+00"})
        EXPECT_EQ(shown.find(word), shown.npos) << shown << "\nof\n" << text;
    };
    expectSilence(scratch.shown(readRulesOrScene(foreign).problems()), "foreign:1:1: the file");
    const auto asked = [&](const std::string& name, const std::string& file_text) {
      return scratch.shown(readRulesOrScene(scratch.write(name, file_text)).problems());
    };
    expectSilence(asked("r.yaml", "espalier: rules\nbase: foreign\n"), "r.yaml:2:7: foreign: the file");
    expectSilence(asked("r.yaml", "espalier: rules\notherwise: " + foreign + "\n"),
                  "r.yaml:2:12: foreign: the file");
    expectSilence(asked("r.yaml", "espalier: rules\nregions: {wall: ./foreign}\n"),
                  "r.yaml:2:17: foreign: the file");
    scratch.write("on.yaml", "espalier: rules\nname: on\nbase: foreign\n");
    expectSilence(asked("s.yaml",
                        "espalier: scene\nworld: {resolution: 9, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}\n"
                        "plants: [{rules: on.yaml, seeds: [[0, 0, 0]]}]\n"),
                  "on.yaml:3:7: foreign: the file");
  }
}

TEST(ForeignFiles, MayHaveNamesOfAnyLength) {
  const tests::Scratch scratch;
  const std::string name(70'000, 'x');
  for (const std::string& rules :
       {"base: " + name, "otherwise: " + name, "regions: {wall: ./" + name + "}",
        "regions: {" + name + ": {lenght: 1}}", "regions: {" + name + ": {length: 1000000 km}}", name + ": 1",
        "propagate: " + name, "length: " + name}) {
    const auto problems =
        readRulesOrScene(scratch.write("r.yaml", "espalier: rules\n" + rules + "\n")).problems();
    ASSERT_FALSE(problems.empty()) << rules.substr(0, 20);
    for (const auto& problem : problems) {
      const auto line = scratch.shown({problem});
      EXPECT_TRUE(line.starts_with("r.yaml:2:")) << line;
      EXPECT_LT(line.size(), 1100u) << line;
    }
  }
}

}  // namespace
}  // namespace espalier::scenes
