#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/problem.h"

namespace espalier::scenes {

/// A camera that a film's own passes.
struct FilmWaypoint {
  std::string camera;        ///< one of the scene's
  std::optional<double> at;  ///< when: 0 as growth begins, 1 as it ends; of all of a path or of none
};

/// Growth as a film.
struct FilmSpec {
  int every = 1;                   ///< iterations from frame to frame
  std::string camera;              ///< that stands still; empty: the scene's first, where there is no path
  std::vector<FilmWaypoint> path;  ///< of one that moves
  int width_px = 640, height_px = 480;
  int frames_per_second = 12;
  double hold_s = 1.0;  ///< how long the last frame stands on
  Place place = {};     ///< where a scene file has it; without a path where none does
};

/// What stands after how many iterations each frame shows: rising, from 0 to all that were done.
std::vector<int> framesOf(const FilmSpec& film, int iterations);

/// How often the last frame is shown beyond the once of every frame.
int heldFrames(const FilmSpec& film);

/// What is wrong with a film of more frames than anybody watches; empty where nothing is.
std::string tooManyFrames(const FilmSpec& film, int iterations);

/// The files of a film, in the output folder: of the frames in order, and of all of them.
std::string frameFile(std::size_t frame);
inline constexpr const char* kFilmFile = "film.mp4";
/// Whether a name without an ending may be that of one of these.
bool isOfFilm(std::string_view stem);

}  // namespace espalier::scenes
