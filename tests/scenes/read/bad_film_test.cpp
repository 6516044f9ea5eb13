#include <gtest/gtest.h>

#include <string>

#include "tests/scenes/read/bad_file.h"

namespace espalier::scenes {
namespace {

using tests::BadFile;

const std::string kBefore =
    "espalier: scene\nworld: {voxel: 1, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}\niterations: 50\n"
    "cameras: {front: {eye: [0, 0, 9], target: [0, 0, 0]}, side: {eye: [9, 0, 0], target: [0, 0, 0]}}\n";

// What follows after these four lines.
const std::vector<BadFile> kBadFilms = {
    {"no iterations between frames",
     "film: {every: 0}\n",
     {"5:15: film.every is '0', which is out of range; expected a whole number from 1 to 100000"}},
    {"a camera that is not there",
     "film: frnt\n",
     {"5:7: no camera is called 'frnt'; expected one of front, side; did you mean 'front'?"}},
    {"a camera that stands and moves",
     "film: {camera: front, path: [front, side]}\n",
     {"5:23: both camera and path are given; expected a camera that stands still, or a path"}},
    {"a path that leads nowhere",
     "film: {path: [side]}\n",
     {"5:8: a path of one camera leads nowhere; expected two or more, or camera: NAME"}},
    {"a path by a camera that is not there",
     "film: {path: [front, {camera: back}]}\n",
     {"5:31: no camera is called 'back'; expected one of front, side"}},
    {"waypoints out of order",
     "film: {path: [{camera: front, at: 0.2}, {camera: side, at: 0.9}, {camera: front, at: 0.5}]}\n",
     {"5:86: at 0.5 does not come after the one before, at 0.9; expected them in order, each later than"}},
    {"two waypoints at one time",
     "film: {path: [{camera: front, at: 0.2}, {camera: side, at: 0.2}]}\n",
     {"5:60: at 0.2 does not come after the one before, at 0.2; expected them in order"}},
    {"a waypoint beyond the end",
     "film: {path: [{camera: front, at: 0}, {camera: side, at: 1.5}]}\n",
     {"5:58: film.path[1].at is '1.5', which is out of range; expected a number from 0 to 1"}},
    {"a waypoint that does not say when",
     "film: {path: [{camera: front, at: 0}, side]}\n",
     {"5:39: this one does not say when (at), and others do; expected it of all of a path, or of none"}},
    {"a waypoint of no camera", "film: {path: [front, {at: 1}]}\n", {"...'camera'"}},
    {"an odd width",
     "film: {width: 641}\n",
     {"5:15: a film's width of 641 pixels is odd, and no film.mp4 can have that; expected width: 642"}},
    {"an odd height",
     "film: {height: 481}\n",
     {"5:16: a film's height of 481 pixels is odd, and no film.mp4 can have that; expected height: 482"}},
    {"no frames in a second",
     "film: {frames_per_second: 0}\n",
     {"5:27: film.frames_per_second is '0', which is out of range; expected a whole number from 1 to 120"}},
    {"a last frame that stands for less than nothing",
     "film: {hold: -1}\n",
     {"5:14: film.hold is '-1', which is out of range; expected a number from 0 to 60"}},
    {"an image with the film's name",
     "images: [{kind: vines, name: film_0001}]\nfilm: front\n",
     {"5:30: the film has the name 'film_0001'; expected another for the image"}},
    {"an unknown key", "film: {evry: 2}\n", {"5:8: unknown key 'evry'"}},
};

class BadFilm : public testing::TestWithParam<BadFile> {};

TEST_P(BadFilm, HasItsPlaceAndItsRemedy) {
  tests::expectMessages(GetParam(), "s.yaml", kBefore + GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(Corpus, BadFilm, testing::ValuesIn(kBadFilms), tests::testName);

TEST(BadFilmScene, HasNoCameras) {
  const BadFile bad{
      "no camera", "", {"3:1: a film needs a camera and the scene has none; expected cameras: {main:"}};
  tests::expectMessages(
      bad, "s.yaml",
      "espalier: scene\nworld: {voxel: 1, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}\nfilm: {every: 2}\n");
}

TEST(BadFilmScene, HasMoreFramesThanAnybodyWatches) {
  const BadFile bad{
      "frames",
      "",
      {"4:7: a frame every 1 of 100000 iterations makes 100001 frames; expected at most 10000: every: 11"}};
  tests::expectMessages(
      bad, "s.yaml",
      "espalier: scene\nworld: {voxel: 1, bounds: {min: [0, 0, 0], max: [1, 1, 1]}}\n"
      "iterations: 100000\nfilm: front\ncameras: {front: {eye: [0, 0, 9], target: [0, 0, 0]}}\n");
}

}  // namespace
}  // namespace espalier::scenes
