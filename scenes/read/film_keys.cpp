#include "scenes/read/film_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "rules/language/key_builder.h"
#include "scenes/film.h"
#include "scenes/problem.h"

namespace espalier::scenes {
namespace {

using rules::TableOf;
using Given = rules::Check::Given;
using Complain = rules::Check::Complain;

constexpr rules::Limits kPixels{16.0, 4096.0};

std::shared_ptr<const rules::Table> waypointKeys() {
  return TableOf<FilmWaypoint>()
      .text("camera", &FilmWaypoint::camera,
            {.meaning = "One of the scene's cameras, which the film's passes.", .required = true})
      .number(
          "at", &FilmWaypoint::at,
          {.limits = {0.0, 1.0},
           .meaning = "When: 0 as growth begins, 1 as it ends. Of all of a path or of none, which spreads "
                      "them evenly."})
      .shared();
}

void checkCamera(const Scene& scene, const std::vector<std::string>& names, const Given& given,
                 const Complain& complain) {
  const FilmSpec& film = *scene.film;
  if (names.empty()) {
    complain(
        "film",
        "a film needs a camera and the scene has none; expected cameras: {main: {eye: ..., target: ...}}");
    return;
  }
  if (!film.camera.empty()) {
    if (const std::string wrong = notCalled("camera", film.camera, names); !wrong.empty())
      complain("film.camera", wrong);
    if (given("film.path"))
      complain("film.path", "both camera and path are given; expected a camera that stands still, or a path");
  }
}

void checkPath(const Scene& scene, const std::vector<std::string>& names, const Complain& complain) {
  const std::vector<FilmWaypoint>& path = scene.film->path;
  if (path.size() == 1)
    complain("film.path", "a path of one camera leads nowhere; expected two or more, or camera: NAME");
  const std::size_t timed = static_cast<std::size_t>(
      std::count_if(path.begin(), path.end(), [](const FilmWaypoint& w) { return w.at.has_value(); }));
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::string where = fmt::format("film.path[{}]", i);
    if (const std::string wrong = notCalled("camera", path[i].camera, names);
        !names.empty() && !wrong.empty())
      complain(where + ".camera", wrong);
    if (timed > 0 && !path[i].at) {
      complain(where,
               "this one does not say when (at), and others do; expected it of all of a path, or of none");
    } else if (i > 0 && path[i].at && path[i - 1].at && *path[i].at <= *path[i - 1].at) {
      complain(where + ".at",
               fmt::format("at {:g} does not come after the one before, at {:g}; expected them in "
                           "order, each later than the last",
                           *path[i].at, *path[i - 1].at));
    }
  }
}

}  // namespace

std::shared_ptr<const rules::Table> filmKeys() {
  return TableOf<FilmSpec>()
      .whole("every", &FilmSpec::every,
             {.unit = "iterations",
              .limits = {1.0, 100'000.0},
              .meaning = "From one frame to the next; what has grown in the end is the last frame."})
      .text("camera", &FilmSpec::camera,
            {.meaning = "One of the scene's cameras, which stands still; without it and a path, the first."})
      .list<FilmWaypoint>(
          "path", rules::Kind::entries, &FilmSpec::path, waypointKeys(),
          {.meaning = "Of a camera that moves: those of the scene's that it passes, smoothly and "
                      "in order.",
           .most = 100},
          "camera")
      .whole("width", &FilmSpec::width_px,
             {.unit = "pixels", .limits = kPixels, .meaning = "Width of a frame; an even number."})
      .whole("height", &FilmSpec::height_px,
             {.unit = "pixels", .limits = kPixels, .meaning = "Height of a frame; an even number."})
      .whole("frames_per_second", &FilmSpec::frames_per_second,
             {.unit = "frames", .limits = {1.0, 120.0}, .meaning = "How fast it runs."})
      .number("hold", &FilmSpec::hold_s,
              {.unit = "seconds", .limits = {0.0, 60.0}, .meaning = "How long the last frame stands on."})
      .shared();
}

void checkFilm(const Scene& scene, const Given& given, const Complain& complain) {
  if (!scene.film) return;
  const FilmSpec& film = *scene.film;
  std::vector<std::string> names;
  for (const NamedCamera& camera : scene.cameras) names.push_back(camera.name);
  checkCamera(scene, names, given, complain);
  checkPath(scene, names, complain);
  for (const auto& [key, pixels] : {std::pair{"width", film.width_px}, {"height", film.height_px}}) {
    if (pixels % 2 == 0) continue;
    complain(
        given(std::string("film.") + key) ? std::string("film.") + key : "film",
        fmt::format("a film's {0} of {1} pixels is odd, and no film.mp4 can have that; expected {0}: {2}",
                    key, pixels, pixels + 1));
  }
  if (const std::string wrong = tooManyFrames(film, scene.iterations); !wrong.empty())
    complain(given("film.every") ? "film.every" : "film", wrong);
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    if (!isOfFilm(scene.images[i].name)) continue;
    complain(given(fmt::format("images[{}].name", i)) ? fmt::format("images[{}].name", i)
                                                      : fmt::format("images[{}]", i),
             fmt::format("the film has the name '{}'; expected another for the image", scene.images[i].name));
  }
}

}  // namespace espalier::scenes
