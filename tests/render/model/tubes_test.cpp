#include "render/model/tubes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace espalier {
namespace {

using render::ModelMesh;
using render::TubeStation;
using sim::Vec3;
using sim::Vec3f;

/// A coil that climbs, with a loop in it: where Frenet frames would flip.
std::vector<TubeStation> coil(int stations, double radius) {
  std::vector<TubeStation> line;
  for (int i = 0; i < stations; ++i) {
    const double a = 0.25 * i;
    line.push_back({{std::cos(a) * (1 + 0.1 * a), 0.15 * a * a * 0.1, std::sin(a) - 0.4 * std::cos(3 * a)},
                    radius,
                    0.5f,
                    0.5f});
  }
  return line;
}

using Edge = std::pair<std::array<float, 3>, std::array<float, 3>>;

std::array<float, 3> key(Vec3f p) {
  return {p.x, p.y, p.z};
}

/// Every edge is walked once each way, so that all triangles face the same way, but for the first ring's.
void expectOpenAtTheStart(const ModelMesh& mesh, int sides) {
  std::map<Edge, int> walks;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = key(mesh.positions_m[t[k]]), b = key(mesh.positions_m[t[(k + 1) % 3]]);
      EXPECT_NE(a, b);
      ++walks[{a, b}];
    }
  }
  int open = 0;
  for (const auto& [edge, count] : walks) {
    EXPECT_EQ(count, 1);
    open += walks.contains({edge.second, edge.first}) ? 0 : 1;
  }
  EXPECT_EQ(open, sides);
}

double volume(const ModelMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    sum += glm::dot(Vec3(mesh.positions_m[t[0]]),
                    glm::cross(Vec3(mesh.positions_m[t[1]]), Vec3(mesh.positions_m[t[2]]))) /
           6.0;
  }
  return sum;
}

TEST(Tubes, AreOpenWhereTheyBeginAloneAndFaceOutwards) {
  for (const int sides : {3, 5, 9}) {
    ModelMesh mesh;
    render::appendTube(mesh, coil(40, 0.05), sides, 3);
    expectOpenAtTheStart(mesh, sides);
    for (const auto& t : mesh.triangles) {
      const Vec3f a = mesh.positions_m[t[0]], b = mesh.positions_m[t[1]], c = mesh.positions_m[t[2]];
      const Vec3f flat = glm::normalize(glm::cross(b - a, c - a));
      EXPECT_GT(glm::dot(flat, mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]]), 0.0f);
    }
    EXPECT_EQ(std::set<std::uint32_t>(mesh.pieces.begin(), mesh.pieces.end()), std::set<std::uint32_t>{3});
  }
}

TEST(Tubes, AStraightOneHasTheVolumeOfAPrismAndACone) {
  ModelMesh mesh;  // about the origin, so that the opening has none
  const std::vector<TubeStation> line{{{0, 0, 0}, 0.5, 0, 0}, {{0, 1, 0}, 0.5, 0, 0}, {{0, 4, 0}, 0.5, 0, 0}};
  render::appendTube(mesh, line, 64, 0);
  const double circle = 0.5 * 64 * 0.25 * std::sin(2 * M_PI / 64);
  EXPECT_NEAR(volume(mesh), circle * 1.0 + circle * 3.0 / 3.0, 1e-4);
  EXPECT_NEAR(mesh.uvs.back().y, 4.0f, 1e-5f);
}

TEST(Tubes, FramesAreOrthonormalAndDoNotTwist) {
  const auto line = coil(80, 0.05);
  const auto frames = render::rotationMinimizingFrames(line);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto& f = frames[i];
    EXPECT_NEAR(glm::dot(f.along, f.across), 0.0, 1e-9);
    EXPECT_NEAR(glm::length(f.across), 1.0, 1e-9);
    EXPECT_NEAR(glm::distance(glm::cross(f.across, f.up), f.along), 0.0, 1e-9);
    if (i == 0) continue;
    const double turn = std::acos(std::min(1.0, glm::dot(f.along, frames[i - 1].along)));
    const double frame_turn = std::acos(std::min(1.0, glm::dot(f.across, frames[i - 1].across)));
    EXPECT_LE(frame_turn, turn + 1e-3) << i;
  }
}

