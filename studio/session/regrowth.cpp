#include "studio/session/regrowth.h"

#include <algorithm>
#include <utility>

#include "render/form/formed.h"
#include "scenes/job/fed.h"
#include "scenes/job/plant_reports.h"
#include "scenes/lights.h"
#include "scenes/prepare/in_scene.h"
#include "sim/base/error.h"
#include "sim/base/hasher.h"
#include "sim/base/provenance.h"
#include "sim/base/stop.h"
#include "studio/session/looked_at.h"
#include "studio/session/refused.h"
#include "studio/session/touched.h"
#include "studio/wire/frame.h"
#include "studio/wire/looks.h"
#include "studio/wire/site_model.h"

namespace espalier::studio {
namespace {

using Clock = std::chrono::steady_clock;

/// How long growth goes on between two looks at it.
constexpr std::chrono::milliseconds kBetweenLooks(40);

double secondsSince(Clock::time_point began) {
  return std::chrono::duration<double>(Clock::now() - began).count();
}

/// All that a plant of the same growth could look like otherwise.
void takeLooks(const sim::Plant& looks, sim::Plant& plant) {
  plant.shapes = looks.shapes;
  plant.stem_colour = looks.stem_colour;
  plant.shoot_colour = looks.shoot_colour;
  plant.bark = looks.bark;
  plant.bark_picture = looks.bark_picture;
  plant.stem_emits = looks.stem_emits;
  plant.stem_emits_share = looks.stem_emits_share;
  plant.stem_alpha = looks.stem_alpha;
  plant.girth = looks.girth;
  plant.form = looks.form;
}

}  // namespace

Regrowth::Regrowth(std::filesystem::path folder, Assets& assets, Audience audience)
    : folder_(std::move(folder)), assets_(assets), audience_(std::move(audience)) {}

Regrowth::~Regrowth() = default;

void Regrowth::event(std::string text, std::string* keep) {
  if (keep != nullptr) *keep = text;
  audience_.send(frameOf(FrameKind::event, text));
}

template <class Work>
void Regrowth::stage(const std::string& name, Work work) {
  sim::throwIfStopped();
  event(busyEvent(version_, name, 0.0));
  const Clock::time_point began = Clock::now();
  work();
  auto& [times, seconds] = counts_.ran[name];
  ++times;
  seconds += secondsSince(began);
  ++counts_.all[name];
}

void Regrowth::refuse(Version version, const Told& told, const FileNames& names) {
  version_ = version;
  event(problemsEvent(version, Depth::text, told, names), &last_.problems);
}

void Regrowth::to(const scenes::Scene& asked, Version version, const Told& text, const FileNames& names) {
  version_ = version;
  began_ = Clock::now();
  counts_.ran.clear();
  Told told = text;
  const auto wrong = [&](std::vector<scenes::Problem> errors) {
    told.errors = std::move(errors);
    event(problemsEvent(version_, Depth::site, told, names), &last_.problems);
    event(busyEvent(version_, "", 1.0));
  };
  try {
    scenes::FedScene fed{asked, nullptr};
    if (!asked.asks.empty()) fed = scenes::fed(asked, folder_, {});
    const scenes::Scene& scene = fed.scene;
    makeSite(scene);
    makePlans(scene);
    told.warnings = plans_.warnings;
    event(problemsEvent(version_, Depth::site, told, names), &last_.problems);
    event(sceneEvent(version_, scene_, *site_, plans_.plantings, mesh_), &last_.scene);
    const std::string wanted = growthText(scene_, *site_), looks = looksText(scene_);
    if (wanted != grown_) {
      grow();
      grown_ = wanted;
    } else if (looks != looks_) {
      dress();
    }
    looks_ = looks;
    grown_version_ = version_;
    tellEnd();
  } catch (const scenes::PlacedError& error) {
    wrong(error.problems());
  } catch (const scenes::MeshMissing& missing) {
    wrong({missing.problem()});
  } catch (const sim::InputError& error) {
    wrong({{asked.file.string(), 0, 0, error.what()}});
  }
}

void Regrowth::makeSite(const scenes::Scene& scene) {
  const std::string tiled = tilingText(scene), lit = lightText(scene);
  if (!site_ || tiled != tiled_) {
    stage("tiling", [&] {
      scenes::Site site = scenes::makeSite(scene);
      std::string model = siteModel(site);
      mesh_ = sim::hexOf(sim::hashOf(model));
      assets_.setSite(mesh_, std::move(model));
      // Whatever stood, stood in another world.
      grown_.clear();
      growth_ = {};
      formed_.reset();
      bare_.reset();
      site_.emplace(std::move(site));
      bare_.emplace(site_->world);
    });
    tiled_ = tiled;
    lit_ = lit;
    return;
  }
  if (lit != lit_) {
    stage("lighting", [&] {
      scenes::inScene(scene, [&] {
        sim::Sky sky = sim::makeSky(scenes::skySettings(scene.sky));
        sim::Sun sun = scenes::makeSun(scene.sun);
        site_->sky = std::move(sky);
        site_->sun = std::move(sun);
        site_->random_sky = scenes::randomSky(scene.sky, scene.seed);
      });
    });
    lit_ = lit;
  }
  const int layers = scenes::layersFor(scene, bare_->frame());
  if (layers != bare_->layers()) stage("layering", [&] { bare_->setLayers(layers); });
}

void Regrowth::makePlans(const scenes::Scene& scene) {
  stage("preparing", [&] {
    // Plans look at the site as it is before anything grows; what has grown comes back if it still holds.
    sim::World grown = std::exchange(site_->world, *bare_);
    scenes::Plans plans;
    try {
      plans = scenes::plansOn(scene, *site_, {});
    } catch (...) {
      site_->world = std::move(grown);
      throw;
    }
    plans_ = std::move(plans);
    scene_ = scene;
    if (growthText(scene_, *site_) == grown_) site_->world = std::move(grown);
  });
}

sim::GrowthSettings Regrowth::growthSettings() const {
  return scenes::growthSettings(scene_, *site_, plans_.attractors);
}

void Regrowth::grow() {
  grown_.clear();
  grown_version_ = 0;
  bool told = false;
  stage("growing", [&] {
    site_->world = *bare_;
    std::unique_ptr<sim::Growing> growing;
    scenes::inScene(
        scene_, [&] { growing = scenes::beginGrowth(scene_, *site_, plans_.plantings, growthSettings()); });
    struct Watched {
      const sim::Growth*& growing;
      ~Watched() { growing = nullptr; }
    } const watched{growing_};
    const sim::Growth& now = growing->growth();
    for (Clock::time_point last = Clock::now(); growing->step();) {
      if (Clock::now() - last < kBetweenLooks) continue;
      if (!told) tellLooks(now);
      growing_ = &now;
      tellPlants(now, !std::exchange(told, true));
      event(growthEvent(version_, now, scene_.iterations, growing->alive(), secondsSince(began_)),
            &last_.growth);
      audience_.between();
      last = Clock::now();
    }
    growing_ = nullptr;
    growth_ = growing->take();
  });
  form();
  if (!told) tellLooks(shown());
  tellPlants(shown(), !told || formed_);
}

void Regrowth::form() {
  formed_.reset();
  if (!render::anyForm(growth_.plants)) return;
  stage("forming", [&] {
    formed_ = growth_;
    formed_->plants = render::formedStand(*bare_, site_->world, growth_.plants).plants;
  });
}

void Regrowth::dress() {
  stage("dressing", [&] {
    for (std::size_t s = 0; s < growth_.stands.size(); ++s) {
      const sim::Stand& stand = growth_.stands[s];
      const sim::Plant looks = plans_.plantings[s].process->seedling();
      for (std::size_t p = stand.first; p < stand.first + stand.count; ++p)
        takeLooks(looks, growth_.plants[p]);
    }
  });
  form();
  tellLooks(shown());
  tellPlants(shown(), true);
}

void Regrowth::tellLooks(const sim::Growth& growth) {
  std::vector<std::string> names;
  for (const sim::Planting& planting : plans_.plantings) names.push_back(planting.name);
  Looks looks = looksOf(version_, growth, names, site_->world.frame());
  assets_.setTextures(std::move(looks.textures));
  event(std::move(looks.event), &last_.looks);
}

void Regrowth::tellPlants(const sim::Growth& growth, bool anew) {
  if (anew) sent_.assign(growth.plants.size(), {});
  sent_version_ = version_;
  for (std::size_t p = 0; p < growth.plants.size(); ++p) {
    const sim::Plant& plant = growth.plants[p];
    const OfPlant of{version_, static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(growth.iterations)};
    const Sent now{plant.skeleton.parent.size(), plant.elements.size()};
    if (anew || now.nodes > sent_[p].nodes)
      audience_.send(nodesFrame(of, plant, site_->world.frame(), sent_[p].nodes));
    if (anew || now.elements > sent_[p].elements) {
      for (std::string& frame : elementFrames(of, plant, site_->world.frame(), sent_[p].elements))
        audience_.send(std::move(frame));
    }
    sent_[p] = now;
  }
}

void Regrowth::tellEnd() {
  const scenes::Report::Growth report =
      scenes::growthReport(scene_, *site_, bare_->occupied(), growth_, plans_.seed_lights);
  std::string ending = growth_.cut_short;
  for (const auto& attractors : report.attractors)
    ending += (ending.empty() ? "" : "; ") + attractors.name + ": " + attractors.ending;
  event(grownEvent(version_, report, scene_.iterations, ending, secondsSince(began_)), &last_.growth);
  event(stagesEvent(version_, counts_), &last_.stages);
  event(busyEvent(version_, "", 1.0));
}

std::vector<std::string> Regrowth::all() const {
  std::vector<std::string> frames{frameOf(FrameKind::event, helloEvent(version_))};
  const auto add = [&](const std::string& event) {
    if (!event.empty()) frames.push_back(frameOf(FrameKind::event, event));
  };
  add(last_.problems);
  add(last_.scene);
  const sim::Growth& growth = growing_ != nullptr ? *growing_ : shown();
  if (!growth.plants.empty() && site_) {
    add(last_.looks);
    for (std::size_t p = 0; p < growth.plants.size(); ++p) {
      const OfPlant of{sent_version_, static_cast<std::uint32_t>(p),
                       static_cast<std::uint32_t>(growth.iterations)};
      frames.push_back(nodesFrame(of, growth.plants[p], site_->world.frame(), 0));
      for (std::string& frame : elementFrames(of, growth.plants[p], site_->world.frame(), 0))
        frames.push_back(std::move(frame));
    }
    add(last_.growth);
  }
  add(last_.stages);
  return frames;
}

void Regrowth::requireGrown(Version version) const {
  if (grown_version_ == 0 || version != grown_version_)
    throw Refused(409, "what has grown is of another version of the texts");
}

std::string Regrowth::surfaces(Version version) {
  requireGrown(version);
  return surfacesOf(version, scene_, *site_, *bare_);
}

std::string Regrowth::layers(Version version, int axis, double at_m) {
  requireGrown(version);
  return layersOf(version, *bare_, axis, at_m);
}

std::string Regrowth::why(Version version, std::size_t plant, sim::NodeId node) {
  requireGrown(version);
  return whyOf(version, *bare_, plans_.plantings, growthSettings(), growth_, plant, node);
}

}  // namespace espalier::studio
