#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenes/job/prepared.h"
#include "scenes/scene.h"
#include "studio/session/assets.h"
#include "studio/wire/events.h"
#include "studio/wire/plant_frames.h"

namespace espalier::studio {

/// Where frames go, and what is asked for between two of them.
struct Audience {
  std::function<void(std::string frame)> send;
  std::function<void()> between;  ///< called now and then while something is made
};

/// What was made of the texts: site, plans, plants. An edit makes anew what it touches and nothing else. Of
/// one thread alone.
class Regrowth {
 public:
  /// `folder`: where products of other scenes are kept. `assets` is borrowed.
  Regrowth(std::filesystem::path folder, Assets& assets, Audience audience);
  ~Regrowth();

  /// Makes what the scene asks for, and tells of it. What is wrong with its site is told too, and what stood
  /// before stays. `text`: what was found wrong with its texts, which is nothing but warnings. Throws
  /// Stopped; what was whole by then is kept.
  void to(const scenes::Scene& scene, Version version, const Told& text, const FileNames& names);
  /// Tells what is wrong with texts of which nothing can be made.
  void refuse(Version version, const Told& told, const FileNames& names);

  /// All that stands, as frames for somebody new.
  std::vector<std::string> all() const;

  /// What falls on surfaces, as README.md has it. Throws Refused (409) where what has grown is of
  /// another version.
  std::string surfaces(Version version);
  /// A cut through the boundary layers, likewise; `axis` 0: x.
  std::string layers(Version version, int axis, double at_m);
  /// How a node came to be, and what its sites tried last. Throws InputError for one that is none.
  std::string why(Version version, std::size_t plant, sim::NodeId node);

  /// Of what stands; 0 where nothing has grown.
  Version grown() const { return grown_version_; }

 private:
  template <class Work>
  void stage(const std::string& name, Work work);
  void event(std::string text, std::string* keep = nullptr);
  void makeSite(const scenes::Scene& scene);
  void makePlans(const scenes::Scene& scene);
  void grow();
  void dress();
  void form();
  void tellLooks(const sim::Growth& growth);
  /// What was not told yet; `anew`: all.
  void tellPlants(const sim::Growth& growth, bool anew);
  void tellEnd();
  const sim::Growth& shown() const { return formed_ ? *formed_ : growth_; }
  sim::GrowthSettings growthSettings() const;
  void requireGrown(Version version) const;

  std::filesystem::path folder_;
  Assets& assets_;
  Audience audience_;

  Version version_ = 0, grown_version_ = 0;
  scenes::Scene scene_;
  std::optional<scenes::Site> site_;  // its world holds what has grown
  std::optional<sim::World> bare_;    // and this one is as it was before
  scenes::Plans plans_;
  sim::Growth growth_;
  std::optional<sim::Growth> formed_;        // as it is shown, if that is another form
  const sim::Growth* growing_ = nullptr;     // while it grows, once it was told of
  std::string tiled_, lit_, grown_, looks_;  // texts that these were made from
  std::string mesh_;                         // the ID of the site's model
  std::vector<Sent> sent_;                   // of each plant
  Version sent_version_ = 0;                 // whose plants were
  StageCounts counts_;
  std::chrono::steady_clock::time_point began_{};
  struct {
    std::string problems, scene, looks, growth, stages;
  } last_;  // events
};

}  // namespace espalier::studio
