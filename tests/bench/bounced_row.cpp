#include <fmt/format.h>
#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/read/read_scene.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/light/interreflection.h"
#include "sim/light/met.h"
#include "tests/bench/embree_scene.h"
#include "tests/bench/rows.h"
#include "tests/bench/voxel_faces.h"

namespace espalier::bench {
namespace {

constexpr const char* kRow = "11 bounced light";
constexpr int kDirections = 128;  // over each half of the sphere
constexpr std::size_t kSample = 20'000;

/// With voxels so many times as wide as the scene has them.
scenes::Site courtyard(double coarser = 1.0) {
  auto scene = scenes::readScene(ESPALIER_SOURCE_DIR "/scenes/library/courtyard.yaml");
  if (!scene) throw sim::InputError(scenes::format(scene.problems()));
  scene->world.voxel_m = coarser * *scene->world.voxel_m;
  return scenes::makeSite(*scene);
}

sim::DirectionSet sphere() {
  sim::DirectionSet directions = sim::makeSky({.directions = kDirections}).directions;
  for (sim::LatticeDirection& d : directions) d.weight /= 2;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const sim::Voxel down = -directions[i].v;
    directions.push_back({down, sim::crossedVoxels(down), directions[i].weight});
  }
  return directions;
}

/// The scene in the light of its sky and, as much as each place gets of it in a day, of its sun.
sim::BounceSources sourcesOf(const sim::World& world, const sim::Lighting& light) {
  sim::BounceSources sources;
  const std::size_t count = light.surfaces.size() + light.faces.size();
  sources.sun.resize(count);
  sources.albedo.resize(count, sim::Colour(0.5f));
  for (std::size_t i = 0; i < count; ++i) {
    sources.sun[i] = sim::Colour(light.sun.values[i]);
    if (i < light.surfaces.size()) sources.albedo[i] = world.surfaceAt(light.surfaces[i].voxel)->colour;
  }
  return sources;
}

/// Embree's closest hits on the faces of voxels, along one direction from many places.
class ClosestHits {
 public:
  explicit ClosestHits(const sim::BitVolume& opaque)
      : faces_(voxelFaces(opaque, false)), scene_(faces_.corners, faces_.quads) {}

  /// The number of the face that each place sees; the number of faces where it sees none.
  void along(sim::Vec3f unit, const sim::Voxel* places, std::size_t count, std::uint32_t* seen) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    constexpr std::size_t kPacket = 16;
    alignas(64) RTCRayHit16 packet{};
    alignas(64) std::array<int, kPacket> valid{};
    for (std::size_t first = 0; first < count; first += kPacket) {
      for (std::size_t k = 0; k < kPacket; ++k) {
        valid[k] = first + k < count ? -1 : 0;
        const sim::Voxel place = places[std::min(first + k, count - 1)];
        packet.ray.org_x[k] = static_cast<float>(place.x);
        packet.ray.org_y[k] = static_cast<float>(place.y);
        packet.ray.org_z[k] = static_cast<float>(place.z);
        packet.ray.dir_x[k] = unit.x;
        packet.ray.dir_y[k] = unit.y;
        packet.ray.dir_z[k] = unit.z;
        packet.ray.tnear[k] = 0.0f;
        packet.ray.tfar[k] = std::numeric_limits<float>::infinity();
        packet.ray.mask[k] = ~0u;
        packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
      }
      rtcIntersect16(valid.data(), scene_.get(), &context, &packet);
      for (std::size_t k = 0; k < kPacket && first + k < count; ++k) {
        const bool hit = packet.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
        seen[first + k] = hit ? packet.hit.primID[k] : static_cast<std::uint32_t>(faces_.quads.size());
      }
    }
  }

  const VoxelFaces& faces() const { return faces_; }

 private:
  VoxelFaces faces_;
  EmbreeScene scene_;
};

/// What places receive of the faces that they see, by grey values of these: a sum for each.
std::vector<float> byEmbree(const ClosestHits& embree, const std::vector<sim::Voxel>& places,
                            const std::vector<sim::Vec3f>* normals, const sim::DirectionSet& directions,
                            const std::vector<float>& values) {
  std::vector<float> sums(places.size());
  sim::parallelFor(places.size(), 4096, [&](std::size_t begin, std::size_t end) {
    const unsigned mode = _mm_getcsr();
    _mm_setcsr(mode | 0x8040);  // flush denormals, as Embree's manual asks for speed
    std::vector<sim::Voxel> before;
    std::vector<std::size_t> whose;
    std::vector<std::uint32_t> seen(end - begin);
    for (const sim::LatticeDirection& d : directions) {
      const sim::Vec3f unit(glm::normalize(sim::Vec3(d.v)));
      before.clear();
      whose.clear();
      for (std::size_t i = begin; i < end; ++i) {
        if (places[i].y < 0 || (normals && glm::dot((*normals)[i], unit) <= 0.0f)) continue;
        before.push_back(places[i]);
        whose.push_back(i);
      }
      if (before.empty()) continue;
      embree.along(unit, before.data(), before.size(), seen.data());
      for (std::size_t k = 0; k < whose.size(); ++k) {
        const float cosine = normals ? glm::dot((*normals)[whose[k]], unit) : 1.0f;
        sums[whose[k]] += cosine * static_cast<float>(d.weight) * values[seen[k]];
      }
    }
    _mm_setcsr(mode);
  });
  return sums;
}

