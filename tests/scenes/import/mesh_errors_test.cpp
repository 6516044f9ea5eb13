#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <random>

#include "scenes/import/mesh_import.h"
#include "sim/base/error.h"
#include "tests/scenes/import/mesh_files.h"

namespace espalier::scenes {
namespace {

using tests::binarySquarePly;
using tests::binaryStl;
using tests::glb;
using tests::gltfBuffer;
using tests::gltfDocument;
using tests::kSquareObj;
using tests::kSquarePly;

constexpr char kTriangle[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

class MeshErrors : public tests::MeshFiles {
 protected:
  static void expectRefused(const std::filesystem::path& file, const std::string& because) {
    try {
      importMesh(file, RegionsFrom::group);
      ADD_FAILURE() << file << " was taken";
    } catch (const sim::InputError& error) {
      const std::string what = error.what();
      EXPECT_TRUE(what.starts_with(file.string() + ": ")) << what;
      EXPECT_NE(what.find(because), std::string::npos) << what;
    }
  }
};

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

TEST_F(MeshErrors, FilesThatAreNone) {
  expectRefused(folder_ / "missing.obj", "No such file");
  std::filesystem::create_directory(folder_ / "folder.obj");
  expectRefused(folder_ / "folder.obj", "is a folder");
  const auto pipe = folder_ / "pipe.ply";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expectRefused(pipe, "not a regular file");
  std::filesystem::create_symlink("/dev/zero", folder_ / "device.stl");
  expectRefused(folder_ / "device.stl", "not a regular file");
  expectRefused(write("empty.obj", ""), "empty");
  const auto huge = write("huge.obj", "v 0 0 0\n");
  std::filesystem::resize_file(huge, std::uintmax_t{300} << 20);  // a hole: takes no room
  expectRefused(huge, "300 MB");
}

TEST_F(MeshErrors, UnknownFormats) {
  expectRefused(write("house.fbx", kSquareObj), "use .obj, .gltf, .glb, .ply or .stl");
  expectRefused(write("house", kSquareObj), "use .obj, .gltf, .glb, .ply or .stl");
  expectRefused(write("old.gltf", R"({"asset": {"version": "1.0"}})"), "glTF 1.0 is not glTF 2");
  expectRefused(write("solid.ply", "solid x\nfacet normal 0 0 1\n"), "begins with the line 'ply'");
}

TEST_F(MeshErrors, WithoutTriangles) {
  expectRefused(write("lines.obj", std::string(kTriangle) + "l 1 2\n"), "no triangles");
  expectRefused(write("flat.obj", std::string(kTriangle) + "f 1 1 2\nf 2 2 3\n"),
                "all 2 triangles in the file are degenerate");
  expectRefused(write("text.obj", "nothing of a mesh is in this text, in no line\n"), "");
}

TEST_F(MeshErrors, NumbersThatAreNotFinite) {
  expectRefused(write("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"),
                "line 2: 'nan' is not a finite number");
  expectRefused(write("inf.obj", "v 0 0 0\nv 1 0 0\nv 0 1e39 0\nf 1 2 3\n"), "not a finite number");
  expectRefused(write("nan.ply", replaced(kSquarePly, "1 1 0", "1 nan 0")), "vertex 2");
  auto buffer = gltfBuffer();
  const float infinite = INFINITY;
  std::memcpy(buffer.data() + 12, &infinite, 4);
  expectRefused(write("inf.glb", glb(gltfDocument(), buffer)), "not a finite number");
  const auto mesh = importMesh(write("t.obj", std::string(kTriangle) + "f 1 2 3\n"), RegionsFrom::group);
  EXPECT_THROW(placeMesh(mesh, {.scale = 1e308, .translate_m = {1e308, 0, 0}}), sim::InputError);
}

TEST_F(MeshErrors, IndicesOutOfRange) {
  expectRefused(write("a.obj", std::string(kTriangle) + "f 1 2 4\n"), "out of range");
  expectRefused(write("b.obj", std::string(kTriangle) + "f 1 2 -4\n"), "out of range");
  expectRefused(write("c.obj", std::string(kTriangle) + "f 0 1 2\n"),
                "line 4: a face asks for vertex 0; they are counted from 1");
  expectRefused(write("a.ply", replaced(kSquarePly, "4 0 1 2 3", "4 0 1 2 4")), "vertex 4");
  expectRefused(write("b.ply", replaced(kSquarePly, "4 0 1 2 3", "4 0 1 2 -1")), "vertex 4294967295");
  auto document = gltfDocument();
  document["accessors"][1]["count"] = 6;
  document["bufferViews"][1]["byteLength"] = 12;
  document["buffers"][0]["byteLength"] = 48;
  const std::string two_triangles = gltfBuffer().substr(0, 42) + gltfBuffer(3).substr(36, 6);
  expectRefused(write("a.glb", glb(document, two_triangles)),
                "indices (accessor 1) ask for vertex 3, counted from 0, but there are 3");
}

TEST_F(MeshErrors, FilesBesideTheMeshOnly) {
  std::filesystem::create_directory(folder_ / "in");
  write("data.bin", gltfBuffer());
  std::filesystem::create_symlink(folder_ / "data.bin", folder_ / "in/link.bin");
  std::filesystem::create_directory(folder_ / "in/folder.bin");
  auto document = gltfDocument();
  for (const std::string name : {"../data.bin", "%2e%2e/data.bin", "../../../../dev/zero", "/etc/passwd",
                                 "link.bin", "folder.bin", "missing.bin"}) {
    document["buffers"][0]["uri"] = name;
    expectRefused(write("in/t.gltf", document.dump()), "buffer 0: it names the file '" + name + "'");
  }
}

TEST_F(MeshErrors, DamagedPlyIsSaidByLine) {
  expectRefused(write("a.ply", kSquarePly.substr(0, kSquarePly.find("element face"))),
                "line 8: the file ends before 'end_header'");
  expectRefused(write("b.ply", replaced(kSquarePly, "property float y", "proprety float y")),
                "line 6: 'proprety'");
  expectRefused(write("c.ply", replaced(kSquarePly, "float z", "flaot z")),
                "line 7: 'flaot' is not a known type");
  expectRefused(write("d.ply", replaced(kSquarePly, "vertex 4", "vertex four")), "line 4: 'four'");
  expectRefused(write("e.ply", replaced(kSquarePly, "format ascii 1.0\n", "")), "'format ascii 1.0'");
  expectRefused(write("f.ply", replaced(kSquarePly, "1 1 0", "1 l 0")), "line 13: 'l' is no number");
  expectRefused(write("j.ply", replaced(kSquarePly, "float z", "fl\x1b\xfft z")),
                "line 7: 'fl \xef\xbf\xbdt' is not");
  expectRefused(write("g.ply", replaced(kSquarePly, "1 1 0\n", "")), "promises 5 lines of data and 4 follow");
  expectRefused(write("h.ply", replaced(kSquarePly, "face 1", "face 1000000")), "the file is cut");
  const auto binary = binarySquarePly();
  for (std::size_t cut = 1; cut < 70; cut += 6)
    expectRefused(write("i.ply", binary.substr(0, binary.size() - cut)), "");
}

TEST_F(MeshErrors, CutBinaries) {
  const auto whole = glb(gltfDocument(), gltfBuffer());
  for (std::size_t size = 0; size < whole.size(); size += 37)
    expectRefused(write("a.glb", whole.substr(0, size)), "");
  const auto stl = binaryStl(4);
  for (const std::size_t cut : {1u, 50u, 150u})
    expectRefused(write("a.stl", stl.substr(0, stl.size() - cut)), "");
}

TEST_F(MeshErrors, SharedNodesThatMultiplyAreRefused) {
  auto document = gltfDocument();
  auto& nodes = document["nodes"];
  nodes = nlohmann::json::array({{{"mesh", 0}}});
  for (int level = 0; level < 30; ++level) nodes.push_back({{"children", {level, level}}});
  document["scenes"][0]["nodes"] = {30};  // a thousand million triangles in 2 kB
  expectRefused(write("bomb.glb", glb(document, gltfBuffer())), "shared too often");
}

TEST_F(MeshErrors, MutationsNeitherCrashNorHang) {
  struct Seed {
    const char* ending;
    std::string bytes;
  };
  const std::vector<Seed> seeds{{"ply", kSquarePly},
                                {"ply", binarySquarePly()},
                                {"obj", replaced(kSquareObj, "mtllib paint.mtl\n", "")},
                                {"glb", glb(gltfDocument(), gltfBuffer())}};
  ChildLimits limits;
  limits.cpu = std::chrono::seconds(1);
  limits.wall = std::chrono::milliseconds(2000);
  std::mt19937 random(1989);
  int taken = 0;
  int refused = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const Seed& seed = seeds[static_cast<std::size_t>(trial) % seeds.size()];
    std::string bytes = seed.bytes;
    for (auto edits = 1 + random() % 3; edits > 0; --edits) {
      const std::size_t at = random() % bytes.size();
      switch (random() % 4) {
        case 0:
          bytes[at] = static_cast<char>(random());
          break;
        case 1:
          bytes.erase(at, 1 + random() % 8);
          break;
        case 2:
          bytes.insert(at, bytes.substr(random() % bytes.size(), 1 + random() % 16));
          break;
        default:
          bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
          break;
      }
    }
    const auto file = write("m" + std::to_string(trial) + "." + seed.ending, bytes);
    try {
      const auto mesh = importMesh(file, RegionsFrom::group, limits);
      ++taken;
      ASSERT_FALSE(mesh.triangles.empty());
      ASSERT_EQ(mesh.region.size(), mesh.triangles.size());
      for (const auto& p : mesh.vertices_m) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
      for (const auto& triangle : mesh.triangles) {
        for (const auto corner : triangle) ASSERT_LT(corner, mesh.vertices_m.size());
      }
    } catch (const sim::InputError& error) {
      ++refused;
      ASSERT_TRUE(std::string(error.what()).starts_with(file.string() + ": ")) << error.what();
    }
  }
  EXPECT_GT(taken, 10);
  EXPECT_GT(refused, 40);
}

}  // namespace
}  // namespace espalier::scenes
