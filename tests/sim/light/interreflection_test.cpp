#include "sim/light/interreflection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/light/met.h"
#include "sim/tile/build_world.h"
#include "tests/support/levels.h"
#include "tests/support/meshes.h"
#include "tests/support/worlds.h"

namespace espalier::sim {
namespace {

/// A world with its light, and what is what in it.
struct Lit {
  explicit Lit(World built) : world(std::move(built)), light(lightOf(world, makeSky({.directions = 32}))) {
    const std::size_t count = light.surfaces.size() + light.faces.size();
    sources.sky = Colour(0.0f);
    sources.sun.assign(count, Colour(0.0f));
    sources.albedo.assign(count, Colour(0.0f));
    sources.emitted.assign(count, Colour(0.0f));
  }

  std::size_t count() const { return sources.sun.size(); }
  Voxel voxelOf(std::size_t i) const {
    return i < light.surfaces.size() ? light.surfaces[i].voxel
                                     : light.voxelOf(light.faces[i - light.surfaces.size()]);
  }
  const std::string& object(std::size_t i) const { return world.part(world.partAt(voxelOf(i))).object; }
  void everywhere(std::vector<Colour>& of, float value) const { of.assign(count(), Colour(value)); }
  void on(const std::string& name, std::vector<Colour>& of, float value) const {
    for (std::size_t i = 0; i < count(); ++i) {
      if (object(i) == name) of[i] = Colour(value);
    }
  }
  Bounced bounced(const BounceSettings& settings) const {
    return Interreflection(world, light, settings).of(sources);
  }
  /// Over the surfaces of an object, by their area.
  double mean(const std::string& name, const std::function<double(std::size_t)>& value) const {
    double sum = 0.0, area = 0.0;
    for (std::size_t i = 0; i < light.surfaces.size(); ++i) {
      if (object(i) != name) continue;
      sum += light.surfaces[i].surface.coverage * value(i);
      area += light.surfaces[i].surface.coverage;
    }
    EXPECT_GT(area, 0.0);
    return sum / area;
  }

  World world;
  Lighting light;
  BounceSources sources;
};

/// A flat sheet with its corners in order.
Mesh sheet(std::string name, const std::vector<Vec3>& corners) {
  Mesh mesh = tests::emptyMesh(std::move(name));
  mesh.vertices_m = corners;
  for (std::uint32_t i = 2; i < corners.size(); ++i) tests::addTriangle(mesh, 0, i - 1, i);
  return mesh;
}

Mesh disc(std::string name, Vec3 centre, double radius, bool up) {
  std::vector<Vec3> corners;
  constexpr int kAround = 96;
  for (int i = 0; i < kAround; ++i) {
    const double turn = 2 * std::numbers::pi * i / kAround * (up ? -1 : 1);
    corners.push_back(centre + radius * Vec3(std::cos(turn), 0.0, std::sin(turn)));
  }
  return sheet(std::move(name), corners);
}

Lit lit(Voxel size, std::vector<Mesh> meshes) {
  std::vector<TiledMesh> tiled;
  for (Mesh& mesh : meshes) tiled.push_back({std::move(mesh), false});
  return Lit(buildWorld(tests::unitFrame(size), tiled, 0));
}

/// A room of so many voxels, with walls of two.
Lit room(int across, Vec3 low = Vec3(2.0)) {
  const Vec3 high = low + Vec3(across);
  const Vec3 a = low - 2.0, b = high + 2.0;
  std::vector<TiledMesh> walls;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      Vec3 from = a, to = b;
      (upper ? from : to)[axis] = upper ? high[axis] : low[axis];
      walls.push_back({tests::boxMesh(from, to, axis == 1 ? (upper ? "ceiling" : "floor") : "walls"), true});
    }
  }
  return Lit(buildWorld({Vec3(0.5), 1.0, Voxel(across + 4)}, walls, 0));
}

/// What looks into the room.
bool inside(const Lit& lit, std::size_t i) {
  const Voxel v = lit.voxelOf(i), last = lit.world.frame().size - 1;
  return v.x > 0 && v.y > 0 && v.z > 0 && v.x < last.x && v.y < last.y && v.z < last.z;
}

