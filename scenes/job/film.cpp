#include "scenes/job/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "render/finish/finished_picture.h"
#include "render/image/bloom.h"
#include "render/image/image_io.h"
#include "render/image/tone.h"
#include "scenes/film.h"
#include "scenes/job/model_files.h"
#include "scenes/job/plant_models.h"
#include "scenes/lights.h"
#include "scenes/prepare/in_scene.h"
#include "scenes/problem.h"
#include "scenes/show/film_camera.h"
#include "scenes/show/film_light.h"
#include "scenes/show/picture_memory.h"
#include "scenes/show/vines_picture.h"
#include "scenes/write/video.h"
#include "sim/base/counted.h"
#include "sim/base/error.h"
#include "sim/base/memory.h"
#include "sim/base/parallel.h"
#include "sim/base/stop.h"
#include "sim/grow/earlier.h"
#include "sim/tile/build_world.h"

namespace espalier::scenes {
namespace {

/// Frames, packed no smaller than they are, some of them on their way, and the film.
double filmBytes(const FilmSpec& film, int iterations) {
  constexpr double kOnTheWay = 4 * 3 * sizeof(float), kPixel = 3.0;
  const double frames = static_cast<double>(framesOf(film, iterations).size());
  return static_cast<double>(film.width_px) * film.height_px * (kOnTheWay + 1.5 * kPixel * frames);
}

/// What a frame shows, ready to be drawn.
struct Staged {
  std::vector<render::PlantModel> models;
  EarlierWorld world;
  std::function<sim::Colour(sim::Vec3 p_m, sim::Vec3f normal)> bounced;
};

/// One frame after the other.
class Stage {
 public:
  explicit Stage(const FilmSources& sources)
      : sources_(sources),
        births_(sources.site.world, sources.growth.plants, sources.growth.iterations),
        light_(sources.site.world, sources.site.sky, sources.site.random_sky, births_,
               sources.growth.iterations,
               drawsVines(sources.scene.images) ? sources.light.space_sky : nullptr),
        meshes_(meshesOf(sources.site)) {
    if (!sources.scene.interreflection) return;
    growing_.emplace(sources.scene, sources.site.meshes, sources.site.world, sources.growth.plants,
                     sources.light, shadowDirection(sources.scene.sun));
    if (growing_->anyShines())
      bounce_.emplace(*growing_, sources.site.world, births_, sources.growth.iterations, sources.lit.vines);
  }

  /// What stood after so many iterations, no less than the last time.
  Staged after(int iterations) {
    std::vector<sim::Plant> plants(sources_.growth.plants.size());
    sim::parallelForEach(plants.size(), [&](std::size_t i) {
      plants[i] = sim::plantAfter(sources_.growth.plants[i], iterations);
    });
    return {modelPlants(sources_.site.world.frame(), plants, sources_.bare), light_.after(iterations),
            bounce_ ? bounce_->after(iterations) : bouncedIn(sources_.lit, sources_.site.world.frame())};
  }

  /// As it is displayed.
  render::Image drawn(const Staged& staged, const render::Camera& camera) const {
    const FilmSpec& film = *sources_.scene.film;
    render::FinishedScene scene;
    scene.model.meshes = meshes_;
    for (const render::PlantModel& model : staged.models) scene.model.plants.push_back(&model);
    scene.pictures = sources_.textures;
    scene.frame = sources_.site.world.frame();
    scene.occupied = &staged.world.occupied;
    scene.sky = staged.world.sky.get();
    scene.bounced = staged.bounced;
    scene.to_sun = shadowDirection(sources_.scene.sun);
    scene.daylight = daylightShare(sources_.scene);
    render::Image picture = render::finishedPicture(scene, camera, film.width_px, film.height_px);
    render::bloom(picture, sources_.scene.bloom);
    const render::ToneCurve tone;
    sim::parallelFor(static_cast<std::size_t>(picture.height), [&](std::size_t begin, std::size_t end) {
      for (std::size_t row = begin; row < end; ++row) {
        float* pixel = picture.at(0, static_cast<int>(row));
        for (int x = 0; x < picture.width; ++x, pixel += 3) {
          const sim::Colour display = tone(sim::Colour(pixel[0], pixel[1], pixel[2]));
          std::copy_n(&display.r, 3, pixel);
        }
      }
    });
    return picture;
  }