TEST(Tubes, AFlatLoopBringsItsFrameBack) {  // parallel transport around a plane curve adds nothing
  std::vector<TubeStation> loop;
  for (int i = 0; i <= 64; ++i) {
    const double a = 2 * M_PI * i / 64;
    loop.push_back({{std::cos(a), 0.0, std::sin(a)}, 0.1, 0, 0});
  }
  const auto frames = render::rotationMinimizingFrames(loop);
  EXPECT_NEAR(std::abs(frames.front().across.y), 0.0, 1e-9);
  for (const auto& f : frames) EXPECT_NEAR(f.up.y, frames.front().up.y, 1e-9);
}

TEST(Tubes, OnAHelixFramesTurnBackByItsTorsion) {  // what Frenet's frame turns too much, in closed form
  const double a = 1.0, b = 0.4, speed = std::sqrt(a * a + b * b), torsion = b / (speed * speed);
  std::vector<TubeStation> line;
  std::vector<Vec3> along, normals;
  for (int i = 0; i <= 600; ++i) {
    const double t = 0.02 * i;
    line.push_back({{a * std::cos(t), a * std::sin(t), b * t}, 0.1, 0, 0});
    along.push_back(Vec3(-a * std::sin(t), a * std::cos(t), b) / speed);
    normals.emplace_back(-std::cos(t), -std::sin(t), 0.0);
  }
  const auto frames = render::rotationMinimizingFrames(line, along, normals[0]);
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double angle = -torsion * speed * 0.02 * static_cast<double>(i);
    const Vec3 wanted = std::cos(angle) * normals[i] + std::sin(angle) * glm::cross(along[i], normals[i]);
    EXPECT_LT(glm::distance(frames[i].across, wanted), 1e-6) << i;
  }
}

TEST(Tubes, ThinWhereTheyBendSharply) {
  std::vector<TubeStation> line{{{0, 0, 0}, 1, 0, 0},
                                {{0, 1, 0}, 1, 0, 0},
                                {{0.8, 0.5, 0}, 1, 0, 0},
                                {{1.6, 0, 0}, 1, 0, 0},
                                {{9, 0, 0}, 1, 0, 0}};
  std::vector<std::size_t> dropped;
  render::keepRingsApart(line, [&](std::size_t i) { dropped.push_back(i); });
  EXPECT_EQ(line.size() + dropped.size(), 5u);
  EXPECT_EQ(line.back().radius_m, 1.0);
  const auto chords = render::chordsOverThickness(line);
  const auto frames = render::rotationMinimizingFrames(line, chords, {0, 0, 1});
  // No corner of a ring lies behind its neighbour's plane: then neighbouring rings cannot cross.
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec3 step = line[i + 1].centre_m - line[i].centre_m;
    for (int s = 0; s < 16; ++s) {
      const double a = 2 * M_PI * s / 16;
      const Vec3 out = std::cos(a) * frames[i + 1].across + std::sin(a) * frames[i + 1].up;
      EXPECT_GT(glm::dot(step + line[i + 1].radius_m * out, frames[i].along), 0.0);
      EXPECT_LT(line[i + 1].radius_m - line[i].radius_m, 0.5 * glm::length(step) + 1e-12);
    }
  }
}

TEST(Tubes, AHairpinIsNotANan) {
  std::vector<TubeStation> line{{{0, 0, 0}, 1, 0, 0}, {{0, 1, 0}, 1, 0, 0}, {{0, 0, 0}, 1, 0, 0}};
  render::keepRingsApart(line);
  ModelMesh mesh;
  render::appendTube(mesh, line, 5, 0);
  for (const Vec3f p : mesh.positions_m) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
  for (const Vec3f n : mesh.normals) EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
}

TEST(Tubes, OneStationIsNothing) {
  ModelMesh mesh;
  render::appendTube(mesh, std::vector<TubeStation>{{{0, 0, 0}, 1, 0, 0}}, 5, 0);
  EXPECT_TRUE(mesh.empty());
}

}  // namespace
}  // namespace espalier
