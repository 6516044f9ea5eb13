#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "render/finish/ray_scene.h"
#include "scenes/job/report.h"
#include "scenes/job/run.h"
#include "scenes/prepare/site.h"
#include "scenes/scene.h"
#include "scenes/show/bounced_light.h"
#include "scenes/write/output_folder.h"

namespace espalier::scenes {

/// Whether a run of the scene draws its film.
inline bool films(const Scene& scene, const RunOptions& options) {
  return options.pictures && scene.film.has_value();
}

/// Of these nothing is asked where no film is drawn.

/// Whether a film fits beside the scene's images, before anything is done: throws PlacedError where it has
/// more frames than anybody watches, or takes more memory than there is.
void requireFilmFits(const Scene& scene, const RunOptions& options);

/// The same of what it takes in a world, and whether its camera stays in the open.
void requireFilmFitsIn(const Scene& scene, const RunOptions& options, const sim::World& world);

/// That there will be no film.mp4, where ffmpeg is not installed.
std::vector<Problem> filmWarnings(const Scene& scene, const RunOptions& options);

/// Adds the files of a film that goes through all of the scene's iterations.
void addFilmFileNames(const Scene& scene, const RunOptions& options, std::vector<std::string>& names);

/// What a film is made from, once growth is done. Borrowed.
struct FilmSources {
  const Scene& scene;  ///< with a film
  const Site& site;
  const sim::BitVolume& bare;  ///< what the scene alone occupies
  const sim::Growth& growth;
  const sim::Lighting& light;
  const PictureLight& lit;  ///< what bounces, as all that grew stands there
  const render::KnownPictures& textures;
  const sim::Provenance& made_by;
};

/// Draws the film: in each frame what had grown by then, modelled anew, in the light of then (film_light.h);
/// the last frame is the picture of all that grew. The same on any number of threads. Adds its files, the
/// frames in order and then film.mp4, and tells the report of it; that an ffmpeg which is there made none is
/// a warning. Throws sim::InputError; sim::Stopped, and then no process is left behind.
void addFilm(const FilmSources& sources, const RunOptions& options, std::vector<OutputFile>& files,
             Report& report, std::vector<std::string>& late_warnings);

/// Removes frames of a longer film that an earlier run left in a folder, and its film.mp4 if there is no
/// newer one.
void dropOldFilm(const std::filesystem::path& folder, const std::vector<OutputFile>& files);

}  // namespace espalier::scenes