/// The voxel behind a face.
sim::Voxel behind(const VoxelFaces& faces, std::size_t face, const sim::BitVolume& opaque) {
  const auto& quad = faces.quads[face];
  const sim::Vec3f middle = 0.5f * (faces.corners[quad[0]] + faces.corners[quad[2]]);
  for (int axis = 0; axis < 3; ++axis) {
    const float along = middle[axis] - std::floor(middle[axis]);
    if (std::abs(along - 0.5f) > 0.1f) continue;
    for (const float side : {-0.5f, 0.5f}) {
      sim::Vec3f at = middle;
      at[axis] += side;
      const auto v = sim::Voxel(glm::round(at));
      if (opaque.at(v)) return v;
    }
  }
  throw sim::InputError("a face of no voxel");
}

sim::Bounced bounced(const sim::World& world, const sim::Lighting& light, const sim::BounceSources& sources,
                     int passes) {
  return sim::Interreflection(world, light, {.directions = kDirections, .passes = passes, .tolerance = 0.0})
      .of(sources);
}

/// What a doubling of the resolution costs. By Greene's argument, sixteen times: eight times the voxels, and
/// rays of twice the length; K-fold complexity K^(4/3). Of N patches that all meet each other, N^2: also
/// sixteen times, as there are four times as many, and K^2 in complexity.
void benchDoubling(Report& report) {
  std::vector<double> surfaces, voxels;
  std::vector<std::size_t> receivers;
  for (const double coarser : {2.0, 1.0}) {
    const scenes::Site site = courtyard(coarser);
    const sim::Lighting light = sim::lightOf(site.world, site.sky, site.sun);
    const sim::BounceSources sources = sourcesOf(site.world, light);
    sim::Stops<std::uint16_t> stops(site.world.opaque());
    for (auto& face : stops.faces) std::fill(face.values.begin(), face.values.end(), std::uint16_t{30000});
    const sim::DirectionSet directions = sphere();
    const auto seconds = medianSeconds(
        {[&] { bounced(site.world, light, sources, 2); }, [&] { sim::carriedSum(stops, directions); }});
    surfaces.push_back(seconds[0]);
    voxels.push_back(seconds[1]);
    receivers.push_back(sources.sun.size());
  }
  const auto doubling = [&](const char* what, const std::vector<double>& seconds) {
    const double factor = seconds[1] / seconds[0];
    report.add({kRow, std::string("twice the resolution: ") + what, factor, "times", 0, Target{16.0, false}});
    report.note(fmt::format("  resolution to the power {:.2f}; Greene's rays: 4, patches that all meet: 4",
                            std::log2(factor)));
  };
  doubling("every surface, two passes", surfaces);
  report.note(fmt::format("  of {} and of {} receivers", receivers[0], receivers[1]));
  doubling("every voxel, grey", voxels);
}

void benchSurfacesLit(const sim::World& world, const sim::Lighting& light, const ClosestHits& embree,
                      Report& report) {
  const sim::BounceSources sources = sourcesOf(world, light);
  const sim::SurfaceSensors sensors = sim::sensorsOf(world, light);
  const std::vector<sim::Voxel> from = sim::viewpoints(sensors);
  std::vector<sim::Vec3f> normals;
  for (const sim::TiledVoxel& t : sensors.surfaces) normals.push_back(t.surface.normal);
  std::vector<float> values(embree.faces().quads.size() + 1, 0.5f);
  values.back() = 0.0f;
  const sim::DirectionSet directions = sphere();
  sim::Bounced one, four;
  std::vector<float> theirs;
  const std::vector<double> seconds = medianSeconds(
      {[&] { one = bounced(world, light, sources, 2); }, [&] { four = bounced(world, light, sources, 4); },
       [&] { theirs = byEmbree(embree, from, &normals, directions, values); }});
  report.note(fmt::format("  {} surfaces and {} faces, {} directions", light.surfaces.size(),
                          light.faces.size(), directions.size()));
  report.add({kRow, "every surface, colour, two passes, whole", seconds[0], "s"});
  report.add({kRow, "every surface, colour, four passes, whole", seconds[1], "s", 0, Target{1.5, false}});
  report.add({kRow, "Embree's closest hits before the same surfaces, once, and their sums", seconds[2], "s"});
  report.add(
      {kRow, "Embree's time over that of two passes", seconds[2] / seconds[0], "times", 0, Target{1.0}});
}

