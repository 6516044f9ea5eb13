// Mesh files, as the program reads them: in a child, with all that is checked before and after. Built once
// for each format, which ESPALIER_FUZZ_MESH names. What stands behind the line kCompanion is a file beside
// the mesh.
#include "scenes/import/mesh_import.h"
#include "sim/base/error.h"
#include "sim/tile/mesh.h"
#include "tests/fuzz/input_files.h"
#include "tests/fuzz/target.h"
#include "tests/scenes/import/mesh_files.h"
#ifdef ESPALIER_FUZZ_WATCHED
#include "tests/fuzz/child_watch.h"
#endif

namespace espalier::fuzz {
namespace {

namespace samples = tests;

constexpr std::string_view kCompanion = "\n=== beside it\n";
constexpr std::string_view kFormat = ESPALIER_FUZZ_MESH;

std::string with(const std::string& mesh, const std::string& companion) {
  return mesh + std::string(kCompanion) + companion;
}

std::vector<std::string> objSeeds() {
  auto files = sourceFiles("tests/scenes/read/version_1", ".obj");
  const auto walls = sourceFiles("scenes/meshes", "maze_walls.obj");
  files.insert(files.end(), walls.begin(), walls.end());
  files.push_back(with(samples::kSquareObj, samples::kPaintMtl));
  files.emplace_back(
      "o a b\nv 0 0 0 1\nv 1 0 0\nv 1 1 0\nv 0 1e-3 0\no b\nf -4/1/1 -3//2 -2 -1\ns off\nl 1 2\np 1\n");
  files.push_back(with(
      "mtllib x.mtl\nvn 0 0 1\nvt 0 1\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n",
      "newmtl m\nKd nan 2 -1\nmap_Kd a.png\nd 0.5\n"));
  files.push_back(
      with("# C:\\\rmtllib gone.mtl x.mtl # a\r\nv .5 ,5 +1e-3 .1 .2 .3\nv 1 \\\n 0 0\nv 0 1 0\nusemtl m "
           "n\ng \xff "
           "\x1b\nf 1 \\\r\n2 3\nusemtl gone\nf 3 2 1\nusemtl\ng\nf 1 2 3 1\n",
           "\xef\xbb\xbfnewmtl m n\r\nkd 0.5 # grey\r\nKd xyz 1 1 1\nnewmtl\nKd 0,5 1e9 1e-50\nnewmtl m "
           "n\nKd 1 \\\n1 "
           "1"));
  return files;
}

std::vector<std::string> stlSeeds() {
  return {samples::binaryStl(1), samples::binaryStl(5),
          "solid a b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
          "0\nendloop\nendfacet\nendsolid\n"};
}

std::vector<std::string> plySeeds() {
  std::string big = samples::binarySquarePly();
  big.replace(big.find("little"), 6, "big");
  return {samples::kSquarePly, samples::binarySquarePly(), big,
          "ply\nformat ascii 1.0\nobj_info x\nelement vertex 3\nproperty double x\nproperty double "
          "y\nproperty double z\n"
          "property uchar red\nelement face 1\nproperty list uchar uint vertex_index\nproperty int "
          "flags\nelement edge 0\n"
          "property int vertex1\nend_header\n0 0 0 255\n1 0 0 0\n0 1e2 -.5 9\n3 0 1 2 7\n"};
}

std::vector<std::string> gltfSeeds() {
  auto document = samples::gltfDocument();
  std::vector<std::string> files = {samples::glb(document, samples::gltfBuffer()),
                                    samples::glb(document, samples::gltfBuffer(7))};
  document["buffers"][0]["uri"] = "beside.bin";
  files.push_back(with(document.dump(), samples::gltfBuffer()));
  document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + std::string(59, 'A') + "=";
  document["meshes"][0]["primitives"][0]["mode"] = 5;
  files.push_back(document.dump());
  document = samples::gltfDocument();  // places that are changed by others, and indices in steps
  document["accessors"][0]["sparse"] = {{"count", 2},
                                        {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                                        {"values", {{"bufferView", 0}, {"byteOffset", 12}}}};
  document["bufferViews"][0]["byteStride"] = 12;
  document["accessors"][1]["componentType"] = 5121;
  document["meshes"][0]["primitives"][0]["mode"] = 6;
  document["nodes"][1] = {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}}};
  document["extensionsUsed"] = document["extensionsRequired"] = {"KHR_materials_unlit"};
  document["scenes"].push_back({{"nodes", {1, 2}}});
  document["scene"] = 1;
  files.push_back(samples::glb(document, samples::gltfBuffer()));
  return files;
}

/// What the file that the mesh may name is called.
std::string companionOf(std::string_view mesh) {
  if (kFormat == "gltf") return "beside.bin";
  return mesh.find("x.mtl") != mesh.npos ? "x.mtl" : "paint.mtl";
}

std::string nameOf(std::string_view mesh) {
  return kFormat == "gltf" && mesh.starts_with("glTF") ? "mesh.glb" : "mesh." + std::string(kFormat);
}

}  // namespace

std::vector<std::string> seeds() {
  if (kFormat == "obj") return objSeeds();
  if (kFormat == "stl") return stlSeeds();
  return kFormat == "ply" ? plySeeds() : gltfSeeds();
}

}  // namespace espalier::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace espalier;
  static const fuzz::InputFiles files;
  const std::string_view all = fuzz::textOf(data, size), mesh = all.substr(0, all.find(fuzz::kCompanion));
  const auto beside =
      files.write(fuzz::companionOf(mesh), all.substr(std::min(mesh.size() + fuzz::kCompanion.size(), size)));
  const auto file = files.write(fuzz::nameOf(mesh), mesh);
  scenes::ChildLimits limits;
  limits.cpu = std::chrono::seconds(2);
  const auto regions = size % 2 == 0 ? scenes::RegionsFrom::group : scenes::RegionsFrom::material;
  try {
    scenes::MeshSources read;
    sim::Mesh mesh_read = scenes::importMesh(file, regions, limits, &read);
    fuzz::require(!read.files.empty() && !mesh_read.triangles.empty(), "a mesh of nothing");
    sim::contentHash(mesh_read);
    scenes::placeMesh(std::move(mesh_read), {.unit = scenes::LengthUnit::ft,
                                             .up = scenes::UpAxis::z,
                                             .scale = 2.0,
                                             .rotate_deg = {30.0, -90.0, 360.0},
                                             .translate_m = {1.0, 2.0, 3.0}});
  } catch (const sim::InputError& error) {
    const std::string_view text = error.what();
    fuzz::require(text.find(' ') != text.npos, "an error without a sentence");
  }
#ifdef ESPALIER_FUZZ_WATCHED
  fuzz::requireChildrenWithoutFault();
#endif
  return 0;
}

#ifdef ESPALIER_FUZZ_WATCHED
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  espalier::fuzz::watchChildren();
  return 0;
}
#endif
