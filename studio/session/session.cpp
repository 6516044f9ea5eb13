#include "studio/session/session.h"

#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "scenes/job/chosen_images.h"
#include "scenes/job/run.h"
#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/stop.h"
#include "studio/session/placing.h"
#include "studio/session/refused.h"
#include "studio/wire/frame.h"
#include "studio/wire/json.h"

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kBetweenLooksAtDisk(1);
constexpr std::size_t kMostQuestions = 16;
constexpr int kBadRequest = 400, kConflict = 409, kTooMany = 429;

fs::path newFolder() {
  std::string name = (fs::temp_directory_path() / "espalier-studio-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw sim::InputError(name +
                          ": a folder cannot be made there: " + std::generic_category().message(errno));
  return name;
}

/// Work of the simulation on behalf of a page: what it throws is a refusal.
template <class Work>
auto refusing(Work work) {
  try {
    return work();
  } catch (const sim::Stopped&) {
    throw Refused(kConflict, "the texts have changed since");
  } catch (const sim::InputError& error) {
    throw Refused(kBadRequest, error.what());
  }
}

}  // namespace

Session::Session(const fs::path& scene, int threads)
    : project_(scene), threads_(threads), folder_(newFolder()) {
  worker_ = std::jthread(
      [this](std::stop_token ends) { sim::onThreads(threads_, [&] { work(std::move(ends)); }); });
  edit({});
}

Session::~Session() {
  end();
  worker_.request_stop();
  {
    const std::lock_guard lock(mutex_);
    current_.request_stop();
  }
  woken_.notify_all();
  worker_.join();
  std::error_code error;
  fs::remove_all(folder_, error);
}

void Session::end() {
  hub_.send(frameOf(FrameKind::event, textOf({{"event", "end"}, {"version", 0}})));
  hub_.close();
}

FileNames Session::names() const {
  return [project = project_](const std::string& path) { return project.nameOf(path); };
}

std::string Session::project() const {
  const std::lock_guard lock(mutex_);
  Json files = Json::array();
  for (const OpenFile& file : project_.files())
    files.push_back({{"name", file.name},
                     {"kind", file.scene ? "scene" : "rules"},
                     {"text", file.text},
                     {"saved", file.saved},
                     {"library", file.library}});
  Json images = Json::array();
  const auto scene = scenes::readScene(project_.scene(), project_.texts());
  if (scene) {
    for (const scenes::ImageSpec& image : scene->images)
      images.push_back({{"name", image.name}, {"kind", std::string(scenes::nameOf(image.kind))}});
  }
  return textOf({{"name", scene ? scene->name : project_.files().front().name},
                 {"version", version_},
                 {"program", "Espalier " ESPALIER_VERSION},
                 {"threads", threads_},
                 {"files", std::move(files)},
                 {"images", std::move(images)}});
}

std::string Session::edit(const std::map<std::string, std::string>& texts) {
  std::unique_lock lock(mutex_);
  refusing([&] {
    Project changed = project_;  // all of them or none
    for (const auto& [name, text] : texts) changed.write(name, text);
    project_ = std::move(changed);
  });
  Edit edit{++version_, {}, {}};
  const auto scene = scenes::readScene(project_.scene(), project_.texts());
  bool others = false;
  if (scene) {
    edit.told.warnings = scene->warnings;
    others = project_.take(*scene);
    edit.scene = *scene;
  } else {
    edit.told.errors = scene.problems();
    others = project_.take(scenes::filesOfScene(project_.scene(), project_.texts()));
  }
  const std::string answer = "{\"version\":" + std::to_string(edit.version) +
                             ",\"problems\":" + problemsJson(edit.told, names()) + "}";
  next_ = std::move(edit);
  current_.request_stop();
  lock.unlock();
  if (others) hub_.send(frameOf(FrameKind::event, textOf({{"event", "project"}, {"version", version_}})));
  woken_.notify_all();
  return answer;
}

std::shared_ptr<Listener> Session::listen() {
  auto listener = hub_.join();
  woken_.notify_all();
  return listener;
}

void Session::answer(Regrowth& regrowth) {
  if (hub_.anyNew()) hub_.greet(regrowth.all());
}

void Session::watchDisk() {
  std::vector<Project::Changed> changed;
  {
    const std::lock_guard lock(mutex_);
    changed = project_.changedOnDisk();
  }
  for (const Project::Changed& one : changed)
    hub_.send(frameOf(FrameKind::event, textOf({{"event", "disk"},
                                                {"version", 0},
                                                {"file", one.name},
                                                {"saved", one.saved},
                                                {"text", one.text}})));
}

void Session::work(std::stop_token ends) {
  Regrowth regrowth(folder_ / "from_scenes", assets_,
                    {[this](std::string frame) { hub_.send(std::move(frame)); }, [&] { answer(regrowth); }});
  std::unique_lock lock(mutex_);
  while (!ends.stop_requested()) {
    woken_.wait_for(lock, kBetweenLooksAtDisk,
                    [&] { return ends.stop_requested() || next_ || !questions_.empty() || hub_.anyNew(); });
    if (ends.stop_requested()) break;
    if (next_) {
      Edit edit = *std::exchange(next_, std::nullopt);
      current_ = std::stop_source();
      const std::stop_token stop = current_.get_token();
      const FileNames called = names();
      lock.unlock();
      try {
        const sim::StopScope scope(stop);
        if (edit.scene) {
          regrowth.to(*edit.scene, edit.version, edit.told, called);
        } else {
          regrowth.refuse(edit.version, edit.told, called);
        }
      } catch (const sim::Stopped&) {
        // The next text is there.
      } catch (const std::exception& error) {
        edit.told.errors = {{edit.scene ? edit.scene->file.string() : "", 0, 0, error.what()}};
        regrowth.refuse(edit.version, edit.told, called);
      }
      answer(regrowth);
      lock.lock();
    } else if (!questions_.empty()) {
      Question question = std::move(questions_.front());
      questions_.pop_front();
      const std::stop_token stop = current_.get_token();
      lock.unlock();
      {
        const sim::StopScope scope(stop);
        question(regrowth);
      }
      lock.lock();
    } else {
      lock.unlock();
      answer(regrowth);
      watchDisk();
      lock.lock();
    }
  }
  questions_.clear();
}