 private:
  const FilmSources& sources_;
  sim::VoxelBirths births_;
  FilmLight light_;
  std::vector<const sim::Mesh*> meshes_;
  std::optional<GrowingBounce> growing_;
  std::optional<FilmBounce> bounce_;
};

std::vector<std::uint8_t> bytesOf(const render::Image& display) {
  std::vector<std::uint8_t> bytes(display.pixels.size());
  std::transform(display.pixels.begin(), display.pixels.end(), bytes.begin(), [](float value) {
    return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
  });
  return bytes;
}

struct Filmed {
  std::vector<OutputFile> files;  // frames in order, and the film where ffmpeg is and made one
  Report::Film about;
  std::string no_video;  // why an ffmpeg that is there made none; else empty
};

Filmed drawFilm(const FilmSources& sources) {
  const FilmSpec& film = *sources.scene.film;
  const int iterations = sources.growth.iterations;
  const std::vector<int> frames = framesOf(film, iterations);
  const FilmCamera camera(sources.scene);
  Filmed filmed;
  filmed.files.resize(frames.size());
  std::optional<Video> video;
  if (const auto ffmpeg = ffmpegProgram(); !ffmpeg.empty())
    video.emplace(ffmpeg, VideoShape{film.width_px, film.height_px, film.frames_per_second});

  const auto pack = [&](std::size_t i, const render::Image& picture) {
    render::Metadata about = {
        {"Title", fmt::format("{}: frame {} of {}, after {}", sources.scene.name, i + 1, frames.size(),
                              sim::counted(static_cast<std::uint64_t>(frames[i]), "iteration"))}};
    for (auto& text : render::textsOf(sources.made_by)) about.push_back(std::move(text));
    about.emplace_back("espalier:film_s",
                       fmt::format("{:.6g}", static_cast<double>(i) / film.frames_per_second));
    filmed.files[i] = fileOf(frameFile(i), render::encodePng(picture, about));
    if (!video) return;
    const std::vector<std::uint8_t> bytes = bytesOf(picture);
    const int times = 1 + (i + 1 == frames.size() ? heldFrames(film) : 0);
    for (int k = 0; k < times; ++k) video->add(bytes);
  };
  Stage stage(sources);
  std::optional<Staged> next = stage.after(frames[0]);
  std::optional<render::Image> last;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    sim::throwIfStopped();
    const Staged now = *std::exchange(next, std::nullopt);
    std::optional<render::Image> picture;
    // Each has stretches that keep one core alone busy: while a frame is drawn, that before it is packed and
    // the next one set up.
    sim::parallelInvoke(
        [&] {
          const double time = iterations > 0 ? static_cast<double>(frames[i]) / iterations : 1.0;
          picture = stage.drawn(now, camera.at(time));
        },
        [&] {
          if (last) pack(i - 1, *last);
          if (i + 1 < frames.size()) next = stage.after(frames[i + 1]);
        });
    last = std::move(picture);
  }
  pack(frames.size() - 1, *last);
  filmed.about.frames = frames.size();
  filmed.about.seconds = static_cast<double>(frames.size() + static_cast<std::size_t>(heldFrames(film))) /
                         film.frames_per_second;
  if (!video) return filmed;
  Video::Made made = video->finish();
  filmed.about.video = made.failure.empty();
  if (filmed.about.video) {
    filmed.files.push_back(fileOf(kFilmFile, std::move(made.bytes)));
  } else {
    filmed.no_video = fmt::format("there is no {}, and the frames alone: {}; expected an ffmpeg with libx264",
                                  kFilmFile, made.failure);
  }
  return filmed;
}

}  // namespace

void requireFilmFits(const Scene& scene, const RunOptions& options) {
  if (!films(scene, options)) return;
  const FilmSpec& film = *scene.film;
  const auto wrong = [&](std::string why) {
    throw PlacedError({problemAt(film.place, scene.file, std::move(why))});
  };
  if (std::string why = tooManyFrames(film, scene.iterations); !why.empty()) wrong(std::move(why));
  const double bytes = filmBytes(film, scene.iterations) + pictureBytes(picturesOf(scene), 1.0);
  if (bytes <= sim::memoryBudget()) return;
  wrong(fmt::format(
      "a film of {} of {} x {} pixels, with the scene's images, needs {} of memory, and {} are free for it "
      "here; expected fewer frames (every), or smaller ones",
      sim::counted(framesOf(film, scene.iterations).size(), "frame"), film.width_px, film.height_px,
      sim::inGigabytes(bytes), sim::inGigabytes(sim::memoryBudget())));
}

void requireFilmFitsIn(const Scene& scene, const RunOptions& options, const sim::World& world) {
  if (!films(scene, options)) return;
  constexpr double kSkies = 5.0 * 2.0;  // of 16 bits: two moments, what lies between, and of other pictures
  inScene(scene, [&] { sim::requireFits(world.frame(), {world.layers(), kSkies}); });
  requireFilmInTheOpen(scene, world);
}

std::vector<Problem> filmWarnings(const Scene& scene, const RunOptions& options) {
  if (!films(scene, options) || !ffmpegProgram().empty()) return {};
  return {problemAt(
      scene.film->place, scene.file,
      fmt::format("ffmpeg is not installed, and there will be the film's frames and no {}; expected it in "
                  "PATH (Debian: apt-get install ffmpeg)",
                  kFilmFile))};
}

void addFilmFileNames(const Scene& scene, const RunOptions& options, std::vector<std::string>& names) {
  if (!films(scene, options)) return;
  const std::size_t frames = framesOf(*scene.film, scene.iterations).size();
  for (std::size_t i = 0; i < frames; ++i) names.push_back(frameFile(i));
  names.emplace_back(kFilmFile);
}

void addFilm(const FilmSources& sources, const RunOptions& options, std::vector<OutputFile>& files,
             Report& report, std::vector<std::string>& late_warnings) {
  const Filmed filmed = inScene(sources.scene, [&] { return drawFilm(sources); });
  report.film = filmed.about;
  files.insert(files.end(), filmed.files.begin(), filmed.files.end());
  if (filmed.no_video.empty()) return;
  const Problem warning = problemAt(sources.scene.film->place, sources.scene.file, filmed.no_video);
  if (options.on_warning) options.on_warning(warning);
  report.warnings.push_back(warning.text);
  late_warnings.push_back(warning.text);
}

void dropOldFilm(const std::filesystem::path& folder, const std::vector<OutputFile>& files) {
  std::set<std::string> written;
  for (const OutputFile& file : files) written.insert(file.name);
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    const std::filesystem::path name = entry.path().filename();
    const bool of_film = name == kFilmFile || (name.extension() == ".png" && name.stem() != "film" &&
                                               isOfFilm(name.stem().string()));
    if (of_film && !written.contains(name.string()) && entry.is_regular_file(none))
      std::filesystem::remove(entry.path(), none);
  }
}

}  // namespace espalier::scenes
