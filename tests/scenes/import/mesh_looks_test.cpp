// What of a mesh is only looked at: UVs, normals, textures, and what glTF says of surfaces.
#include <functional>

#include "scenes/import/mesh_import.h"
#include "scenes/import/mesh_wire.h"
#include "scenes/import/mtl.h"
#include "sim/base/error.h"
#include "tests/scenes/import/mesh_files.h"

namespace espalier::scenes {
namespace {

using nlohmann::json;
using sim::Material;
using sim::Vec3f;
using Wrap = sim::Texture::Wrap;

const std::string kPng = "\x89PNG\r\n\x1a\n of nothing", kJpeg = "\xff\xd8\xff of nothing";

class MeshLooks : public tests::MeshFiles {
 protected:
  sim::Mesh import(const std::string& file) {
    sources_ = {};
    return importMesh(folder_ / file, RegionsFrom::group, std::nullopt, &sources_);
  }
  std::string warning() const { return sources_.warnings.empty() ? "" : sources_.warnings[0].text; }
  /// The UV of the vertex at a place.
  static glm::vec2 uvAt(const sim::Mesh& mesh, const sim::Vec3& p) {
    for (std::size_t v = 0; v < mesh.vertices_m.size(); ++v)
      if (glm::distance(mesh.vertices_m[v], p) < 1e-6) return mesh.uvs.at(v);
    ADD_FAILURE() << "no vertex there";
    return {};
  }

