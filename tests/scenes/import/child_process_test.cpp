#include "scenes/import/child_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "scenes/import/mesh_wire.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

ChildLimits quick() {
  ChildLimits limits;
  limits.wall = std::chrono::milliseconds(20000);
  return limits;
}

TEST(ChildProcess, HandsBackWhatTheWorkReturned) {
  const std::string large(5'000'000, 'x');  // many times what a pipe holds
  const auto result = runInChild([&] { return large + '\0' + "end"; }, quick());
  EXPECT_EQ(result.end, ChildEnd::finished);
  EXPECT_EQ(result.bytes, large + '\0' + "end");
}

TEST(ChildProcess, ExceptionsComeAcrossAsText) {
  const auto result = runInChild([]() -> std::string { throw std::runtime_error("no good"); }, quick());
  EXPECT_EQ(result.end, ChildEnd::threw);
  EXPECT_EQ(result.bytes, "no good");
}

TEST(ChildProcess, CrashesAreResults) {
  EXPECT_EQ(runInChild([]() -> std::string { std::abort(); }, quick()).end, ChildEnd::crashed);
  EXPECT_EQ(runInChild([]() -> std::string { ::_exit(3); }, quick()).end, ChildEnd::crashed);
  EXPECT_EQ(runInChild(
                []() -> std::string {
                  std::raise(SIGKILL);
                  return {};
                },
                quick())
                .end,
            ChildEnd::crashed);
}

TEST(ChildProcess, HangsEndAtTheWallClockAndAtTheProcessorLimit) {
  auto limits = quick();
  limits.wall = std::chrono::milliseconds(100);
  const auto sleep = []() -> std::string {
    for (;;) ::pause();
  };
  EXPECT_EQ(runInChild(sleep, limits).end, ChildEnd::out_of_time);
  limits = quick();
  limits.cpu = std::chrono::seconds(1);
  std::atomic<bool> forever = true;
  const auto spin = [&] {
    while (forever) {
    }
    return std::string();
  };
  EXPECT_EQ(runInChild(spin, limits).end, ChildEnd::out_of_time);
}

TEST(ChildProcess, MemoryIsLimited) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need the address space";
#endif
  auto limits = quick();
  limits.memory_bytes = std::size_t{64} << 20;
  const auto eat = [] {
    std::vector<std::string> eaten;
    for (;;) eaten.emplace_back(1 << 20, 'x');
    return std::string();
  };
  EXPECT_EQ(runInChild(eat, limits).end, ChildEnd::out_of_memory);
  limits.result_bytes = 1000;
  EXPECT_EQ(runInChild([] { return std::string(2000, 'x'); }, limits).end, ChildEnd::out_of_memory);
}

TEST(ChildProcess, CtrlCInTheChildStopsTheJob) {
  EXPECT_THROW(runInChild(
                   []() -> std::string {
                     std::raise(SIGINT);
                     return {};
                   },
                   quick()),
               sim::Stopped);
}

sim::Mesh triangle() {
  sim::Mesh mesh;
  mesh.name = "one";
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.region = {0};
  mesh.material = {0};
  mesh.regions = {"wall"};
  mesh.materials = {{"red", {1, 0, 0}}};
  mesh.degenerate_dropped = 7;
  return mesh;
}

MeshSources sourcesOfTriangle() {
  return {{{"one.obj", "mesh", 7}}, {{"", 1, 8, "the MTL file 'x.mtl' is not there"}}};
}

TEST(MeshWire, ComesBackEqual) {
  MeshSources sources;
  const auto mesh = unpackMesh(packMesh(triangle(), sourcesOfTriangle()), sources);
  EXPECT_EQ(sources.files, sourcesOfTriangle().files);
  EXPECT_EQ(sources.warnings, sourcesOfTriangle().warnings);
  EXPECT_EQ(mesh.name, "one");
  EXPECT_EQ(mesh.vertices_m, triangle().vertices_m);
  EXPECT_EQ(mesh.triangles, triangle().triangles);
  EXPECT_EQ(mesh.regions, triangle().regions);
  EXPECT_EQ(mesh.materials.at(0).name, "red");
  EXPECT_EQ(mesh.materials[0].colour, sim::Colour(1, 0, 0));
  EXPECT_EQ(mesh.degenerate_dropped, 7u);
  EXPECT_EQ(packMesh(mesh), packMesh(triangle()));
}

TEST(MeshWire, CutAndDamagedBytesAreRefused) {
  const auto bytes = packMesh(triangle(), sourcesOfTriangle());
  MeshSources sources;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(unpackMesh(std::string_view(bytes).substr(0, size), sources), std::runtime_error) << size;
  }
  EXPECT_THROW(unpackMesh(bytes + "x", sources), std::runtime_error);
  auto wrong_region = triangle();
  wrong_region.region = {1};
  EXPECT_THROW(unpackMesh(packMesh(wrong_region), sources), std::runtime_error);
  auto missing_region = triangle();
  missing_region.region.clear();
  EXPECT_THROW(unpackMesh(packMesh(missing_region), sources), std::runtime_error);
  for (std::size_t at = 0; at < bytes.size(); ++at) {  // no count, however large, is believed
    auto flipped = bytes;
    flipped[at] = '\xff';
    try {
      unpackMesh(flipped, sources);
    } catch (const std::runtime_error&) {
    }
  }
}

}  // namespace
}  // namespace espalier::scenes
