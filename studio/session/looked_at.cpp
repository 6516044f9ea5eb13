#include "studio/session/looked_at.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "scenes/show/pictures.h"
#include "sim/base/counted.h"
#include "sim/base/error.h"
#include "sim/base/faces.h"
#include "sim/light/lighting.h"
#include "studio/wire/frame.h"
#include "studio/wire/json.h"

namespace espalier::studio {
namespace {

constexpr std::uint8_t kNone = 255, kHigh = 254;

struct Channel {
  std::string name, unit;
  double high = 1.0;
  std::optional<double> least;  ///< from which a plant grows
  std::vector<float> values;
};

std::string words(sim::Outcome outcome) {
  switch (outcome) {
    case sim::Outcome::grown:
      return "met the rules";
    case sim::Outcome::resting:
      return "rested: in dimmer light growth is slower";
    case sim::Outcome::blocked:
      return "something stands in its way";
    case sim::Outcome::too_far:
      return "too far from the scene";
    case sim::Outcome::too_near:
      return "too near to the scene";
    case sim::Outcome::too_dark:
      return "too dark";
    case sim::Outcome::too_bright:
      return "too bright";
    case sim::Outcome::out_of_world:
      return "outside of the world";
    case sim::Outcome::forbidden:
      return "the nearest region allows no growth";
    case sim::Outcome::claimed:
      return "another limb took the voxel first";
    case sim::Outcome::no_trial:
      return "none of its trials met the rules";
    case sim::Outcome::unmet:
      return "what it senses there is not what the rules require";
  }
  return {};
}

Json trialsJson(const sim::Proposal& proposal, const sim::Frame& frame) {
  Json trials = Json::array();
  for (const sim::Attempt& attempt : proposal.attempts) {
    trials.push_back({{"from_m", jsonOf(sim::worldFromVoxel(frame, attempt.from_vx))},
                      {"to_m", jsonOf(sim::worldFromVoxel(frame, attempt.to_vx))},
                      {"outcome", std::string(sim::nameOf(attempt.outcome))},
                      {"taken", attempt.taken},
                      {"words", words(attempt.outcome)}});
  }
  return trials;
}

/// A site's question, asked again.
struct Asked {
  int iteration = 0;
  sim::Proposal proposal;
};

Json askedJson(const std::optional<Asked>& asked, const sim::Frame& frame) {
  if (!asked) return nullptr;
  return {{"iteration", asked->iteration},
          {"outcome", std::string(sim::nameOf(asked->proposal.outcome))},
          {"words", words(asked->proposal.outcome)},
          {"trials", trialsJson(asked->proposal, frame)}};
}

}  // namespace

std::string surfacesOf(Version version, const scenes::Scene& scene, const scenes::Site& site,
                       const sim::World& bare) {
  sim::LightWanted wanted;
  wanted.random_sky = site.random_sky;
  const sim::Lighting light = sim::lightOf(site.world, site.sky, site.sun, wanted);
  const bool sun = !light.about.sun.empty();
  std::vector<std::size_t> of_scene;
  for (std::size_t i = 0; i < light.surfaces.size(); ++i) {
    if (bare.occupied().at(light.surfaces[i].voxel)) of_scene.push_back(i);
  }
  std::vector<Channel> channels;
  channels.push_back({"sky exposure", "", 1.0, {}, light.sky.values});
  if (sun) channels.push_back({"sun exposure", "", 1.0, {}, light.sun.values});
  if (sun && scene.sun.place)
    channels.push_back(
        {"hours of sun", "h a day", std::max(1.0, light.about.sun_hours), {}, light.sun_hours.values});
  for (const scenes::PlantSpec& plant : scene.plants) {
    const render::LightNeeds needs = scenes::lightNeeds(*plant.rules);
    Channel blend{"exposure of " + plant.name, "", 1.0, needs.least, {}};
    for (std::size_t i = 0; i < light.surfaces.size(); ++i)
      blend.values.push_back(static_cast<float>(needs.sky) * light.sky.values[i] +
                             (sun ? static_cast<float>(needs.sun) * light.sun.values[i] : 0.0f));
    channels.push_back(std::move(blend));
  }
  Json listed = Json::array();
  for (const Channel& channel : channels) {
    listed.push_back({{"name", channel.name}, {"unit", channel.unit}, {"low", 0.0}, {"high", channel.high}});
    if (channel.least) listed.back()["least"] = *channel.least;
  }
  std::string header = textOf({{"version", version},
                               {"count", of_scene.size()},
                               {"low_m", jsonOf(site.world.frame().origin_m)},
                               {"voxel_m", site.world.frame().voxel_m},
                               {"sky", light.about.sky},
                               {"sun", light.about.sun},
                               {"channels", std::move(listed)}});
  header.resize((header.size() + 3) / 4 * 4, ' ');
  std::string bytes;
  put(bytes, static_cast<std::uint32_t>(header.size()));
  bytes += header;
  for (const std::size_t i : of_scene) {
    const sim::Voxel v = light.surfaces[i].voxel;
    for (int axis = 0; axis < 3; ++axis) put(bytes, static_cast<std::uint16_t>(v[axis]));
  }
  for (const std::size_t i : of_scene) {
    std::uint8_t open = 0;
    for (std::size_t face = 0; face < sim::kFaces; ++face) {
      if (!bare.occupied().at(light.surfaces[i].voxel + sim::kFaceNormals[face]))
        open = static_cast<std::uint8_t>(open | 1u << face);
    }
    put(bytes, open);
  }
  for (const Channel& channel : channels) {
    for (const std::size_t i : of_scene) {
      const double share = static_cast<double>(channel.values[i]) / channel.high;
      put(bytes, std::isfinite(share)
                     ? static_cast<std::uint8_t>(std::lround(kHigh * std::clamp(share, 0.0, 1.0)))
                     : kNone);
    }
  }
  return bytes;
}

std::string layersOf(Version version, const sim::World& bare, int axis, double at_m) {
  constexpr std::uint8_t kOccupied = 255;
  const sim::Frame& frame = bare.frame();
  const int across = (axis + 1) % 3, up = (axis + 2) % 3;
  const double at_vx = (at_m - frame.origin_m[axis]) / frame.voxel_m;
  if (!(at_vx >= -0.5 && at_vx < frame.size[axis] - 0.5))
    throw sim::InputError(fmt::format("the world has nothing at {} m", at_m));
  sim::Voxel v(0);
  v[axis] = static_cast<int>(std::floor(at_vx + 0.5));
  const auto along = [&](int of) {
    sim::Vec3 way(0.0);
    way[of] = frame.voxel_m * frame.size[of];
    return jsonOf(way);
  };
  std::string bytes;
  sim::Vec3 corner_vx(-0.5);
  corner_vx[axis] = v[axis];
  std::string header = textOf({{"version", version},
                               {"corner_m", jsonOf(sim::worldFromVoxel(frame, corner_vx))},
                               {"across_m", along(across)},
                               {"up_m", along(up)},
                               {"across", frame.size[across]},
                               {"up", frame.size[up]},
                               {"layers", bare.layers()}});
  header.resize((header.size() + 3) / 4 * 4, ' ');
  put(bytes, static_cast<std::uint32_t>(header.size()));
  bytes += header;
  for (v[up] = 0; v[up] < frame.size[up]; ++v[up]) {
    for (v[across] = 0; v[across] < frame.size[across]; ++v[across]) {
      const auto near = bare.nearnessAt(v);
      put(bytes, bare.occupied().at(v) ? kOccupied
                 : near ? static_cast<std::uint8_t>(std::clamp(near->layer, 0, 254))
                        : std::uint8_t{0});
    }
  }
  return bytes;
}

std::string whyOf(Version version, const sim::World& bare, const std::vector<sim::Planting>& plantings,
                  const sim::GrowthSettings& settings, const sim::Growth& growth, std::size_t plant,
                  sim::NodeId node) {
  if (plant >= growth.plants.size() || node < 0 || node >= growth.plants[plant].skeleton.size())
    throw sim::InputError(fmt::format("plant {} has no node {}", plant, node));
  const sim::Skeleton& skeleton = growth.plants[plant].skeleton;
  const auto n = static_cast<std::size_t>(node);
  std::size_t planting = 0;
  while (plant >= growth.stands[planting].first + growth.stands[planting].count) ++planting;
  const auto own = static_cast<std::int32_t>(plant - growth.stands[planting].first);

  sim::World world = bare;
  sim::Growing again(world, plantings, settings);
  std::optional<Asked> came, last;
  const auto ask = [&](const sim::Due& due, const sim::Site& site) {
    return Asked{again.growth().iterations, again.propose(due, planting, site)};
  };
  // Its own beginning is asked of its parent's sites; then its own are, as long as they are due.
  while (again.growth().iterations < growth.iterations) {
    const int iteration = again.growth().iterations;
    if (iteration >= skeleton.born[n]) {
      const sim::Due due = again.due();
      for (const sim::Site& site : due.sites[planting]) {
        if (site.plant != own) continue;
        if (iteration == skeleton.born[n] && skeleton.parent[n] != sim::kNoNode &&
            site.node == skeleton.parent[n] && !came) {
          Asked asked = ask(due, site);
          const auto& segment = asked.proposal.segment;
          if (segment && segment->to_vx == skeleton.position_vx[n]) came = std::move(asked);
        } else if (site.node == node) {
          last = ask(due, site);
        }
      }
    }
    if (!again.step()) break;
  }
  Json sensed = Json::array();
  for (const auto& [name, values] : skeleton.columns)
    sensed.push_back({{"name", name}, {"value", values[n]}});
  const sim::Frame& frame = bare.frame();
  return textOf({{"version", version},
                 {"plant", plant},
                 {"node", node},
                 {"name", growth.plants[plant].name},
                 {"at_m", jsonOf(sim::worldFromVoxel(frame, skeleton.position_vx[n]))},
                 {"born", skeleton.born[n]},
                 {"sensed", std::move(sensed)},
                 {"came", askedJson(came, frame)},
                 {"last", askedJson(last, frame)}});
}

}  // namespace espalier::studio
