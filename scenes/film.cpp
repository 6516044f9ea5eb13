#include "scenes/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::scenes {
namespace {

constexpr int kMostFrames = 10'000;  // four digits

}  // namespace

std::vector<int> framesOf(const FilmSpec& film, int iterations) {
  std::vector<int> frames;
  for (int i = 0; i < iterations; i += film.every) frames.push_back(i);
  frames.push_back(iterations);
  return frames;
}

int heldFrames(const FilmSpec& film) {
  return static_cast<int>(std::lround(film.hold_s * film.frames_per_second));
}

std::string tooManyFrames(const FilmSpec& film, int iterations) {
  const int frames = iterations / film.every + (iterations % film.every == 0 ? 1 : 2);
  if (frames <= kMostFrames) return "";
  return fmt::format("a frame every {} of {} iterations makes {} frames; expected at most {}: every: {}",
                     film.every, iterations, frames, kMostFrames, iterations / (kMostFrames - 2) + 1);
}

std::string frameFile(std::size_t frame) {
  return fmt::format("film_{:04}.png", frame);
}

bool isOfFilm(std::string_view stem) {
  constexpr std::string_view kStem = "film";
  if (!stem.starts_with(kStem)) return false;
  stem.remove_prefix(kStem.size());
  return stem.empty() ||
         (stem.size() == 5 && stem.front() == '_' &&
          std::all_of(stem.begin() + 1, stem.end(), [](char c) { return c >= '0' && c <= '9'; }));
}

}  // namespace espalier::scenes
