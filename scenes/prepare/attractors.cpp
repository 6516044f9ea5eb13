#include "scenes/prepare/attractors.h"

#include <fmt/format.h>

#include <algorithm>

#include "rules/growth/front_memory.h"
#include "sim/base/counted.h"
#include "sim/base/error.h"
#include "sim/base/random.h"
#include "sim/scatter/inside_points.h"
#include "sim/scatter/surface_points.h"

namespace espalier::scenes {
namespace {

/// What is said of some attractors, and what is left of them in the world.
class Naming {
 public:
  Naming(std::string name, const Place& place, const Scene& scene, const sim::World& world,
         std::vector<Problem>* warnings)
      : name_(std::move(name)), place_(place), scene_(scene), world_(world), warnings_(warnings) {}

  NamedPoints clipped(const sim::PointSet& points) const {
    NamedPoints kept{name_, {}, {}, {}};
    std::size_t outside = 0, blocked = 0;
    std::string hollow;  // what else could be done
    for (std::size_t i = 0; i < points.at.size(); ++i) {
      const sim::Vec3 at_vx = freed(sim::voxelFromWorld(world_.frame(), points.at[i]), points.normal[i]);
      const sim::Voxel v = voxelOf(at_vx);
      if (!sim::contains(world_.frame().size, v)) {
        ++outside;
      } else if (world_.occupied().at(v)) {
        ++blocked;
        if (hollow.empty()) hollow = sim::orLeaveHollow(world_.part(world_.partAt(v)));
      } else {
        kept.at_vx.push_back(at_vx);
        kept.normal.push_back(points.normal[i]);
        if (!points.wave.empty()) kept.wave.push_back(points.wave[i]);
      }
    }
    const std::string lost =
        fmt::format("of {} {} beyond the world and {} in what stands there",
                    sim::counted(points.at.size(), "point"), sim::counted(outside, "lies", "lie"), blocked);
    if (kept.at_vx.empty())
      fail(lost + ": none is left; expected a place in the open, inside the world" + hollow);
    if (outside > 0) warn(lost);
    return kept;
  }

  /// So many that what follows them fits into memory.
  void requireFew(double count) const {
    if (count > rules::kMostPoints)
      fail(fmt::format("{:.0f} points with those before it; expected at most {:.0f} in a scene", count,
                       rules::kMostPoints));
  }

  void warn(const std::string& text) const {
    if (warnings_ != nullptr) warnings_->push_back(problem(text));
  }
  [[noreturn]] void fail(const std::string& text) const { throw PlacedError({problem(text)}); }

 private:
  /// Far outside of the world for what no voxel's number can reach.
  static sim::Voxel voxelOf(sim::Vec3 p_vx) {
    return sim::voxelAt(glm::clamp(p_vx, sim::Vec3(-1e8), sim::Vec3(1e8)));
  }

  /// A point on a mesh that is tiled lies in one of its voxels: it steps out of them.
  sim::Vec3 freed(sim::Vec3 at_vx, sim::Vec3 normal) const {
    constexpr double kSteps[] = {0.5, 1.0, 1.5, 2.0};
    if (normal == sim::Vec3(0.0) || !world_.occupied().at(voxelOf(at_vx))) return at_vx;
    for (const double side : {1.0, -1.0}) {
      for (const double step : kSteps) {
        const sim::Vec3 moved = at_vx + side * step * normal;
        const sim::Voxel v = voxelOf(moved);
        if (sim::contains(world_.frame().size, v) && !world_.occupied().at(v)) return moved;
      }
    }
    return at_vx;
  }

  Problem problem(const std::string& text) const {
    return problemAt(place_, scene_.file, fmt::format("attractors {}: {}", inQuotes(name_), text));
  }

  std::string name_;
  Place place_;
  const Scene& scene_;
  const sim::World& world_;
  std::vector<Problem>* warnings_;
};

/// The attractors of one entry, while they come into being.
class Making {
 public:
  Making(const AttractorsSpec& spec, const Scene& scene, const Site& site, std::vector<Problem>* warnings)
      : spec_(spec), scene_(scene), site_(site), say_(spec.name, spec.place, scene, site.world, warnings) {}

  NamedPoints make(const std::vector<sim::Vec3>& listed_m,
                   const std::optional<sim::DensityPicture>& density) const {
    sim::PointSet points;
    try {
      points = density ? over(*density) : strewn(listed_m);
    } catch (const PlacedError&) {
      throw;
    } catch (const sim::InputError& error) {  // of a mesh, without its place
      say_.fail(error.what());
    }
    return say_.clipped(points);
  }

 private:
  sim::PointSet strewn(const std::vector<sim::Vec3>& listed_m) const {
    if (!spec_.table.file.empty()) return {listed_m, std::vector<sim::Vec3>(listed_m.size(), sim::Vec3(0.0))};
    const std::uint64_t stream = streamHere();
    const sim::Strewing strewing = rules::strewingOf(spec_.strewing);
    if (!spec_.inside.empty()) return within(strewing.count, stream);
    if (spec_.surface.empty())
      return sim::scatterInside(rules::envelopeOf(spec_.solid, spec_.at_m.value_or(sim::Vec3(0.0))), strewing,
                                stream);
    if (!spec_.spacing_m) return sim::scatterOn(mesh(spec_.surface), strewing.count, stream);
    return apart(stream);
  }

