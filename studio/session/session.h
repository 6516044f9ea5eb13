#pragma once
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "studio/session/assets.h"
#include "studio/session/hub.h"
#include "studio/session/project.h"
#include "studio/session/regrowth.h"

namespace espalier::studio {

/// A scene that is being written, and what grows of it: what the page and the server know. Texts are judged
/// on the thread that brings them; a thread of its own makes what they ask for, and lets go of it for the
/// next text. Any thread may call any of it. All that is said in JSON is as README.md has it; what cannot be
/// done throws Refused.
class Session {
 public:
  /// Threads that grow: so many. Throws InputError for a scene file that cannot be read, and where no folder
  /// can be made for what is exported.
  Session(const std::filesystem::path& scene, int threads);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  std::string project() const;
  /// Texts by the names of their files.
  std::string edit(const std::map<std::string, std::string>& texts);
  /// Null where as many listen as may.
  std::shared_ptr<Listener> listen();
  const Assets& assets() const { return assets_; }

  std::string surfaces(Version version);
  std::string layers(Version version, int axis, double at_m);
  std::string why(Version version, std::size_t plant, sim::NodeId node);

  std::string moveSeed(const std::string& planting, std::size_t seed, sim::Vec3 to_m) const;
  std::string addSeed(const std::string& planting, sim::Vec3 at_m) const;
  std::string setCamera(const std::string& name, sim::Vec3 eye_m, sim::Vec3 target_m) const;

  struct Saved {
    std::string json;
    bool conflict = false;
  };
  Saved save(const std::string& file, const std::string& text, const std::string& saved);

  /// Runs what `espalier grow` runs, on the texts as they are. `what`: glb, vdb, skeleton, image.
  std::string makeExport(const std::string& what, const std::string& image);
  /// The bytes of a file that the last export made; nothing where it made none of that name.
  std::optional<std::string> exported(const std::string& name) const;

  /// The pages are told that it ends.
  void end();

 private:
  struct Edit {
    Version version = 0;
    std::optional<scenes::Scene> scene;  ///< none: the texts are wrong
    Told told;
  };
  using Question = std::packaged_task<std::string(Regrowth&)>;

  void work(std::stop_token ends);
  void answer(Regrowth& regrowth);
  void watchDisk();
  std::string ask(std::function<std::string(Regrowth&)> question);
  FileNames names() const;
  /// Of a copy of the project.
  scenes::Scene readNow() const;

  mutable std::mutex mutex_;  // of all that follows up to the hub
  std::condition_variable_any woken_;
  Project project_;
  Version version_ = 0;
  std::optional<Edit> next_;
  std::deque<Question> questions_;
  std::stop_source current_;  // stops what is being made
  std::vector<std::string> exported_;

  std::mutex exporting_;
  int threads_;
  std::filesystem::path folder_;  // for products of other scenes and for exports
  Hub hub_;
  Assets assets_;
  std::jthread worker_;  // last: it uses all of the above
};

}  // namespace espalier::studio
