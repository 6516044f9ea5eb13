#include "render/model/stem_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/model/box_pairs.h"
#include "render/model/limb_grid.h"
#include "render/model/meeting_limbs.h"
#include "render/model/plant_model.h"
#include "render/model/radii.h"
#include "sim/base/parallel.h"
#include "tests/support/random_trees.h"
#include "tests/support/self_crossings.h"
#include "tests/support/small_vine.h"
#include "tests/support/sound_surface.h"

namespace espalier {
namespace {

using render::ModelMesh;
using sim::Vec3;
using sim::Vec3f;

const sim::Frame kFrame{sim::Vec3(1.0, -2.0, 0.5), 0.04, sim::Voxel(200)};

sim::Plant plantOf(sim::Skeleton skeleton) {
  sim::Plant plant;
  plant.name = "tree";
  plant.skeleton = std::move(skeleton);
  return plant;
}

ModelMesh stemsOf(const sim::Skeleton& skeleton, double error = 0.4) {
  render::ModelOptions options;
  options.error = error;
  return render::modelPlant(plantOf(skeleton), kFrame, options).stems;
}

void expectOneSphere(const ModelMesh& mesh, std::size_t spheres = 1) {
  const tests::Topology topology = tests::topologyOf(mesh);
  EXPECT_EQ(topology.components, spheres);
  EXPECT_EQ(topology.euler(), 2 * static_cast<long>(spheres));
  EXPECT_EQ(topology.bad_edges, 0u);
  EXPECT_EQ(topology.bad_points, 0u);
  EXPECT_EQ(topology.flat, 0u);
  EXPECT_GT(tests::volumeOf(mesh), 0.0);
  for (std::size_t v = 0; v < mesh.positions_m.size(); ++v) {
    ASSERT_TRUE(std::isfinite(glm::dot(mesh.positions_m[v], mesh.positions_m[v])));
    ASSERT_NEAR(glm::length(mesh.normals[v]), 1.0f, 1e-4f);
    ASSERT_TRUE(std::isfinite(mesh.uvs[v].x + mesh.uvs[v].y));
  }
}

/// The limbs of which such a surface is made, in voxel widths.
std::vector<render::Limb> limbsIn(const sim::Skeleton& skeleton) {
  const sim::StemGirth girth;
  const auto radii = render::stemRadii(skeleton, girth);
  const std::vector<float> ones(radii.size(), 1.0f);
  return render::limbsOf(render::stemCurves(skeleton, radii), {skeleton, radii, ones, ones},
                         {sim::Vec3(0.0), 1.0, sim::Voxel(1)}, 0.4 * girth.twig_vx);
}

/// Whether a limb comes back to where it was.
bool meetsItself(const render::Limb& limb) {
  for (std::size_t i = 0; i < limb.line.size(); ++i) {
    for (std::size_t k = i + 1; k < limb.line.size(); ++k) {
      const double thick = limb.line[i].radius_m + limb.line[k].radius_m;
      if (limb.arcs_m[k] - limb.arcs_m[i] > 4.0 * thick &&
          glm::distance(limb.line[i].centre_m, limb.line[k].centre_m) < 1.5 * thick)
        return true;
    }
  }
  return false;
}

/// Whether a limb, beyond its first ring, is always farther from its host than both are thick, and its foot
/// from those of others.
bool keepsItsDistance(const std::vector<render::Limb>& limbs, std::size_t l) {
  if (limbs[l].host < 0) return true;
  const render::Limb &limb = limbs[l], &host = limbs[static_cast<std::size_t>(limb.host)];
  constexpr std::size_t kEach = 8;
  for (std::size_t i = kEach; i + 1 < kEach * limb.line.size(); ++i) {
    const render::Section at = render::sectionAt(
        limb, limb.length_m() * static_cast<double>(i) / static_cast<double>(kEach * limb.line.size()));
    for (std::size_t k = 0; k + 1 < host.line.size(); ++k) {
      const Vec3 step = host.line[k + 1].centre_m - host.line[k].centre_m;
      const double share =
          std::clamp(glm::dot(at.centre_m - host.line[k].centre_m, step) / glm::dot(step, step), 0.0, 1.0);
      const Vec3 near = host.line[k].centre_m + share * step;
      if (glm::distance(near, at.centre_m) < host.line[k].radius_m + at.radius_m) return false;
    }
  }
  for (std::size_t other = 0; other < limbs.size(); ++other) {
    if (other == l || limbs[other].host != limb.host) continue;
    const render::Foot &a = limb.foot, &b = limbs[other].foot;
    const double around = std::abs(std::remainder(a.angle - b.angle, 2.0 * M_PI));
    if (std::abs(a.arc_m - b.arc_m) < a.half_arc_m + b.half_arc_m && around < a.half_angle + b.half_angle)
      return false;
  }
  return true;
}

TEST(StemSurface, TenRandomTreesAreTenSpheres) {
  std::size_t apart = 0, forks = 0;
  for (std::uint32_t number = 0; number < 10; ++number) {
    SCOPED_TRACE(number);
    const sim::Skeleton skeleton = tests::randomTree(number);
    const std::vector<render::Limb> limbs = limbsIn(skeleton);
    const ModelMesh mesh = stemsOf(skeleton);
    expectOneSphere(mesh);
    std::set<std::uint32_t> crossing;
    for (const render::PiecePairs& one : tests::selfCrossings(mesh)) {
      EXPECT_TRUE(one.first != one.second || meetsItself(limbs[one.first]) ||
                  !keepsItsDistance(limbs, one.first))
          << one.pairs << " pairs within limb " << one.first;
      const bool fork = limbs[one.second].host == static_cast<std::int32_t>(one.first);
      EXPECT_FALSE(fork && keepsItsDistance(limbs, one.second))
          << one.pairs << " pairs where limb " << one.second << " leaves " << one.first;
      crossing.insert({one.first, one.second});
    }
    for (std::size_t l = 1; l < limbs.size(); ++l) {
      ++forks;
      apart += keepsItsDistance(limbs, l);
    }
    // Outwards: outside of each triangle the surface winds around nothing, inside once.
    for (std::size_t i = 0; i < mesh.triangles.size(); i += mesh.triangles.size() / 100) {
      const auto& t = mesh.triangles[i];
      if (crossing.contains(mesh.pieces[t[0]])) continue;
      const Vec3 a(mesh.positions_m[t[0]]), b(mesh.positions_m[t[1]]), c(mesh.positions_m[t[2]]);
      const Vec3 area = glm::cross(b - a, c - a);
      const Vec3 middle = (a + b + c) / 3.0, out = 1e-3 * std::sqrt(glm::length(area)) * glm::normalize(area);
      EXPECT_NEAR(tests::windingAt(mesh, middle + out), 0.0, 1e-3) << i;
      EXPECT_NEAR(tests::windingAt(mesh, middle - out), 1.0, 1e-3) << i;
    }
  }
  EXPECT_GT(5 * apart, 2 * forks);
}

/// A stem of five nodes, to which more may be added.
sim::Skeleton pole(double step = 2.0) {
  sim::Skeleton skeleton;
  for (int i = 0; i < 5; ++i) tests::addNode(skeleton, i - 1, {0, step * i, 0});
  return skeleton;
}

TEST(StemSurface, OneStemIsASphere) {
  expectOneSphere(stemsOf(pole()));
  sim::Skeleton two;
  tests::addNode(two, sim::kNoNode, {0, 0, 0});
  tests::addNode(two, 0, {0, 0.01, 0});
  expectOneSphere(stemsOf(two));
}

TEST(StemSurface, AnyNumberOfLimbsLeavesAtOnePlace) {
  for (const int limbs : {1, 2, 5, 40, 300}) {
    for (const sim::NodeId fork : {0, 2}) {
      SCOPED_TRACE(testing::Message() << limbs << " at " << fork);
      sim::Skeleton skeleton = pole();
      sim::Draws draws({sim::streamOf(3, "brush"), static_cast<std::uint32_t>(limbs)}, sim::Purpose::custom);
      for (int i = 0; i < limbs; ++i) {
        const Vec3 at = skeleton.position_vx[static_cast<std::size_t>(fork)];
        tests::addNode(skeleton, fork, at + 3.0 * draws.onSphere());
      }
      for (const double error : {0.1, 0.4, 4.0, 40.0}) expectOneSphere(stemsOf(skeleton, error));
    }
  }
}

TEST(StemSurface, NoSkeletonIsTooOdd) {
  sim::Skeleton back = pole();  // limbs back along their host, and on along it
  tests::addNode(back, 4, {0, 1, 0});
  tests::addNode(back, 2, {0, 0.5, 0});
  tests::addNode(back, 2, {0, 7, 0});
  expectOneSphere(stemsOf(back));

  sim::Skeleton nowhere = pole();  // segments of no length, and all but none
  for (int i = 0; i < 3; ++i) tests::addNode(nowhere, 2, {0, 4, 0});
  const auto same = tests::addNode(nowhere, 5, {0, 4, 0});
  tests::addNode(nowhere, same, {2, 5, 0});
  tests::addNode(nowhere, 3, {1e-4, 6, 0});
  tests::addNode(nowhere, 3, {0, 6 + 1e-5, 0});
  expectOneSphere(stemsOf(nowhere));

  expectOneSphere(stemsOf(pole(0.02)));  // far shorter than thick
  sim::Skeleton hairpin;
  for (int i = 0; i < 12; ++i) tests::addNode(hairpin, i - 1, {0, i % 2 ? 2.0 : 0.0, 0.01 * i});
  expectOneSphere(stemsOf(hairpin));

  sim::Skeleton inside = pole();  // twigs of twigs inside a trunk
  for (int i = 0; i < 3000; ++i) tests::addNode(inside, 4, {0.01 * i, 12, 0.5 * (i % 7)});
  sim::NodeId at = 1;
  for (int i = 0; i < 4; ++i) {
    at = tests::addNode(inside, at, {0.03 * (i + 1), 2.0 + 0.02 * i, 0.01 * i});
    tests::addNode(inside, at, {0.0, 2.1, -0.04 * (i + 1)});
  }
  tests::addNode(inside, at, {4, 4, 0});
  expectOneSphere(stemsOf(inside));
}

/// Of rings for a foot alone there is what the foot stands on, and where the limb bends there are whole ones.
TEST(StemSurface, RingsForFeetAreWholeOnlyWhereTheLimbBends) {
  for (const bool bent : {false, true}) {
    SCOPED_TRACE(bent);
    sim::Skeleton skeleton;
    const auto add = [&](sim::NodeId parent, Vec3 at) {
      skeleton.parent.push_back(parent);
      skeleton.position_vx.push_back(at);
      skeleton.born.push_back(0);
      return skeleton.size() - 1;
    };
    const sim::NodeId fork = add(add(sim::kNoNode, {0, 0, 0}), {0, 10, 0});
    add(fork, {bent ? 5.0 : 0.0, 20, 0});
    add(fork, {0, 10, 3});
    const std::vector<render::Limb> limbs = limbsIn(skeleton);
    ASSERT_EQ(limbs.size(), 2u);
    const std::vector<render::Foot> feet{limbs[1].foot};
    const render::LimbGrid grid = render::gridOf(limbs[0], feet, 0.4 * sim::StemGirth().twig_vx);
    ASSERT_EQ(grid.patches.size(), 1u);
    EXPECT_GT(grid.left_out, 0u);
    // All that is on rings between the ends besides the rim.
    const std::size_t ends = 2 * static_cast<std::size_t>(grid.sides);
    if (bent) {
      EXPECT_GT(grid.points(), ends + grid.rim.size());
    } else {
      EXPECT_EQ(grid.points(), ends + grid.rim.size());
    }
    for (std::size_t k = 0; k < grid.rim.size(); ++k)
      EXPECT_FALSE(std::binary_search(grid.absent.begin(), grid.absent.end(), grid.rim[k].corner));
  }
}

TEST(StemSurface, EachSeedHasASurfaceOfItsOwn) {
  expectOneSphere(stemsOf(tests::smallVine().skeleton), 2);
}

/// On the tubes themselves, whose triangles are nearly right-angled, u and v are to the same scale.
TEST(StemSurface, BarkIsToOneScaleAlongAndAround) {
  sim::Skeleton skeleton = pole(8.0);
  tests::addNode(skeleton, 3, {9, 30, 1});
  tests::addNode(skeleton, 3, {-5, 31, 2});
  const ModelMesh mesh = stemsOf(skeleton);
  std::vector<std::array<std::uint32_t, 3>> walls;
  float most = 0.0f;
  for (const auto& t : mesh.triangles) {
    bool wall = mesh.pieces[t[0]] == 0;  // of the trunk, below its forks and without its ends
    for (const std::uint32_t corner : t) {
      const Vec3f p = (mesh.positions_m[corner] - Vec3f(1.0f, -2.0f, 0.5f)) / 0.04f;
      wall = wall && p.y < 29.0f && std::hypot(p.x, p.z) > 0.1f;
    }
    if (!wall) continue;
    for (const std::uint32_t corner : t) most = std::max(most, mesh.uvs[corner].x);
    walls.push_back(t);
  }
  EXPECT_EQ(most, std::round(most));  // whole repeats around
  EXPECT_GT(walls.size(), 10u);
  const float around = 2.0f * static_cast<float>(M_PI) * render::stemRadii(skeleton, {})[1] * 0.04f;
  for (const auto& t : walls) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const float way = glm::distance(mesh.positions_m[a], mesh.positions_m[b]);
      const float scaled = glm::distance(mesh.uvs[a], mesh.uvs[b]);
      EXPECT_NEAR(scaled / way * around / most, 1.0f, 0.15f);
    }
  }
}

