#include "tests/fuzz/whole_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <typeinfo>

#include "scenes/job/expose.h"
#include "scenes/job/run.h"
#include "scenes/prepare/site.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"

namespace espalier::fuzz {
namespace {

using scenes::Report;
using scenes::Scene;

class WholeProgram {
 public:
  WholeProgram(const std::filesystem::path& file, tests::Numbers& numbers)
      : file_(file), folder_(file.parent_path() / "out"), numbers_(numbers) {}

  Ended run() {
    auto scene = scenes::readScene(file_);
    if (!scene) return {.fault = "it cannot be read any more:\n" + scenes::format(scene.problems())};
    const bool pictures = numbers_.chance(0.3), resumed = numbers_.chance(0.3),
               exposed = numbers_.chance(0.3), rendered = numbers_.chance(0.3);
    std::optional<Report> grown;
    inJob([&] { grown = grow(*scene, pictures, {.every = numbers_.whole(0, 2)}); });
    if (grown) {
      for (const Report::Growth::Plant& plant : grown->growth->plants)
        ended_.grew = ended_.grew || plant.segments + plant.elements > 0;
      if (rendered && !scene->images.empty()) inJob([&] { render(*scene); });
      if (resumed && grown->growth->cut_short.empty()) inJob([&] { goOn(*scene, *grown); });
    }
    // Without a mesh there is nothing to light, which a few scenes are enough to be told.
    const bool lit =
        std::any_of(scene->meshes.begin(), scene->meshes.end(), [](auto& mesh) { return mesh.tiled; });
    if (exposed && (lit || numbers_.chance(0.1))) inJob([&] { expose(*scene, pictures); });
    return ended_;
  }

 private:
  /// Does some of the work, and takes in what it throws.
  void inJob(const std::function<void()>& job) {
    if (!ended_.fault.empty()) return;
    try {
      sim::onThreads(numbers_.whole(1, 3), job);
      ended_.done = true;
    } catch (const scenes::MeshMissing& missing) {
      ended_.refusal = missing.what();
    } catch (const sim::InputError& error) {
      ended_.refusal = error.what();
      if (ended_.refusal.find(file_.parent_path().string()) != 0 ||
          ended_.refusal.find(' ') == std::string::npos)
        ended_.fault = "an error that does not begin with a file: " + ended_.refusal;
    } catch (const std::exception& error) {
      ended_.fault = fmt::format("{}: {}", typeid(error).name(), error.what());
    }
  }

  scenes::RunOptions options(bool pictures) const {
    scenes::RunOptions options;
    options.folder = folder_;
    options.pictures = pictures;
    return options;
  }

  Report grow(const Scene& scene, bool pictures, const scenes::Keeping& keeping) {
    const Report report = scenes::runScene(scene, options(pictures), keeping);
    if (toJson(report).empty() || summary(report, folder_).empty()) ended_.fault = "a run without a report";
    return report;
  }

  /// Half of the way anew, and the rest from the state that was kept.
  void goOn(Scene scene, const Report& whole) {
    const int iterations = scene.iterations;
    scene.skeleton_iterations = iterations;
    std::filesystem::remove_all(folder_);
    scene.iterations = iterations / 2;
    const Report half = grow(scene, false, {});
    if (!half.growth->cut_short.empty()) return;
    scene.iterations = iterations;
    const Report rest = grow(scene, false, {.resume = true});
    if (rest.growth->cut_short.empty() && rest.growth->state_hash != whole.growth->state_hash) {
      ended_.fault = fmt::format(
          "growth that went on after {} of {} iterations has the hash {:016x}, and {:016x} in one go",
          iterations / 2, iterations, rest.growth->state_hash, whole.growth->state_hash);
    }
  }

  void render(const Scene& scene) {
    const Report report = scenes::renderScene(scene, folder_, options(true));
    if (summary(report, folder_).empty()) ended_.fault = "a drawing without a summary";
  }

  void expose(const Scene& scene, bool pictures) {
    const scenes::ExposeResult result = scenes::exposeScene(scene, options(pictures));
    if (toJson(result.report).empty() || summary(result, folder_).empty())
      ended_.fault = "an exposure without a report";
  }

  std::filesystem::path file_, folder_;
  tests::Numbers& numbers_;
  Ended ended_;
};

}  // namespace

Ended runWhole(const std::filesystem::path& scene, tests::Numbers& numbers) {
  return WholeProgram(scene, numbers).run();
}

}  // namespace espalier::fuzz
