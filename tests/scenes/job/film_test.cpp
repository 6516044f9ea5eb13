// Growth as a film.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "scenes/film.h"
#include "scenes/job/run.h"
#include "scenes/read/read_scene.h"
#include "scenes/write/video.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "tests/scenes/job/changed_scene.h"
#include "tests/support/scratch.h"

namespace espalier::scenes {
namespace {

using Files = std::map<std::string, std::string>;

/// The files of a film in a folder, with their bytes.
Files filmIn(const std::filesystem::path& folder) {
  Files files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto path = entry.path();
    if (isOfFilm(path.stem().string())) files[path.filename()] = tests::fileText(path);
  }
  return files;
}

/// Of a .png, without what its header says of it.
std::string pixelsOf(const std::string& png) {
  return png.substr(png.find("IDAT"));
}

class FilmOfGrowth : public testing::Test {
 protected:
  void SetUp() override {
    scratch_.write("plot.obj", tests::kChangedMesh);
    scratch_.write("paint.mtl", "newmtl stone\nKd 0.5 0.5 0.5\nnewmtl brick\nKd 0.6 0.2 0.1\n");
    scratch_.write("vine.yaml",
                   "espalier: rules\nrandom_tree: {length: 1.5, trials: {min: 4, max: 20}}\n"
                   "elements: [{polygons: [[[0, 0, 0], [1, 0, 0], [0, 1, 0]]]}]\n");
  }

  Scene sceneWith(const std::string& more) {
    auto scene = readScene(scratch_.write("scene.yaml", tests::kChangedScene + more));
    EXPECT_TRUE(scene) << format(scene.problems());
    return *scene;
  }

  RunOptions into(const std::string& folder) {
    RunOptions options;
    options.folder = scratch_.path(folder);
    options.on_warning = [this](const Problem& warning) { warnings_.push_back(format(warning)); };
    return options;
  }

  Files filmOf(const std::string& more, const std::string& folder = "out") {
    report_ = runScene(sceneWith(more), into(folder));
    return filmIn(scratch_.path(folder));
  }

  tests::Scratch scratch_;
  std::vector<std::string> warnings_;
  Report report_;
};

const std::string kFilm = "film: {every: 2, camera: main, width: 40, height: 30}\n";

TEST_F(FilmOfGrowth, ShowsEveryNthIterationAndWhatIsThereInTheEnd) {
  Files film = filmOf("film: {every: 4, width: 40, height: 30}\n");
  EXPECT_EQ(film.erase(kFilmFile), ffmpegProgram().empty() ? 0u : 1u);
  ASSERT_EQ(film.size(), 3u);  // after 0, 4 and 6 iterations
  EXPECT_FALSE(pixelsOf(film["film_0000.png"]) == pixelsOf(film["film_0001.png"]));
  EXPECT_FALSE(pixelsOf(film["film_0001.png"]) == pixelsOf(film["film_0002.png"]));
  EXPECT_EQ(report_.film->frames, 3u);
  EXPECT_DOUBLE_EQ(report_.film->seconds, 3.0 / 12.0 + 1.0);
  const std::string told = summary(report_, "out");
  EXPECT_NE(told.find("out/film_0000.png .. film_0002.png\n"), told.npos) << told;
  EXPECT_EQ(told.find("out/film_0001.png"), told.npos) << told;
  const auto json = nlohmann::json::parse(toJson(report_));
  EXPECT_EQ(json["film"]["frames"], 3);
  const auto files = json["files"].get<std::vector<std::string>>();
  EXPECT_NE(std::find(files.begin(), files.end(), "film_0001.png"), files.end());
}

/// But for what its header says of itself, the last frame is the picture of all that grew.
TEST_F(FilmOfGrowth, EndsWithThePicture) {
  for (const std::string light : {"", "interreflection: {passes: 3, directions: 12}\n"}) {
    const Files film = filmOf("film: {every: 9, camera: main, width: 40, height: 30}\n" + light);
    EXPECT_TRUE(pixelsOf(film.at("film_0001.png")) == pixelsOf(tests::fileText(scratch_.path("out/a.png"))))
        << light;
    EXPECT_FALSE(pixelsOf(film.at("film_0000.png")) == pixelsOf(film.at("film_0001.png")));
  }
}

/// Before anything has grown, a plant that shines lights nothing; in the end, all that it does in the
/// picture.
TEST_F(FilmOfGrowth, WhatShinesLightsAsFarAsItHasGrown) {
  const std::string more =
      "film: {every: 2, camera: main, width: 40, height: 30}\ninterreflection: {passes: 2, directions: 60}\n";
  const auto with = [&](const char* stem) {
    scratch_.write("vine.yaml", std::string("espalier: rules\nstem: {radius: 0.4, ") + stem + "}\n");
    Files film = filmOf(more);
    EXPECT_TRUE(pixelsOf(film.at("film_0003.png")) == pixelsOf(tests::fileText(scratch_.path("out/a.png"))));
    return film;
  };
  const Files dim = with("emits: {strength: 1}"), bright = with("emits: {strength: 9}");
  EXPECT_TRUE(pixelsOf(dim.at("film_0000.png")) == pixelsOf(bright.at("film_0000.png")));
  EXPECT_FALSE(pixelsOf(dim.at("film_0003.png")) == pixelsOf(bright.at("film_0003.png")));
}

TEST_F(FilmOfGrowth, FollowsItsCamera) {
  const Files still = filmOf(kFilm),
              moves = filmOf("film: {every: 2, path: [main, other], width: 40, height: 30}\n", "moves");
  EXPECT_TRUE(pixelsOf(still.at("film_0000.png")) == pixelsOf(moves.at("film_0000.png")));
  EXPECT_FALSE(pixelsOf(still.at("film_0001.png")) == pixelsOf(moves.at("film_0001.png")));
  EXPECT_FALSE(pixelsOf(still.at("film_0003.png")) == pixelsOf(moves.at("film_0003.png")));
}

TEST_F(FilmOfGrowth, ChangesNothingThatGrowsAndIsTheSameOnAnyNumberOfThreads) {
  const Scene with = sceneWith(kFilm), without = sceneWith("");
  const std::uint64_t hash = runScene(without, into("without")).growth->state_hash;
  EXPECT_TRUE(filmIn(scratch_.path("without")).empty());
  Files first;
  for (const int threads : {1, 2, 5}) {
    sim::onThreads(threads,
                   [&] { EXPECT_EQ(runScene(with, into("with")).growth->state_hash, hash) << threads; });
    const Files film = filmIn(scratch_.path("with"));
    if (first.empty()) first = film;
    EXPECT_TRUE(film == first) << threads;
  }
  EXPECT_EQ(first.size(), ffmpegProgram().empty() ? 4u : 5u);
}

TEST_F(FilmOfGrowth, IsDrawnAgainFromWhatWasKept) {
  const Files film = filmOf(kFilm);
  const Scene scene = sceneWith("film: {every: 2, camera: main, width: 40, height: 30}\n");
  renderScene(scene, scratch_.path("out"), into("again"));
  EXPECT_TRUE(filmIn(scratch_.path("again")) == film);
  EXPECT_TRUE(std::filesystem::exists(scratch_.path("again/a.png")));
}

TEST_F(FilmOfGrowth, IsLeftOutWithThePictures) {
  RunOptions options = into("out");
  options.pictures = false;
  const Report report = runScene(sceneWith(kFilm), options);
  EXPECT_FALSE(report.film);
  EXPECT_TRUE(filmIn(scratch_.path("out")).empty());
}

TEST_F(FilmOfGrowth, TakesAwayWhatALongerOneLeft) {
  filmOf("film: {every: 1, width: 40, height: 30}\n");
  scratch_.write("out/film_0001.txt", "mine");
  Files film = filmOf("film: {every: 6, width: 40, height: 30}\n");
  EXPECT_EQ(film.size(), ffmpegProgram().empty() ? 3u : 4u);  // with that of another's
  EXPECT_TRUE(film.contains("film_0001.txt"));
  EXPECT_FALSE(film.contains("film_0002.png"));
}

TEST_F(FilmOfGrowth, WithoutFfmpegHasFramesAndSaysWhatToInstall) {
  const std::string before = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const Files film = filmOf(kFilm);
  RunOptions strict = into("strict");
  strict.strict = true;
  EXPECT_THROW(runScene(sceneWith(kFilm), strict), sim::InputError);
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_EQ(film.size(), 4u);
  EXPECT_FALSE(film.contains(kFilmFile));
  EXPECT_FALSE(report_.film->video);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("scene.yaml:18:1: ffmpeg is not installed"), std::string::npos) << warnings_[0];
  EXPECT_NE(warnings_[0].find("apt-get install ffmpeg"), std::string::npos) << warnings_[0];
  EXPECT_FALSE(std::filesystem::exists(scratch_.path("strict")));
}