TEST(Interreflection, InAWhiteRoomThatShinesItIsTheGeometricSeries) {
  Lit box = room(32);
  for (const float albedo : {0.2f, 0.5f, 0.8f}) {
    box.everywhere(box.sources.albedo, albedo);
    box.everywhere(box.sources.emitted, 1.0f);
    const Bounced bounced = box.bounced({.directions = 64, .passes = 200, .tolerance = 1e-6});
    std::size_t checked = 0;
    for (std::size_t i = 0; i < box.light.surfaces.size(); ++i) {
      if (!inside(box, i)) continue;
      ASSERT_NEAR(radiosity(box.sources, bounced, i).g * (1.0f - albedo), 1.0f, 1e-4f);
      ++checked;
    }
    EXPECT_GE(checked, 6u * 32 * 32 - 12 * 32);
  }
}

TEST(Interreflection, InAClosedRoomAllThatTheCeilingSendsIsTakenUp) {
  Lit box = room(32);
  constexpr double kAlbedo = 0.6;
  box.everywhere(box.sources.albedo, static_cast<float>(kAlbedo));
  box.on("ceiling", box.sources.albedo, 0.0f);
  box.on("ceiling", box.sources.emitted, 1.0f);
  const auto meanOf = [&](const std::string& name, int passes) {
    const Bounced bounced = box.bounced({.directions = 256, .passes = passes, .tolerance = 1e-5});
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < box.light.surfaces.size(); ++i) {
      if (box.object(i) != name || !inside(box, i)) continue;
      sum += bounced.light[i].g;
      ++count;
    }
    return sum / count;
  };
  // View factors of a cube's faces: 0.199825 to the opposite one.
  EXPECT_NEAR(meanOf("floor", 2), 0.199825, 0.01);
  EXPECT_NEAR(meanOf("walls", 2), (1.0 - 0.199825) / 4.0, 0.01);
  const double absorbed = (1.0 - kAlbedo) * (meanOf("floor", 100) + 4.0 * meanOf("walls", 100));
  EXPECT_NEAR(absorbed + meanOf("ceiling", 100), 1.0, 0.02);
}

/// The mean light on one sheet of another that shines.
double viewFactor(Lit lit, int directions) {
  lit.on("lamp", lit.sources.emitted, 1.0f);
  const Bounced bounced = lit.bounced({.directions = directions, .passes = 2, .tolerance = 0.0});
  return lit.mean("patch", [&](std::size_t i) { return double{bounced.light[i].g}; });
}

// ../shared/accuracy.md has the closed forms; n voxels are one unit.
Lit rectangles(double n) {
  const double x = 4.5, z = 4.5, y = 4.5, w = n, l = 2 * n, d = 0.5 * n;
  return lit(Voxel(Vec3(w + 10, d + 10, l + 10)),
             {sheet("lamp", {{x, y + d, z}, {x + w, y + d, z}, {x + w, y + d, z + l}, {x, y + d, z + l}}),
              sheet("patch", {{x, y, z}, {x, y, z + l}, {x + w, y, z + l}, {x + w, y, z}})});
}
Lit discs(double n, double lamp, double patch, double apart) {
  const double most = n * std::max(lamp, patch);
  const Vec3 centre(most + 4.5, 4.5, most + 4.5);
  return lit(Voxel(Vec3(2 * most + 10, n * apart + 10, 2 * most + 10)),
             {disc("patch", centre, n * patch, true),
              disc("lamp", centre + Vec3(0, n * apart, 0), n * lamp, false)});
}
Lit corner(double n) {
  const double x = 4.5, y = 4.5, z = 4.5;
  return lit(Voxel(static_cast<int>(n) + 10),
             {sheet("patch", {{x, y, z}, {x, y, z + n}, {x + n, y, z + n}, {x + n, y, z}}),
              sheet("lamp", {{x, y, z}, {x, y + n, z}, {x, y + n, z + n}, {x, y, z + n}})});
}

TEST(Interreflection, BetweenPatchesItIsTheirViewFactor) {
  for (const int n : {32, 48}) {
    EXPECT_NEAR(viewFactor(rectangles(n), 256), 0.508989, 0.01) << n;
    EXPECT_NEAR(viewFactor(discs(n, 0.5, 1.0, 0.75), 256), 0.150413, 0.01) << n;
    EXPECT_NEAR(viewFactor(discs(n, 0.5, 0.2, 0.5), 256), 0.480032, 0.01) << n;
    EXPECT_NEAR(viewFactor(corner(n), 256), 0.200044, 0.01) << n;
  }
}

