#include "scenes/prepare/attractors.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/base/error.h"
#include "sim/base/random.h"
#include "sim/scatter/inside_points.h"
#include "sim/scatter/surface_points.h"

namespace espalier::scenes {
namespace {

/// The attractors of one entry, while they come into being.
class Making {
 public:
  Making(const AttractorsSpec& spec, const Scene& scene, const Site& site, std::vector<Problem>* warnings)
      : spec_(spec), scene_(scene), site_(site), warnings_(warnings) {}

  NamedPoints make(const std::vector<sim::Vec3>& listed_m) const {
    sim::PointSet points;
    try {
      points = strewn(listed_m);
    } catch (const sim::InputError& error) {  // of a mesh, without its place
      fail(error.what());
    }
    return clipped(points);
  }

 private:
  sim::PointSet strewn(const std::vector<sim::Vec3>& listed_m) const {
    if (!spec_.points.empty()) return {listed_m, std::vector<sim::Vec3>(listed_m.size(), sim::Vec3(0.0))};
    const std::uint64_t stream = sim::streamOf(scene_.seed, "attractors " + spec_.name);
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
    if (found.doubt.doubtful > 0.0) warn(leakOf(spec_.inside, found.doubt));
    return std::move(found.points);
  }

  sim::PointSet apart(std::uint64_t stream) const {
    const auto most =
        static_cast<std::size_t>(spec_.strewing.count.value_or(static_cast<int>(rules::kMostPoints)));
    sim::PointSet points = sim::scatterApart(mesh(spec_.surface), most, *spec_.spacing_m, stream);
    if (spec_.strewing.count && points.at.size() < most) {
      warn(fmt::format("{} of {} points find room on '{}' with {} m between any two", points.at.size(), most,
                       spec_.surface, *spec_.spacing_m));
    }
    return points;
  }

  NamedPoints clipped(const sim::PointSet& points) const {
    const sim::World& world = site_.world;
    NamedPoints kept{spec_.name, {}, {}};
    std::size_t outside = 0, blocked = 0;
    for (std::size_t i = 0; i < points.at.size(); ++i) {
      const sim::Vec3 at_vx = freed(sim::voxelFromWorld(world.frame(), points.at[i]), points.normal[i]);
      const sim::Voxel v = voxelOf(at_vx);
      if (!sim::contains(world.frame().size, v)) {
        ++outside;
      } else if (world.occupied().at(v)) {
        ++blocked;
      } else {
        kept.at_vx.push_back(at_vx);
        kept.normal.push_back(points.normal[i]);
      }
    }
    const std::string lost = fmt::format("of {} points {} lie beyond the world and {} in what stands there",
                                         points.at.size(), outside, blocked);
    if (kept.at_vx.empty()) fail(lost + ": none is left; expected a place in the open, inside the world");
    if (outside > 0) warn(lost);
    return kept;
  }

  /// Far outside of the world for what no voxel's number can reach.
  static sim::Voxel voxelOf(sim::Vec3 p_vx) {
    return sim::voxelAt(glm::clamp(p_vx, sim::Vec3(-1e8), sim::Vec3(1e8)));
  }

  /// A point on a mesh that is tiled lies in one of its voxels: it steps out of them.
  sim::Vec3 freed(sim::Vec3 at_vx, sim::Vec3 normal) const {
    constexpr double kSteps[] = {0.5, 1.0, 1.5, 2.0};
    if (normal == sim::Vec3(0.0) || !site_.world.occupied().at(voxelOf(at_vx))) return at_vx;
    for (const double side : {1.0, -1.0}) {
      for (const double step : kSteps) {
        const sim::Vec3 moved = at_vx + side * step * normal;
        const sim::Voxel v = voxelOf(moved);
        if (sim::contains(site_.world.frame().size, v) && !site_.world.occupied().at(v)) return moved;
      }
    }
    return at_vx;
  }

  const sim::Mesh& mesh(const std::string& name) const { return meshNamed(site_, name); }

  Problem problem(const std::string& text) const {
    const Place& at = spec_.place;
    return {at.path ? *at.path : scene_.file.string(), at.line, at.column,
            fmt::format("attractors {}: {}", inQuotes(spec_.name), text)};
  }
  void warn(const std::string& text) const {
    if (warnings_ != nullptr) warnings_->push_back(problem(text));
  }

  [[noreturn]] void fail(const std::string& text) const { throw sim::InputError(format(problem(text))); }

  const AttractorsSpec& spec_;
  const Scene& scene_;
  const Site& site_;
  std::vector<Problem>* warnings_;
};

}  // namespace

std::vector<NamedPoints> attractorsOf(const Scene& scene, const Site& site, std::vector<Problem>* warnings) {
  std::vector<NamedPoints> all;
  for (std::size_t i = 0; i < scene.attractors.size(); ++i)
    all.push_back(Making(scene.attractors[i], scene, site, warnings).make(site.listed_m.at(i)));
  return all;
}

sim::Commons commonsOf(const std::vector<NamedPoints>& attractors) {
  sim::Commons commons;
  for (const NamedPoints& points : attractors) {
    sim::Columns& columns = commons["attractors " + points.name];
    columns["at_vx"] = points.at_vx;
    columns["normal"] = points.normal;
  }
  return commons;
}

}  // namespace espalier::scenes