TEST_F(FilmOfGrowth, AnFfmpegThatFailsIsAWarningOfItsOwn) {
  const auto fake =
      scratch_.write("bin/ffmpeg", "#!/bin/sh\necho \"Unknown encoder 'libx264'\" >&2\nexit 1\n");
  std::filesystem::permissions(fake, std::filesystem::perms::owner_all);
  const std::string before = std::getenv("PATH");
  ::setenv("PATH", fake.parent_path().c_str(), 1);
  const Files film = filmOf(kFilm);
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_EQ(film.size(), 4u);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find(
                "there is no film.mp4, and the frames alone: ffmpeg ended with status 1: Unknown encoder "
                "'libx264'; expected an ffmpeg with libx264"),
            std::string::npos)
      << warnings_[0];
}

TEST_F(FilmOfGrowth, LeavesNothingWhereItIsStopped) {
  Scene scene = sceneWith("film: {path: [main, other], width: 640, height: 480}\n");
  std::stop_source source;
  RunOptions options = into("stopped");
  options.stop = source.get_token();
  std::jthread later;
  options.on_stage = [&](const std::string& stage) {
    if (stage != "filming") return;
    later = std::jthread([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      source.request_stop();
    });
  };
  EXPECT_THROW(runScene(scene, options), sim::Stopped);
  EXPECT_FALSE(std::filesystem::exists(scratch_.path("stopped")));
  EXPECT_TRUE(::waitpid(-1, nullptr, WNOHANG) < 0 && errno == ECHILD);
}

TEST_F(FilmOfGrowth, ItsCameraKeepsOutOfWhatStands) {
  Scene scene = sceneWith("film: {path: [main, other], width: 40, height: 30}\n");
  scene.cameras[0].camera.eye_m = {-0.5, 0.5, 1.0};
  scene.cameras[1].camera.eye_m = {-0.5, 0.5, -1.0};
  scene.cameras[0].camera.target_m = scene.cameras[1].camera.target_m = {0.9, 0.5, 0.9};
  try {
    runScene(scene, into("out"));
    ADD_FAILURE() << "it went through the wall";
  } catch (const sim::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("of its way the film's camera is inside 'plot' (wall)"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace espalier::scenes