/// A court with a red wall, in daylight; about so many times 36 voxels wide.
Lit court(double n = 1.0) {
  const auto scaled = [&](std::vector<Vec3> corners) {
    for (Vec3& corner : corners) corner *= n;
    return corners;
  };
  const auto box = [&](Vec3 low, Vec3 high, std::string name) {
    return tests::boxMesh(n * low, n * high, std::move(name));
  };
  Lit court = lit(Voxel(n * Vec3(40, 24, 36)),
                  {sheet("ground", scaled({{0, 1, 0}, {0, 1, 36}, {40, 1, 36}, {40, 1, 0}})),
                   box({6.4, 0, 4}, {9.6, 17, 30}, "red"), box({28, 0, 6}, {31, 13, 30}, "white"),
                   tests::sphereMesh(n * Vec3(18, 9, 18), n * 5.2, 12, "ball"),
                   sheet("roof", scaled({{10, 15, 8}, {10, 15, 20}, {20, 19, 20}, {20, 19, 8}}))});
  court.sources.sky = Colour(0.5f, 0.6f, 0.8f);
  court.everywhere(court.sources.albedo, 0.7f);
  for (std::size_t i = 0; i < court.count(); ++i) {
    if (court.object(i) == "red") court.sources.albedo[i] = Colour(0.8f, 0.1f, 0.1f);
    if (court.object(i) == "ground" && court.voxelOf(i).x > 20 * n)
      court.sources.sun[i] = Colour(1.4f, 1.2f, 0.9f);
  }
  return court;
}

bool same(const Bounced& a, const Bounced& b) {
  return a.light == b.light && a.sky == b.sky && a.below == b.below && a.covered == b.covered &&
         a.passes == b.passes && a.change == b.change;
}

TEST(Interreflection, IsTheSameOnAnyThreadsAtAnyLevelAndWithAnyMemory) {
  const Lit lit = court();
  BounceSettings settings{.directions = 64, .passes = 4, .tolerance = 0.0};
  const Bounced bounced = lit.bounced(settings);
  EXPECT_EQ(bounced.passes, 4);
  for (const int threads : {1, 2, 5})
    onThreads(threads, [&] { EXPECT_TRUE(same(lit.bounced(settings), bounced)); });
  tests::onEveryLevel([&] { EXPECT_TRUE(same(lit.bounced(settings), bounced)); });
  settings.most_bytes = 13 * sizeof(std::uint32_t) * lit.count();
  EXPECT_TRUE(same(lit.bounced(settings), bounced));
  settings.most_bytes = 0;
  EXPECT_TRUE(same(lit.bounced(settings), bounced));
}

TEST(Interreflection, MeetsWhatItsRaysMeet) {
  const Lit lit = court();
  const SurfaceSensors sensors = sensorsOf(lit.world, lit.light);
  const std::vector<Voxel> from = viewpoints(sensors);
  DirectionSet directions = makeSky({.directions = 20}).directions;
  for (std::size_t i = 0; i < 20; ++i)
    directions.push_back({-directions[i].v, crossedVoxels(-directions[i].v), 1});
  const Met met = meet(receiversMet(lit.world, lit.light), sensors, from, directions, 0, directions.size());
  std::size_t hits = 0, surfaces = 0, backs = 0;
  for (std::size_t i = 0; i < lit.light.surfaces.size(); i += 5) {
    for (std::size_t d = 0; d < directions.size(); ++d) {
      // The plain way: voxel by voxel.
      const BitVolume& opaque = lit.world.opaque();
      Voxel before = from[i], end(-1);
      for (Voxel start = from[i]; end == Voxel(-1); start += directions[d].v) {
        for (const Voxel o : directions[d].crossed) {
          end = start + o;
          if (!contains(opaque.size(), end) || opaque.at(end)) break;
          before = end;
          end = Voxel(-1);
        }
      }
      const std::uint32_t number = met.by(i)[d];
      if (!contains(opaque.size(), end)) {
        ASSERT_EQ(number, lit.count());
        continue;
      }
      ++hits;
      if (number == lit.count()) {  // nothing there looks this way
        ++backs;
        continue;
      }
      const Voxel off = glm::abs(lit.voxelOf(number) - end);
      ASSERT_LE(std::max({off.x, off.y, off.z}), 1);
      if (number < lit.light.surfaces.size()) {
        ++surfaces;
        const Vec3f normal = lit.light.surfaces[number].surface.normal;
        ASSERT_LT(glm::dot(Vec3(normal), Vec3(directions[d].v)), 0.0);
      } else {
        ASSERT_EQ(lit.voxelOf(number), end);
        const auto face = lit.light.faces[number - lit.light.surfaces.size()] % kFaces;
        ASSERT_LT(glm::dot(Vec3(kFaceNormals[face]), Vec3(directions[d].v)), 0.0);
      }
    }
  }
  EXPECT_LT(backs, hits / 20);
  EXPECT_GT(hits, 3000u);
  EXPECT_GT(surfaces, 2000u);
}

