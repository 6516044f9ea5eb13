#include "scenes/show/film_camera.h"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/problem.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

const NamedCamera& cameraNamed(const Scene& scene, const std::string& name) {
  const auto at = std::find_if(scene.cameras.begin(), scene.cameras.end(), [&](const NamedCamera& camera) {
    return name.empty() || camera.name == name;
  });
  if (at == scene.cameras.end()) throw sim::BrokenContract("a film has a camera that its scene has not");
  return *at;
}

/// How fast a number changes as it passes a value, by how it changes before and after: not at all where it
/// turns back.
double slopeBetween(double before, double after, double time_before, double time_after) {
  if (before * after <= 0.0) return 0.0;
  const double a = time_before + 2.0 * time_after, b = 2.0 * time_before + time_after;
  return (a + b) / (a / before + b / after);
}

/// A number that takes these values at these times, between the second and the third of four; nothing comes
/// before the first of all, or after the last.
struct Course {
  std::optional<double> before_value, after_value;
  double from = 0.0, to = 0.0;
  double time_before = 0.0, time = 1.0, time_after = 0.0;

  double at(double share) const {
    const double slope = (to - from) / time;
    const double in =
        before_value ? slopeBetween((from - *before_value) / time_before, slope, time_before, time) : 0.0;
    const double out =
        after_value ? slopeBetween(slope, (*after_value - to) / time_after, time, time_after) : 0.0;
    const double s = share, s2 = s * s, s3 = s2 * s;
    return (2 * s3 - 3 * s2 + 1) * from + (s3 - 2 * s2 + s) * time * in + (3 * s2 - 2 * s3) * to +
           (s3 - s2) * time * out;
  }
};

}  // namespace

FilmCamera::FilmCamera(const Scene& scene) {
  const FilmSpec& film = *scene.film;
  if (film.path.empty()) {
    keys_.push_back({0.0, cameraNamed(scene, film.camera).camera});
    return;
  }
  const double last = static_cast<double>(film.path.size() - 1);
  for (std::size_t i = 0; i < film.path.size(); ++i) {
    keys_.push_back({film.path[i].at.value_or(static_cast<double>(i) / std::max(1.0, last)),
                     cameraNamed(scene, film.path[i].camera).camera});
  }
}

render::Camera FilmCamera::at(double time) const {
  if (time <= keys_.front().time) return keys_.front().camera;
  if (time >= keys_.back().time) return keys_.back().camera;
  const auto next =
      static_cast<std::size_t>(std::upper_bound(keys_.begin(), keys_.end(), time,
                                                [](double t, const Key& key) { return t < key.time; }) -
                               keys_.begin());
  const Key &from = keys_[next - 1], &to = keys_[next];
  const Key* const before = next >= 2 ? &keys_[next - 2] : nullptr;
  const Key* const after = next + 1 < keys_.size() ? &keys_[next + 1] : nullptr;
  const auto mixed = [&](auto number) {
    Course course{
        .before_value = {}, .after_value = {}, .from = number(from.camera), .to = number(to.camera)};
    course.time = to.time - from.time;
    if (before) {
      course.before_value = number(before->camera);
      course.time_before = from.time - before->time;
    }
    if (after) {
      course.after_value = number(after->camera);
      course.time_after = after->time - to.time;
    }
    return course.at((time - from.time) / course.time);
  };
  render::Camera camera;
  for (int axis = 0; axis < 3; ++axis) {
    camera.eye_m[axis] = mixed([=](const render::Camera& c) { return c.eye_m[axis]; });
    camera.target_m[axis] = mixed([=](const render::Camera& c) { return c.target_m[axis]; });
  }
  camera.fov_deg = mixed([](const render::Camera& c) { return c.fov_deg; });
  return camera;
}

void requireFilmInTheOpen(const Scene& scene, const sim::World& world) {
  constexpr int kLooks = 512;
  const FilmCamera camera(scene);
  const auto wrong = [&](double time, const std::string& why, const std::string& otherwise) {
    throw PlacedError({problemAt(
        scene.film->place, scene.file,
        fmt::format("at {:.2f} of its way the film's camera {}; expected a path around it, by another camera "
                    "in between{}",
                    time, why, otherwise))});
  };
  for (int i = 0; i <= kLooks; ++i) {
    const double time = static_cast<double>(i) / kLooks;
    const render::Camera now = camera.at(time);
    if (glm::distance(now.eye_m, now.target_m) < 1e-3 * world.frame().voxel_m)
      wrong(time, "passes through the point that it looks at", "");
    const sim::PartId part = world.partAt(sim::voxelAt(sim::voxelFromWorld(world.frame(), now.eye_m)));
    if (part == sim::kFree) continue;
    const sim::Part& met = world.part(part);
    wrong(time, fmt::format("is inside '{}' ({})", met.object, met.region), sim::orLeaveHollow(met));
  }
}

}  // namespace espalier::scenes
