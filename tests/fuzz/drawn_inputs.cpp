#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "render/image/image_io.h"
#include "render/model/drawn_leaf.h"
#include "tests/fuzz/random_files.h"

/// The world of drawn scenes, and what they read beside their rules: meshes, points, volumes and skeletons.
namespace espalier::fuzz {

RandomFiles::World RandomFiles::drawWorld(tests::Numbers& numbers) {
  constexpr std::array kSides{1, 2, 3, 5, 8, 9, 15, 16, 17, 24, 31, 33, 63, 64, 65, 100};
  constexpr std::array kVoxels{0.04, 0.04, 0.04, 0.01, 1.0, 2e-5, 1e-3, 100.0};
  constexpr int kMostVoxels = 30'000;
  World world;
  do {
    for (int axis = 0; axis < 3; ++axis) world.size[axis] = numbers.pick(kSides);
  } while (world.size.x * world.size.y * world.size.z > kMostVoxels);
  if (numbers.chance(0.4)) world.size = sim::Voxel(numbers.whole(4, 24));
  world.voxel_m = numbers.pick(kVoxels);
  if (numbers.chance(0.02)) {
    world.voxel_m = 1e6;
    world.size = glm::min(world.size, sim::Voxel(2));
  } else if (numbers.chance(0.3)) {
    for (int axis = 0; axis < 3; ++axis) world.middle_m[axis] = numbers.uniform(-20.0, 20.0) * world.voxel_m;
  }
  const bool flat = std::min({world.size.x, world.size.y, world.size.z}) < 6;  // a mesh leaves no room there
  world.meshes = numbers.chance(flat ? 0.1 : 0.7);
  world.bounds = !world.meshes || numbers.chance(0.5);
  if (!world.bounds)
    world.size = sim::Voxel(std::min(30, std::max({world.size.x, world.size.y, world.size.z})));
  return world;
}

/// What meshes are made of, between -0.5 and 0.5: a floor, a wall, a sloping quad and a box.
constexpr double kFloor = -0.45, kWall = 0.02;
const sim::Vec3 kRoofLow(-0.4, 0.1, -0.4), kRoofHigh(0.2, 0.33, -0.1), kBlockLow(0.1, -0.4, -0.4),
    kBlockHigh(0.4, -0.1, -0.1);

/// Whether something may stand there or so near.
bool RandomFiles::standsAt(const sim::Vec3& at, double near) {
  const auto in = [&](const sim::Vec3& low, const sim::Vec3& high) {
    return glm::all(glm::greaterThan(at, low - near)) && glm::all(glm::lessThan(at, high + near));
  };
  return at.y < kFloor + near || std::abs(at.z - kWall) < near || in(kRoofLow, kRoofHigh) ||
         in(kBlockLow, kBlockHigh);
}

/// A floor, and some of the others; or the box alone, which is closed. Each is a group and has a material.
std::string RandomFiles::writeMesh() {
  std::string text = "mtllib paint.mtl\n";
  int vertices = 0;
  const auto quad = [&](std::array<sim::Vec3, 4> corners) {
    for (const sim::Vec3& p : corners) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    text += fmt::format("f {} {} {} {}\n", vertices + 1, vertices + 2, vertices + 3, vertices + 4);
    vertices += 4;
  };
  const auto group = [&](const char* name, const char* material) {
    text += fmt::format("g {}\nusemtl {}\n", name, material);
  };
  const bool body = numbers_.chance(0.2);
  if (!body) {
    group("floor", "stone");
    quad({sim::Vec3(-0.5, kFloor, -0.5), {-0.5, kFloor, 0.5}, {0.5, kFloor, 0.5}, {0.5, kFloor, -0.5}});
  }
  if (!body && numbers_.chance(0.7)) {
    group("wall", "brick");
    quad({sim::Vec3(-0.5, kFloor, kWall), {0.5, kFloor, kWall}, {0.5, 0.4, kWall}, {-0.5, 0.4, kWall}});
  }
  if (!body && numbers_.chance(0.5)) {
    group("roof", "brick");
    const sim::Vec3 &a = kRoofLow, &b = kRoofHigh;
    quad({a, {a.x, a.y, b.z}, b, {b.x, b.y, a.z}});
  }
  if (body || numbers_.chance(0.4)) {
    group("block", "stone");
    const sim::Vec3 &a = kBlockLow, &b = kBlockHigh;
    quad({sim::Vec3(a.x, a.y, a.z), {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z}});
    quad({sim::Vec3(a.x, b.y, a.z), {a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}});
    quad({sim::Vec3(a.x, a.y, a.z), {a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, a.y, a.z}});
    quad({sim::Vec3(a.x, a.y, b.z), {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}});
    quad({sim::Vec3(a.x, a.y, a.z), {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z}});
    quad({sim::Vec3(b.x, a.y, a.z), {b.x, b.y, a.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z}});
  }
  std::ofstream(folder_ / "paint.mtl") << "newmtl stone\nKd 0.5 0.5 0.5\nnewmtl brick\nKd 0.6 0.2 0.1\n";
  const std::string name = fmt::format("{}_{}.obj", body ? "body" : "mesh", numbers_.whole(1, 9));
  std::ofstream(folder_ / name) << text;
  return name;
}

/// All around, brighter to one side.
std::string RandomFiles::writeSky() {
  render::Image sky(16, 8, 3, 0.3f);
  for (int x = 0; x < 5; ++x) std::fill_n(sky.at(x, 1), 3, 0.9f);
  std::ofstream(folder_ / "sky.png", std::ios::binary) << render::encodePng(sky);
  return "sky.png";
}

/// A leaf for elements.
std::string RandomFiles::writePicture() {
  const std::string name = fmt::format("leaf_{}.png", numbers_.whole(1, 3));
  std::ofstream(folder_ / name, std::ios::binary)
      << render::drawnLeaf(numbers_.pick(render::drawnKinds()), sim::Colour(0.4f, 0.3f, 0.1f))->png;
  return name;
}

/// Each with a type, and at least one of every type that is asked for.
std::string RandomFiles::writePoints(const std::string& name, int most, double beyond) {
  std::ofstream file(folder_ / name);
  file << "x,y,z,type\n";
  for (int i = 2 + numbers_.whole(1, most); i > 0; --i) {
    sim::Vec3 at = world_.middle_m;
    for (int axis = 0; axis < 3; ++axis)
      at[axis] += numbers_.uniform(-beyond, beyond) * world_.extent_m()[axis];
    file << fmt::format("{},{},{},{}\n", at.x, at.y, at.z, i % 3);
  }
  return name;
}

/// Vectors in a few voxels about the middle.
std::string RandomFiles::writeVolume() {
  openvdb::initialize();
  auto grid = openvdb::Vec3SGrid::create();
  grid->setName("up");
  grid->setTransform(openvdb::math::Transform::createLinearTransform(std::max(world_.voxel_m, 1e-4)));
  grid->transform().postTranslate({world_.middle_m.x, world_.middle_m.y, world_.middle_m.z});
  const int far = numbers_.whole(1, 9);
  for (int i = numbers_.whole(1, 300); i > 0; --i) {
    const auto part = [&] { return static_cast<float>(numbers_.uniform(-2.0, 2.0)); };
    const auto place = [&] { return numbers_.whole(-far, far); };
    grid->tree().setValueOn({place(), place(), place()}, {part(), part(), part()});
  }
  openvdb::io::File file((folder_ / "winds.vdb").string());
  file.write({grid});
  file.close();
  return "winds.vdb";
}

/// A tree about the middle, as lines or as nodes.
std::string RandomFiles::writeSkeleton() {
  const bool lines = numbers_.chance(0.5), thick = numbers_.chance(0.5);
  std::string text = lines ? "" : "[";
  const int nodes = numbers_.whole(2, 60);
  for (int n = 0; n < nodes; ++n) {
    sim::Vec3 at = world_.middle_m;
    for (int axis = 0; axis < 3; ++axis) at[axis] += numbers_.uniform(-0.3, 0.3) * world_.extent_m()[axis];
    const int parent = n == 0 ? -1 : numbers_.whole(0, n - 1);
    if (lines) {
      text += fmt::format("v {} {} {}\n", at.x, at.y, at.z);
      if (n > 0) text += fmt::format("l {} {}\n", parent + 1, n + 1);
    } else {
      text += fmt::format(R"({}{{"parent": {}, "position": [{}, {}, {}]{}}})", n == 0 ? "" : ",\n", parent,
                          at.x, at.y, at.z,
                          thick ? fmt::format(R"(, "radius": {})", 0.3 * world_.voxel_m / (1 + n)) : "");
    }
  }
  const std::string name = lines ? "sticks.obj" : "nodes.json";
  std::ofstream(folder_ / name) << text << (lines ? "" : "]");
  return name;
}

/// A scene about the middle that makes a mesh, a skeleton and a picture for others.
std::string RandomFiles::writeMaker() {
  const double voxel = std::clamp(world_.longest_m() / 12.0, 2e-5, 4e4);
  const sim::Vec3 half(6.0 * voxel);
  const auto corner = [](const sim::Vec3& at) { return ValueDrawer::point(at.x, at.y, at.z); };
  std::ofstream(folder_ / "maker.yaml") << fmt::format(
      "espalier: scene\nworld: {{voxel: {}, bounds: {{min: {}, max: {}}}}}\niterations: {}\n"
      "plants: [{{rules: {{random_tree: {{length: 1.5, trials: {{min: 2, max: 9}}}}}}, seeds: [{}]}}]\n"
      "image: {{width: 16, height: 16}}\ncameras: {{main: {{eye: {}, target: {}}}}}\nimages: [{{kind: graph, "
      "name: view}}]\n",
      voxel, corner(world_.middle_m - half), corner(world_.middle_m + half), numbers_.whole(1, 4),
      corner(world_.middle_m), corner(world_.middle_m + 2.0 * half), corner(world_.middle_m));
  return "maker.yaml";
}

}  // namespace espalier::fuzz
