#include <gtest/gtest.h>

#include <string>

#include "tests/scenes/read/bad_file.h"

namespace espalier::scenes {
namespace {

using tests::BadFile;

// As in bad_attractors_test.cpp, with a mesh and a plant that there are.
const std::vector<BadFile> kBadPieces = {
    {"a mesh that is not there",
     "pieces: {parts: {of: block, by: [vine], kerf: 3 cm}}\n",
     {"5:22: no mesh is called 'block'; expected one of rock"}},
    {"plants that are not there",
     "pieces: {parts: {of: rock, by: [ivy], kerf: 3 cm}}\n",
     {"5:33: no plant is called 'ivy'; expected one of vine"}},
    {"no plants", "pieces: {parts: {of: rock, by: [], kerf: 3 cm}}\n", {"5:28: cut by no plants; expected"}},
    {"no kerf",
     "pieces: {parts: {of: rock, by: [vine]}}\n",
     {"5:17: the key 'kerf' is missing here; expected a length"}},
    {"a kerf of nothing",
     "pieces: {parts: {of: rock, by: [vine], kerf: 0}}\n",
     {"5:46: pieces.parts.kerf is '0', which is out of range; expected a length"}},
    {"voxels that do not show the kerf",
     "pieces: {parts: {of: rock, by: [vine], kerf: 3 cm, voxel: 2 cm}}\n",
     {"5:59: a kerf of 0.03 m is less than 2 voxels of 0.02 m, which show it; expected a voxel of at most "
      "0.015 m"}},
    {"a name that no file can have",
     "pieces: {a/b: {of: rock, by: [vine], kerf: 3 cm}}\n",
     {"5:10: 'a/b' is no name of a file; expected letters, digits, _ and -, at most 100"}},
    {"the name of another file",
     "pieces: {plant: {of: rock, by: [vine], kerf: 3 cm}}\n",
     {"5:10: plant.glb is written by every run, or may be; expected another name"}},
    {"lines as a solid",
     "pieces: {parts: {of: wire, by: [vine], kerf: 3 cm}}\n",
     {"5:22: the mesh 'wire' is lines, which enclose nothing; expected a closed solid"}},
    {"pictures of pieces where there are none",
     "cameras: {main: {eye: [1, 1, 1], target: [0, 0, 0]}}\nimages: [{kind: vines, show: [pieces]}]\n",
     {"6:24: an image of pieces, and the scene has none; expected pieces: {NAME: {of: MESH, by: [PLANT]}}"}},
    {"nothing to move apart",
     "cameras: {main: {eye: [1, 1, 1], target: [0, 0, 0]}}\nimages: [{kind: vines, apart: 0.5}]\n",
     {"6:31: apart means nothing where no pieces are shown; expected it with show: [pieces]"}},
};

class BadPieces : public testing::TestWithParam<BadFile> {};

TEST_P(BadPieces, AreRefusedWithPlaceAndReason) {
  const std::string wire = GetParam().name == std::string("lines as a solid")
                               ? ", {name: wire, lines: [[[0, 0, 0], [1, 1, 1]]]}"
                               : "";
  tests::expectMessages(GetParam(), "s.yaml",
                        "espalier: scene\nworld: {voxel: 4 cm, bounds: {min: [-1, -1, -1], max: [1, 1, 1]}}\n"
                        "meshes: [{file: a.obj, name: rock}" +
                            wire + "]\nplants: [{name: vine, rules: {}, seeds: [[0, 0, 0]]}]\n" +
                            GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(Corpus, BadPieces, testing::ValuesIn(kBadPieces), tests::testName);

}  // namespace
}  // namespace espalier::scenes