  sim::PointSet within(std::size_t count, std::uint64_t stream) const {
    sim::InsidePoints found = sim::scatterWithin(mesh(spec_.inside), count, stream);
    if (found.doubt.doubtful > 0.0) say_.warn(leakOf(spec_.inside, found.doubt));
    return std::move(found.points);
  }

  sim::PointSet apart(std::uint64_t stream) const {
    sim::PointSet points =
        sim::scatterApart(mesh(spec_.surface), most(), *spec_.spacing_m, stream, spec_.waves);
    warnOfRoom(points.at.size(), fmt::format("on '{}'", spec_.surface));
    return points;
  }

  sim::PointSet over(const sim::DensityPicture& density) const {
    const std::uint64_t stream = streamHere();
    const PictureSpec& laid = *spec_.picture;
    const sim::PictureFrame frame{laid.top_left_m, laid.top_right_m - laid.top_left_m,
                                  laid.bottom_left_m - laid.top_left_m};
    if (!spec_.spacing_m)
      return sim::scatterOver(density, frame, rules::strewingOf(spec_.strewing).count, stream);
    sim::PointSet points =
        sim::scatterOverApart(density, frame, most(), *spec_.spacing_m, stream, spec_.waves);
    warnOfRoom(points.at.size(), "in the picture");
    return points;
  }

  std::size_t most() const {
    return static_cast<std::size_t>(spec_.strewing.count.value_or(static_cast<int>(rules::kMostPoints)));
  }

  void warnOfRoom(std::size_t points, const std::string& where) const {
    if (spec_.strewing.count && points < most())
      say_.warn(fmt::format("{} of {} points find room {} with {} m between any two", points, most(), where,
                            *spec_.spacing_m));
  }

  std::uint64_t streamHere() const { return sim::streamOf(scene_.seed, "attractors " + spec_.name); }

  const sim::Mesh& mesh(const std::string& name) const { return meshNamed(site_, name); }

  const AttractorsSpec& spec_;
  const Scene& scene_;
  const Site& site_;
  Naming say_;
};

}  // namespace

std::vector<NamedPoints> attractorsOf(const Scene& scene, const Site& site, std::vector<Problem>* warnings) {
  std::vector<NamedPoints> all;
  std::size_t count = 0;
  Gathering wrong(scene.file);
  for (std::size_t i = 0; i < scene.attractors.size(); ++i) {
    const AttractorsSpec& spec = scene.attractors[i];
    wrong.part(spec.place, [&] {
      all.push_back(Making(spec, scene, site, warnings).make(site.listed_m.at(i), site.densities.at(i)));
      count += all.back().at_vx.size();
      Naming(spec.name, spec.place, scene, site.world, warnings).requireFew(static_cast<double>(count));
    });
  }
  wrong.end();
  return all;
}

std::vector<NamedPoints> crownsOf(const Scene& scene, const Site& site,
                                  const std::vector<sim::Planting>& plantings,
                                  std::vector<Problem>* warnings) {
  std::vector<NamedPoints> all;
  double count = 0.0;
  Gathering wrong(scene.file);
  for (std::size_t i = 0; i < scene.plants.size(); ++i) {
    const PlantSpec& plant = scene.plants[i];
    const auto& crown = plant.rules->colonization.crown;
    if (!crown || !colonizes(plant)) continue;
    wrong.part(plant.rules_place, [&] {
      const Naming say(crownOf(plant.name), plant.rules_place, scene, site.world, warnings);
      const sim::Strewing strewing = rules::strewingOf(crown->strewing);
      count += static_cast<double>(strewing.count) * static_cast<double>(plantings.at(i).seeds.size());
      say.requireFew(count);
      sim::PointSet points;
      for (const sim::Seed& seed : plantings.at(i).seeds) {
        const sim::Vec3 at_m = sim::worldFromVoxel(site.world.frame(), seed.at_vx);
        const sim::PointSet one =
            sim::scatterInside(rules::envelopeOf(crown->shape, at_m + sim::Vec3(0.0, crown->trunk_m, 0.0)),
                               strewing, sim::streamOf(scene.seed, crownOf(plant.name), seed.key));
        points.at.insert(points.at.end(), one.at.begin(), one.at.end());
        points.normal.insert(points.normal.end(), one.normal.begin(), one.normal.end());
      }
      all.push_back(say.clipped(points));
    });
  }
  wrong.end();
  return all;
}

sim::Commons commonsOf(const std::vector<NamedPoints>& attractors) {
  sim::Commons commons;
  for (const NamedPoints& points : attractors) {
    sim::Columns& columns = commons[rules::attractorsNamed(points.name)];
    columns[rules::kAttractorPlace] = points.at_vx;
    columns[rules::kAttractorNormal] = points.normal;
    if (!points.wave.empty()) columns[rules::kAttractorWave] = points.wave;
  }
  return commons;
}

}  // namespace espalier::scenes