TEST(StemSurface, LimbsThatMeetAreCounted) {
  std::size_t by_lines = 0, by_triangles = 0;
  for (std::uint32_t number = 0; number < 10; ++number) {
    const sim::Skeleton skeleton = tests::randomTree(number);
    const std::vector<render::Limb> limbs = limbsIn(skeleton);
    by_lines += render::meetingLimbs(limbs);
    for (const render::PiecePairs& one : tests::selfCrossings(stemsOf(skeleton)))
      by_triangles +=
          one.first != one.second && limbs[one.second].host != static_cast<std::int32_t>(one.first);
  }
  EXPECT_GT(by_triangles, 10u);
  EXPECT_NEAR(static_cast<double>(by_lines) / static_cast<double>(by_triangles), 1.0, 0.5);
  EXPECT_EQ(render::meetingLimbs(limbsIn(pole())), 0u);
}

TEST(BoxPairs, OneLongBoxAmongManySmallOnesLiesInFewCubes) {
  std::vector<render::Box> boxes;
  for (int i = 0; i < 1000; ++i) {
    const sim::Vec3f low(0.01f * static_cast<float>(i));
    boxes.push_back({low, low + 0.001f});
  }
  boxes.push_back({sim::Vec3f(0.0f), sim::Vec3f(1e6f)});
  const auto pairs = render::Boxes(boxes).count([](auto, auto) { return true; },
                                                [](std::uint32_t box) { return box == 1000 ? 1u : 0u; });
  EXPECT_EQ(pairs, (std::vector<render::PiecePairs>{{0, 1, 1000}}));
}

TEST(StemSurface, IsTheSameOnAnyNumberOfThreads) {
  const sim::Skeleton skeleton = tests::randomTree(5, 2000);
  std::vector<ModelMesh> meshes;
  for (const int threads : {1, 2, 5}) {
    sim::onThreads(threads, [&] { meshes.push_back(stemsOf(skeleton)); });
    EXPECT_EQ(meshes.back().positions_m, meshes.front().positions_m);
    EXPECT_EQ(meshes.back().normals, meshes.front().normals);
    EXPECT_EQ(meshes.back().uvs, meshes.front().uvs);
    EXPECT_EQ(meshes.back().points, meshes.front().points);
    EXPECT_EQ(meshes.back().triangles, meshes.front().triangles);
  }
}

}  // namespace
}  // namespace espalier