  MeshSources sources_;
};

const std::string kTexturedObj = R"(mtllib maps/paint.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 2
usemtl red
f 1/1/1 2/2/1 3/-2/-1
usemtl bare
f 1 3 4
)";

TEST_F(MeshLooks, OfAnObjFile) {
  std::filesystem::create_directories(folder_ / "maps");
  write("maps/paint.mtl",
        "newmtl red\nKd 1 0 0\nmap_Kd -clamp on -s 2 3 -o 0.5 0 1 C:\\art\\red wall.png\nnewmtl bare\n");
  write("maps/red wall.png", kPng);
  write("square.obj", kTexturedObj);
  const sim::Mesh mesh = import("square.obj");
  EXPECT_EQ(warning(), "");
  ASSERT_EQ(mesh.uvs.size(), mesh.vertices_m.size());
  ASSERT_EQ(mesh.normals.size(), mesh.vertices_m.size());
  EXPECT_EQ(uvAt(mesh, {1, 1, 0}), glm::vec2(2.5f, 3.0f));
  for (std::size_t v = 0; v < 6; ++v) EXPECT_EQ(mesh.normals[v], v < 3 ? Vec3f(0, 0, 1) : Vec3f(0.0f)) << v;
  const auto& texture = mesh.materials.at(0).texture;
  ASSERT_NE(texture, nullptr);
  EXPECT_EQ(texture->bytes, kPng);
  EXPECT_EQ(texture->mime_type, "image/png");
  EXPECT_EQ(texture->wrap, (std::array{Wrap::clamp, Wrap::clamp}));
  EXPECT_EQ(mesh.materials.at(1).texture, nullptr);
  EXPECT_EQ(sources_.files.size(), 3u);  // the picture too
}

TEST_F(MeshLooks, WhatAnObjFileLacksIsAWarning) {
  write("square.obj", kTexturedObj + "f 1/9/1 2/x 3/1/0\n");
  std::filesystem::create_directories(folder_ / "maps");
  write("maps/paint.mtl", "newmtl red\nmap_Kd gone.png\nnewmtl bare\nmap_Kd no.png\n");
  write("maps/no.png", "not a picture");
  const sim::Mesh mesh = import("square.obj");
  EXPECT_EQ(mesh.materials.at(0).texture, nullptr);
  EXPECT_EQ(mesh.materials.at(1).texture, nullptr);
  ASSERT_EQ(sources_.warnings.size(), 2u);
  EXPECT_EQ(
      warning(),
      "the picture 'gone.png' of its materials is not there as a regular file in the mesh's folder; 1 more "
      "is left out too; such materials have their colour alone");
  EXPECT_EQ(
      sources_.warnings[1].text,
      "3 corners of its polygons ask for texture vertices or normals that are not there, and have none");
}

TEST_F(MeshLooks, FilesWithoutThemAreAsTheyWere) {
  write("square.obj", tests::kSquareObj);
  write("paint.mtl", tests::kPaintMtl);
  write("square.ply", tests::kSquarePly);
  for (const char* file : {"square.obj", "square.ply"}) {
    const sim::Mesh mesh = import(file);
    EXPECT_TRUE(mesh.uvs.empty() && mesh.normals.empty()) << file;
    EXPECT_EQ(mesh.materials[0].roughness, Material{}.roughness);
    EXPECT_TRUE(mesh.materials[0].double_sided);
  }
}

TEST_F(MeshLooks, OptionsOfMtlPictures) {
  const auto pictureOf = [](const std::string& line) {
    MtlMaterials materials;
    readMtl("newmtl m\n" + line + "\n", materials);
    return materials.at("m");
  };
  EXPECT_EQ(pictureOf("map_Kd a b.png").picture, "a b.png");
  EXPECT_EQ(pictureOf("map_kd -mm 0 1 -bm 2 -o 1 2 3 4.png").picture, "4.png");
  EXPECT_EQ(pictureOf("map_Kd -s 2 -o 1 0.25 a.png").offset, glm::vec2(1.0f, 0.25f));
  EXPECT_EQ(pictureOf("map_Kd -s 2 a.png").scale, glm::vec2(2.0f, 1.0f));
  EXPECT_FALSE(pictureOf("map_Kd -clamp off a.png").clamps);
  EXPECT_EQ(pictureOf("map_Kd -clamp").picture, "");
}

TEST_F(MeshLooks, MtlSaysHowMuchIsHidden) {
  MtlMaterials materials;
  EXPECT_EQ(
      readMtl("newmtl glass\nd 0.25\nnewmtl wall\nd 1\nnewmtl more\nd 7\nnewmtl old\nTr 0.5\n", materials),
      0);
  EXPECT_EQ(sim::opacityOf(materials.at("glass").material), 0.25f);
  EXPECT_EQ(materials.at("glass").material.alpha_mode, Material::Alpha::blend);
  for (const char* opaque : {"wall", "more", "old"}) {
    EXPECT_EQ(sim::opacityOf(materials.at(opaque).material), 1.0f);
    EXPECT_EQ(materials.at(opaque).material.alpha_mode, Material::Alpha::opaque);
  }
  EXPECT_EQ(readMtl("newmtl glass\nd -halo 0.2\n", materials), 2);
}

/// The small document with UVs as shorts, normals, and a material that says all that is read.
json texturedDocument() {
  json document = tests::gltfDocument();
  json& primitive = document["meshes"][0]["primitives"][0];
  primitive["attributes"]["NORMAL"] = 2;
  primitive["attributes"]["TEXCOORD_1"] = 3;
  document["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  document["accessors"].push_back(
      {{"bufferView", 3}, {"componentType", 5123}, {"count", 3}, {"type", "VEC2"}, {"normalized", true}});
  document["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 36}});
  document["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", 36}, {"byteLength", 12}});
  document["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", 48}, {"byteLength", kPng.size()}});
  document["buffers"].push_back({{"byteLength", 48 + kPng.size()}, {"uri", "looks.bin"}});
  document["images"] = {{{"bufferView", 4}, {"mimeType", "image/png"}, {"name", "bricks"}}};
  document["samplers"] = {{{"wrapS", 33648}, {"wrapT", 33071}}};
  document["textures"] = {{{"source", 0}, {"sampler", 0}}};
  json& material = document["materials"][0];
  material["pbrMetallicRoughness"] = {{"baseColorFactor", {0.25, 0.5, 1.0, 0.5}},
                                      {"roughnessFactor", 0.25},
                                      {"metallicFactor", 0.125},
                                      {"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}};
  material["emissiveFactor"] = {0.0, 0.5, 1.0};
  material["alphaMode"] = "MASK";
  material["alphaCutoff"] = 0.75;
  material["doubleSided"] = true;
  return document;
}

std::string looksBuffer() {
  std::string bytes;
  for (int corner = 0; corner < 3; ++corner) {
    for (const float c : {0.6f, 0.0f, 0.8f}) tests::append(bytes, c);
  }
  for (const int c : {0, 65535, 65535, 65535, 0, 0}) tests::append(bytes, static_cast<std::uint16_t>(c));
  return bytes + kPng;
}

TEST_F(MeshLooks, OfAGltfFile) {
  write("looks.bin", looksBuffer());
  write("house.glb", tests::glb(texturedDocument(), tests::gltfBuffer()));
  const sim::Mesh mesh = import("house.glb");
  EXPECT_EQ(warning(), "");
  const Material& material = mesh.materials.at(0);
  EXPECT_EQ(material.name, "paint");
  EXPECT_EQ(material.colour, sim::Colour(0.25f, 0.5f, 1.0f));
  EXPECT_EQ(material.alpha, 0.5f);
  EXPECT_EQ(material.roughness, 0.25f);
  EXPECT_EQ(material.metallic, 0.125f);
  EXPECT_EQ(material.emissive, sim::Colour(0.0f, 0.5f, 1.0f));
  EXPECT_EQ(material.alpha_mode, Material::Alpha::mask);
  EXPECT_EQ(material.alpha_cutoff, 0.75f);
  EXPECT_TRUE(material.double_sided);
  ASSERT_NE(material.texture, nullptr);
  EXPECT_EQ(material.texture->bytes, kPng);
  EXPECT_EQ(material.texture->name, "bricks");
  EXPECT_EQ(material.texture->wrap, (std::array{Wrap::mirror, Wrap::clamp}));
  ASSERT_EQ(mesh.uvs.size(), 6u);  // v upwards
  EXPECT_EQ(mesh.uvs[0], glm::vec2(0.0f, 0.0f));
  EXPECT_EQ(mesh.uvs[1], glm::vec2(1.0f, 0.0f));
  EXPECT_EQ(mesh.uvs[2], glm::vec2(0.0f, 1.0f));
  ASSERT_EQ(mesh.normals.size(), 6u);
  EXPECT_LT(glm::distance(mesh.normals[0], Vec3f(0.0f, 0.6f, 0.8f)), 1e-6f);  // its node is turned
  EXPECT_LT(glm::distance(mesh.normals[3], Vec3f(0.6f, 0.0f, 0.8f)), 1e-6f);  // and that one scaled
}

TEST_F(MeshLooks, GltfPicturesLieInUrisAndFilesToo) {
  write("looks.bin", looksBuffer());
  write("wall.jpg", kJpeg);
  json document = texturedDocument();
  document["images"][0] = {{"uri", "wall.jpg"}};
  write("house.glb", tests::glb(document, tests::gltfBuffer()));
  EXPECT_EQ(import("house.glb").materials[0].texture->mime_type, "image/jpeg");
  document["images"][0] = {{"uri", "data:image/png;base64,iVBORw0KGgo="}};
  write("house.glb", tests::glb(document, tests::gltfBuffer()));
  EXPECT_EQ(import("house.glb").materials[0].texture->bytes, kPng.substr(0, 8));
  document["images"][0] = {{"uri", "../wall.jpg"}};
  write("house.glb", tests::glb(document, tests::gltfBuffer()));
  EXPECT_EQ(import("house.glb").materials[0].texture, nullptr);
  EXPECT_NE(warning().find("'../wall.jpg'"), std::string::npos) << warning();
}

// In glTF names are for people: two pictures may have one.
TEST_F(MeshLooks, GltfPicturesOfOneNameAreTwo) {
  write("looks.bin", looksBuffer());
  write("wall.jpg", kJpeg);
  json document = texturedDocument();
  document["images"].push_back({{"uri", "wall.jpg"}, {"name", "bricks"}});
  document["textures"].push_back({{"source", 1}, {"sampler", 0}});
  json other = document["materials"][0];
  other["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 1;
  document["materials"].push_back(other);
  json second = document["meshes"][0]["primitives"][0];
  second["material"] = 1;
  document["meshes"][0]["primitives"].push_back(second);
  write("house.glb", tests::glb(document, tests::gltfBuffer()));
  const sim::Mesh mesh = import("house.glb");
  std::set<std::string> bytes;
  for (const Material& material : mesh.materials) {
    ASSERT_NE(material.texture, nullptr);
    bytes.insert(material.texture->bytes);
  }
  EXPECT_EQ(bytes, (std::set<std::string>{kPng, kJpeg}));
}

TEST_F(MeshLooks, TextureTransformsMoveTheUvs) {
  write("looks.bin", looksBuffer());
  json document = texturedDocument();
  document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
          ["KHR_texture_transform"] = {
              {"offset", {0.5, 0.25}}, {"scale", {2, 4}}, {"rotation", std::acos(0.0)}};
  write("house.glb", tests::glb(document, tests::gltfBuffer()));
  const sim::Mesh mesh = import("house.glb");
  // (0, 1) of the file, v downwards: scaled (0, 4), turned (4, 0), moved (4.5, 0.25).
  EXPECT_LT(glm::distance(mesh.uvs[0], glm::vec2(4.5f, 0.75f)), 1e-5f);
}

TEST_F(MeshLooks, QuantizedPlacesAreRead) {
  write("looks.bin", looksBuffer());
  json document = texturedDocument();
  document["accessors"][0] = {{"bufferView", 5}, {"componentType", 5122}, {"count", 3}, {"type", "VEC3"}};
  document["bufferViews"].push_back({{"buffer", 2}, {"byteLength", 24}, {"byteStride", 8}});
  document["buffers"].push_back({{"byteLength", 24}, {"uri", "places.bin"}});
  std::string places;
  for (const int c : {0, 0, 0, 0, 300, 0, 0, 0, 0, -200, 0, 0})
    tests::append(places, static_cast<std::int16_t>(c));
  write("places.bin", places);
  write("house.glb", tests::glb(document, tests::gltfBuffer()));
  EXPECT_THROW(import("house.glb"), sim::InputError);
  document["extensionsUsed"] = document["extensionsRequired"] = {"KHR_mesh_quantization"};
  write("house.glb", tests::glb(document, tests::gltfBuffer()));
  const sim::Mesh mesh = import("house.glb");
  EXPECT_EQ(mesh.vertices_m.at(4), sim::Vec3(600, 10, 0));
  EXPECT_EQ(mesh.vertices_m.at(5), sim::Vec3(0, -390, 0));
}

TEST_F(MeshLooks, LightOfItsOwnMayBeStrong) {
  write("looks.bin", looksBuffer());
  json document = texturedDocument();
  document["extensionsUsed"] = {"KHR_materials_emissive_strength"};
  json& strength = document["materials"][0]["extensions"]["KHR_materials_emissive_strength"];
  strength["emissiveStrength"] = 12.0;
  write("house.glb", tests::glb(document, tests::gltfBuffer()));
  EXPECT_EQ(import("house.glb").materials.at(0).emissive, sim::Colour(0.0f, 6.0f, 12.0f));
  strength["emissiveStrength"] = -3.0;
  write("house.glb", tests::glb(document, tests::gltfBuffer()));
  EXPECT_EQ(import("house.glb").materials.at(0).emissive, sim::Colour(0.0f));
  strength["emissiveStrength"] = "much";
  write("house.glb", tests::glb(document, tests::gltfBuffer()));
  EXPECT_THROW(import("house.glb"), sim::InputError);
}

TEST_F(MeshLooks, WithATextureOfLightThatIsNotReadNothingShines) {
  write("looks.bin", looksBuffer());
  json document = texturedDocument();
  document["materials"][0]["emissiveTexture"] = {{"index", 0}};
  write("house.glb", tests::glb(document, tests::gltfBuffer()));
  EXPECT_EQ(import("house.glb").materials.at(0).emissive, sim::Colour(0.0f));
  EXPECT_NE(warning().find("'emissiveTexture' of its materials is of a kind that is not read"),
            std::string::npos)
      << warning();
}

TEST_F(MeshLooks, NumbersOfMaterialsAreLookedAt) {
  write("looks.bin", looksBuffer());
  const auto changed = [&](const std::function<void(json & material)>& change) {
    json document = texturedDocument();
    change(document["materials"][0]);
    write("house.glb", tests::glb(document, tests::gltfBuffer()));
    return import("house.glb");
  };
  using Change = std::function<void(json&)>;
  for (const Change& change : {Change([](json& m) {
                                 m["emissiveFactor"] = {1, 2};
                               }),
                               Change([](json& m) { m["alphaMode"] = 7; }), Change([](json& m) {
                                 m["pbrMetallicRoughness"]["roughnessFactor"] = "rough";
                               })})
    EXPECT_THROW(changed(change), sim::InputError);
  EXPECT_EQ(changed([](json& m) { m["pbrMetallicRoughness"]["roughnessFactor"] = 7; }).materials[0].roughness,
            1.0f);
  for (const Change& change :
       {Change([](json& m) { m["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 1; }),
        Change([](json& m) { m["pbrMetallicRoughness"]["baseColorTexture"] = 3; })}) {
    EXPECT_EQ(changed(change).materials[0].texture, nullptr);
    EXPECT_NE(warning().find("'baseColorTexture' of its materials cannot be read"), std::string::npos);
  }
  json document = texturedDocument();
  document["accessors"][2]["count"] = 2;  // fewer normals than vertices
  write("house.glb", tests::glb(document, tests::gltfBuffer()));
  EXPECT_TRUE(import("house.glb").normals.empty());
  EXPECT_NE(warning().find("NORMAL is accessor 2"), std::string::npos) << warning();
}

TEST_F(MeshLooks, NormalsTurnWithTheMesh) {
  sim::Mesh mesh;
  mesh.vertices_m = {{1, 0, 0}};
  mesh.normals = {{1, 0, 0}};
  const sim::Mesh placed =
      placeMesh(mesh, {.scale = 3.0, .rotate_deg = {0, 90, 0}, .translate_m = {5, 0, 0}});
  EXPECT_EQ(placed.normals[0], Vec3f(0, 0, -1));
  EXPECT_LT(glm::distance(placed.vertices_m[0], sim::Vec3(5, 0, -3)), 1e-12);
}

/// The child's bytes are not trusted.
TEST(MeshWire, LooksAreCheckedOnTheWayBack) {
  sim::Mesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.region = mesh.material = {0};
  mesh.regions = {"all"};
  mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 0}};
  auto texture =
      std::make_shared<sim::Texture>(sim::Texture{"t", "image/png", kPng, {Wrap::clamp, Wrap::mirror}});
  mesh.materials.resize(2);
  for (Material& material : mesh.materials) material.texture = texture;
  mesh.materials[1].alpha_mode = Material::Alpha::blend;
  mesh.materials[1].double_sided = false;
  MeshSources sources;
  const std::string bytes = packMesh(mesh);
  const sim::Mesh back = unpackMesh(bytes, sources);
  EXPECT_EQ(packMesh(back), bytes);
  EXPECT_EQ(back.uvs, mesh.uvs);
  EXPECT_EQ(back.normals, mesh.normals);
  EXPECT_EQ(back.materials[0].texture, back.materials[1].texture);
  EXPECT_EQ(back.materials[1].texture->bytes, kPng);
  EXPECT_EQ(back.materials[1].alpha_mode, Material::Alpha::blend);
  EXPECT_FALSE(back.materials[1].double_sided);
  EXPECT_EQ(sim::contentHash(back), sim::contentHash(mesh));

  const auto refused = [&](const std::function<void(sim::Mesh&)>& change) {
    sim::Mesh changed = mesh;
    change(changed);
    EXPECT_THROW(unpackMesh(packMesh(changed), sources), std::runtime_error);
  };
  refused([](sim::Mesh& m) { m.uvs.pop_back(); });
  refused([](sim::Mesh& m) { m.uvs[0].x = NAN; });
  refused([](sim::Mesh& m) { m.normals[0].x = 7.0f; });
  refused([](sim::Mesh& m) { m.materials[0].roughness = -1.0f; });
  refused([](sim::Mesh& m) { m.materials[0].alpha_mode = static_cast<Material::Alpha>(9); });
  refused([](sim::Mesh& m) { m.materials[0].texture = std::make_shared<sim::Texture>(); });
}

TEST(ContentHash, LeavesLooksOut) {
  sim::Mesh mesh;
  mesh.vertices_m = {{0, 0, 0}};
  mesh.materials.resize(1);
  const std::uint64_t before = sim::contentHash(mesh);
  mesh.uvs = {{1, 1}};
  mesh.normals = {{0, 1, 0}};
  mesh.materials[0].texture = std::make_shared<sim::Texture>();
  mesh.materials[0].roughness = 0.1f;
  EXPECT_EQ(sim::contentHash(mesh), before);
}

}  // namespace
}  // namespace espalier::scenes