void benchEveryVoxelLit(const sim::World& world, const ClosestHits& embree, Report& report) {
  const sim::BitVolume& opaque = world.opaque();
  const sim::Voxel size = opaque.size();
  const sim::DirectionSet directions = sphere();
  sim::Stops<std::uint16_t> stops(opaque);
  const auto valueOf = [](sim::Voxel v) {
    return static_cast<std::uint16_t>(1 +
                                      static_cast<unsigned>((v.y * 613 + v.z) * 757 + v.x) * 40503u % 65535u);
  };
  for (auto& face : stops.faces) {
    const std::vector<sim::Voxel> voxels = face.where.voxels();
    for (std::size_t i = 0; i < voxels.size(); ++i) face.values[i] = valueOf(voxels[i]);
  }
  std::vector<float> of_faces;
  for (std::size_t f = 0; f < embree.faces().quads.size(); ++f)
    of_faces.push_back(valueOf(behind(embree.faces(), f, opaque)));
  of_faces.push_back(0.0f);
  std::vector<sim::Voxel> places;
  for (std::size_t i = 0; places.size() < kSample; ++i) {
    const auto n = static_cast<int>(i * 2'654'435'761u %
                                    (static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                                     static_cast<std::size_t>(size.z)));
    const sim::Voxel v(n % size.x, n / size.x % size.y, n / size.x / size.y);
    if (!opaque.at(v)) places.push_back(v);
  }
  const auto cast = [&](sim::Voxel p, const sim::LatticeDirection& d) -> std::uint32_t {
    for (sim::Voxel start = p;; start += d.v) {
      for (const sim::Voxel o : d.crossed) {
        const sim::Voxel q = start + o;
        if (!sim::contains(size, q)) return 0;
        if (opaque.at(q)) return valueOf(q);
      }
    }
  };
  sim::Field<std::uint16_t> field;
  std::vector<std::uint16_t> plain(places.size());
  std::vector<float> theirs;
  const std::vector<double> seconds =
      medianSeconds({[&] { field = sim::carriedSum(stops, directions); },
                     [&] {
                       sim::parallelFor(places.size(), 64, [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i) {
                           std::uint64_t sum = 0;
                           for (const auto& d : directions)
                             sum += std::uint64_t{d.weight} * cast(places[i], d);
                           plain[i] = static_cast<std::uint16_t>((sum + 32767) / 65535);
                         }
                       });
                     },
                     [&] { theirs = byEmbree(embree, places, nullptr, directions, of_faces); }});
  std::size_t other = 0;
  double off = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double ours = field.values[field.index(places[i])];
    other += plain[i] != field.values[field.index(places[i])];
    off += std::abs(theirs[i] / 65535.0 - ours) / 65535.0;
  }
  const double voxels = static_cast<double>(field.values.size()), n = static_cast<double>(places.size());
  report.add({kRow, "every voxel, grey", seconds[0], "s", hashOf(field.values)});
  report.add({kRow, "  rays", voxels * static_cast<double>(directions.size()) / seconds[0] / 1e6, "Mray/s"});
  report.note(fmt::format("  {} of {} places differ from plain rays; Embree's by {:.5f} in the mean", other,
                          places.size(), off / n));
  report.add({kRow, "plain rays' time for as many voxels over it", seconds[1] / n * voxels / seconds[0],
              "times", 0, Target{200.0}});
  report.add({kRow, "Embree's (closest hits, 16 of one direction) over it",
              seconds[2] / n * voxels / seconds[0], "times", 0, Target{30.0}});
}

}  // namespace

void benchBounced(Report& report) {
  const scenes::Site site = courtyard();
  const sim::Voxel size = site.world.frame().size;
  report.title(
      fmt::format("11. Light that bounces: courtyard, {} x {} x {} voxels, {} directions over the sphere",
                  size.x, size.y, size.z, 2 * kDirections));
  const sim::Lighting light = sim::lightOf(site.world, site.sky, site.sun);
  const ClosestHits embree(site.world.opaque());
  benchSurfacesLit(site.world, light, embree, report);
  benchEveryVoxelLit(site.world, embree, report);
  benchDoubling(report);
}

}  // namespace espalier::bench
