#include "scenes/film.h"

#include <gtest/gtest.h>

namespace espalier::scenes {
namespace {

TEST(Film, HasAFrameEverySoManyIterationsAndTheLast) {
  FilmSpec film;
  EXPECT_EQ(framesOf(film, 3), (std::vector<int>{0, 1, 2, 3}));
  film.every = 2;
  EXPECT_EQ(framesOf(film, 3), (std::vector<int>{0, 2, 3}));
  EXPECT_EQ(framesOf(film, 4), (std::vector<int>{0, 2, 4}));
  film.every = 9;
  EXPECT_EQ(framesOf(film, 4), (std::vector<int>{0, 4}));
  EXPECT_EQ(framesOf(film, 0), std::vector<int>{0});
}

TEST(Film, HoldsItsLastFrame) {
  FilmSpec film;
  film.frames_per_second = 12;
  film.hold_s = 1.5;
  EXPECT_EQ(heldFrames(film), 18);
  film.hold_s = 0.0;
  EXPECT_EQ(heldFrames(film), 0);
}

TEST(Film, TheFramesThatAreAdvisedAreNotTooMany) {
  for (const int iterations : {9'999, 10'000, 10'001, 20'000, 100'000}) {
    FilmSpec film;
    const std::string wrong = tooManyFrames(film, iterations);
    EXPECT_EQ(wrong.empty(), framesOf(film, iterations).size() <= 10'000) << iterations;
    if (wrong.empty()) continue;
    film.every = std::stoi(wrong.substr(wrong.rfind(' ')));
    EXPECT_EQ(tooManyFrames(film, iterations), "");
    EXPECT_LE(framesOf(film, iterations).size(), 10'000u);
  }
}

TEST(Film, KnowsItsFiles) {
  EXPECT_EQ(frameFile(7), "film_0007.png");
  for (const char* stem : {"film", "film_0000", "film_9999"}) EXPECT_TRUE(isOfFilm(stem)) << stem;
  for (const char* stem : {"films", "film_1", "film_00001", "film_00a0", "a_film", ""})
    EXPECT_FALSE(isOfFilm(stem)) << stem;
}

}  // namespace
}  // namespace espalier::scenes