TEST(Interreflection, NoPassMakesLight) {
  const Lit lit = court();
  std::vector<double> added;
  Bounced before = lit.bounced({.directions = 64, .passes = 1});
  for (int passes = 2; passes < 8; ++passes) {
    const Bounced now = lit.bounced({.directions = 64, .passes = passes, .tolerance = 0.0});
    double sum = 0.0;
    float most_sent = 0.0f, most_brought = 0.0f;
    for (std::size_t i = 0; i < lit.count(); ++i) {
      most_sent = std::max(most_sent, radiosity(lit.sources, now, i).r);
      most_brought = std::max(most_brought, now.light[i].r);
      sum += (now.light[i] - before.light[i]).r;
      ASSERT_LE(now.sky[i] + now.below[i] + now.covered[i], 1.0f + 1e-5f);
    }
    EXPECT_LE(most_brought, most_sent);
    added.push_back(sum);
    before = now;
  }
  EXPECT_GT(added.front(), 100.0);
  for (std::size_t i = 1; i < added.size(); ++i) EXPECT_LT(added[i], 0.75 * added[i - 1]);
}

TEST(Interreflection, ARedWallReddensWhatLiesAtItsFoot) {
  const Lit lit = court();
  const Bounced bounced = lit.bounced({});
  const auto redness = [&](Voxel v) {
    const Colour c = bounced.light[lit.light.where->number(v)];
    return c.r / c.b;
  };
  EXPECT_GT(redness({11, 1, 17}), 1.3f * redness({26, 1, 17}));
}

TEST(Interreflection, EndsByItsTolerance) {
  const Lit lit = court();
  const Bounced bounced = lit.bounced({.directions = 32, .passes = 100, .tolerance = 0.01});
  EXPECT_GT(bounced.passes, 2);
  EXPECT_LT(bounced.passes, 30);
  EXPECT_LE(bounced.change, 0.01);
  EXPECT_EQ(lit.bounced({.directions = 32, .passes = 1}).light,
            std::vector<Colour>(lit.count(), Colour(0.0f)));
}

TEST(Interreflection, OnAPlainWallNeighboursDifferByLittle) {
  Lit lit = court(2.5);
  struct Case {
    bool lambert, sun;
  };
  for (const Case of : {Case{true, true}, {false, true}, {true, false}}) {
    if (!of.sun) lit.sources.sun.assign(lit.count(), Colour(0.0f));
    const Bounced bounced = lit.bounced({.directions = 512, .passes = 4, .lambert = of.lambert});
    const auto sent = [&](Voxel v) { return radiosity(lit.sources, bounced, lit.light.where->number(v)); };
    float most = 0.0f, off_line = 0.0f;  // before a sunny floor light rises steeply, but evenly
    for (const TiledVoxel& t : lit.light.surfaces) {
      if (lit.world.part(t.surface.part).object != "white" || t.surface.normal.x > -0.999f) continue;
      if (t.voxel.y < 6 || t.voxel.y > 28 || t.voxel.z < 18 || t.voxel.z > 70) continue;
      for (const Voxel step : {Voxel(0, 1, 0), Voxel(0, 0, 1)}) {
        const Colour up = sent(t.voxel + step) - sent(t.voxel), down = sent(t.voxel) - sent(t.voxel - step);
        const Colour change = glm::abs(up), bend = glm::abs(up - down);
        most = std::max({most, change.r, change.g, change.b});
        off_line = std::max({off_line, bend.r, bend.g, bend.b});
      }
    }
    EXPECT_GT(most, 0.0f);
    EXPECT_LT(off_line, 0.01f) << of.lambert;
    if (!of.sun) {
      EXPECT_LT(most, 0.01f);
    }
  }
}

TEST(Interreflection, RefusesWhatMakesNoSense) {
  Lit lit = court();
  EXPECT_THROW(lit.bounced({.directions = 0}), InputError);
  EXPECT_THROW(lit.bounced({.passes = 0}), InputError);
  EXPECT_THROW(lit.bounced({.tolerance = -1.0}), InputError);
  lit.sources.albedo[3].g = 1.5f;
  EXPECT_THROW(lit.bounced({}), InputError);
  lit.sources.albedo[3].g = 0.5f;
  lit.sources.emitted[3].g = -0.5f;
  EXPECT_THROW(lit.bounced({}), InputError);
}

}  // namespace
}  // namespace espalier::sim