std::string Session::ask(std::function<std::string(Regrowth&)> question) {
  Question task(std::move(question));
  std::future<std::string> answer = task.get_future();
  {
    const std::lock_guard lock(mutex_);
    if (questions_.size() >= kMostQuestions) throw Refused(kTooMany, "too much is asked at once");
    questions_.push_back(std::move(task));
  }
  woken_.notify_all();
  return refusing([&] {
    try {
      return answer.get();
    } catch (const std::future_error&) {
      throw Refused(kConflict, "the program ends");
    }
  });
}

std::string Session::surfaces(Version version) {
  return ask([version](Regrowth& regrowth) { return regrowth.surfaces(version); });
}

std::string Session::layers(Version version, int axis, double at_m) {
  return ask([=](Regrowth& regrowth) { return regrowth.layers(version, axis, at_m); });
}

std::string Session::why(Version version, std::size_t plant, sim::NodeId node) {
  return ask([=](Regrowth& regrowth) { return regrowth.why(version, plant, node); });
}

std::string Session::moveSeed(const std::string& planting, std::size_t seed, sim::Vec3 to_m) const {
  const scenes::Scene scene = readNow();
  const std::lock_guard lock(mutex_);
  const OpenFile& file = project_.files().front();
  return refusing([&] { return changeJson(file.name, seedMoved(file.text, scene, planting, seed, to_m)); });
}

std::string Session::addSeed(const std::string& planting, sim::Vec3 at_m) const {
  const scenes::Scene scene = readNow();
  const std::lock_guard lock(mutex_);
  const OpenFile& file = project_.files().front();
  return refusing([&] { return changeJson(file.name, seedAdded(file.text, scene, planting, at_m)); });
}

std::string Session::setCamera(const std::string& name, sim::Vec3 eye_m, sim::Vec3 target_m) const {
  const std::lock_guard lock(mutex_);
  const OpenFile& file = project_.files().front();
  return refusing([&] { return changeJson(file.name, cameraSet(file.text, name, eye_m, target_m)); });
}

Session::Saved Session::save(const std::string& file, const std::string& text, const std::string& saved) {
  const std::lock_guard lock(mutex_);
  return refusing([&]() -> Saved {
    if (const auto theirs = project_.save(file, text, saved))
      return {textOf({{"error", file + " was changed by another hand"},
                      {"saved", project_.file(file).saved},
                      {"text", *theirs}}),
              true};
    return {textOf({{"saved", project_.file(file).saved}}), false};
  });
}

scenes::Scene Session::readNow() const {
  const std::lock_guard lock(mutex_);
  const auto scene = scenes::readScene(project_.scene(), project_.texts());
  if (!scene) throw Refused(kConflict, "the texts are wrong: " + scenes::format(scene.problems().front()));
  return *scene;
}

std::string Session::makeExport(const std::string& what, const std::string& image) {
  const std::map<std::string, std::string> kinds{
      {"glb", "plant.glb"}, {"vdb", "world.vdb"}, {"skeleton", "skeleton.json"}};
  const bool pictures = what == "image";
  if (!pictures && !kinds.contains(what))
    throw Refused(kBadRequest, "there is no export " + what + "; expected glb, vdb, skeleton or image");
  const std::unique_lock one(exporting_, std::try_to_lock);
  if (!one) throw Refused(kTooMany, "another export is being made");
  scenes::Scene scene = readNow();
  return refusing([&] {
    if (pictures) {
      scenes::keepImages(scene, {image});
    } else {
      scene.images.clear();
    }
    scene.film.reset();
    scenes::RunOptions options;
    options.folder = folder_ / "export";
    options.pictures = pictures;
    scenes::Keeping keeping;
    keeping.keep = false;
    scenes::Report report;
    sim::onThreads(threads_, [&] { report = scenes::runScene(scene, options, keeping); });
    Json files = Json::array();
    std::vector<std::string> made;
    for (const std::string& name : report.files) {
      const bool wanted = pictures ? fs::path(name).stem() == image : name == kinds.at(what);
      if (!wanted) continue;
      made.push_back(name);
      files.push_back({{"name", name},
                       {"bytes", fs::file_size(options.folder / name)},
                       {"address", "/api/export/" + name}});
    }
    const std::lock_guard lock(mutex_);
    exported_ = std::move(made);
    return textOf({{"files", std::move(files)}});
  });
}

std::optional<std::string> Session::exported(const std::string& name) const {
  {
    const std::lock_guard lock(mutex_);
    if (std::find(exported_.begin(), exported_.end(), name) == exported_.end()) return std::nullopt;
  }
  std::ifstream file(folder_ / "export" / name, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  return file ? std::optional(std::move(bytes)) : std::nullopt;
}

}  // namespace espalier::studio
