#include <draco/compression/decode.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "render/files/gltf.h"
#include "tests/support/glb.h"
#include "tests/support/random_trees.h"
#include "tests/support/small_vine.h"
#include "tests/support/sound_surface.h"

namespace espalier {
namespace {

using render::ModelMesh;
using tests::at;

const sim::Frame kTreeFrame{sim::Vec3(1.0, -2.0, 0.5), 0.04, sim::Voxel(200)};

/// With so much added to each index.
template <class Index>
std::vector<std::array<std::uint32_t, 3>> trianglesOf(const tinygltf::Model& model, int accessor,
                                                      std::uint32_t first = 0) {
  const auto corners = tests::valuesOf<Index>(model, accessor);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
    triangles.push_back({first + corners[i], first + corners[i + 1], first + corners[i + 2]});
  return triangles;
}

/// A node's primitives as one mesh, whose points are what lies in one place.
ModelMesh readBack(const tinygltf::Model& model, const std::string& name) {
  const tinygltf::Node& node = tests::nodeNamed(model, name);
  ModelMesh mesh;
  std::map<std::array<float, 3>, std::uint32_t> points;
  for (const auto& primitive : at(model.meshes, node.mesh).primitives) {
    const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
    for (const sim::Vec3f p : tests::valuesOf<sim::Vec3f>(model, primitive.attributes.at("POSITION"))) {
      const std::array<float, 3> key{p.x, p.y, p.z};
      mesh.points.push_back(points.try_emplace(key, static_cast<std::uint32_t>(points.size())).first->second);
      mesh.positions_m.push_back(p);
    }
    for (const sim::Vec3f n : tests::valuesOf<sim::Vec3f>(model, primitive.attributes.at("NORMAL")))
      mesh.normals.push_back(n);
    const auto& indices = at(model.accessors, primitive.indices);
    EXPECT_EQ(indices.componentType, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
    for (const auto& t : trianglesOf<std::uint16_t>(model, primitive.indices, first))
      mesh.triangles.push_back(t);
  }
  return mesh;
}

/// As closed as another surface, and outwards.
void expectAsSound(const ModelMesh& read, const ModelMesh& modelled) {
  const tests::Topology topology = tests::topologyOf(read), wanted = tests::topologyOf(modelled);
  EXPECT_EQ(topology.bad_edges, 0u);
  EXPECT_EQ(topology.bad_points, 0u);
  EXPECT_EQ(topology.flat, 0u);
  EXPECT_EQ(topology.euler(), wanted.euler());
  EXPECT_EQ(topology.components, wanted.components);
  EXPECT_GT(tests::volumeOf(read), 0.0);
  ASSERT_EQ(read.triangles.size(), modelled.triangles.size());
}

/// The same triangles, one after the other.
void expectTheSame(const ModelMesh& read, const ModelMesh& modelled) {
  expectAsSound(read, modelled);
  std::size_t inwards = 0, were_inwards = 0;
  const auto inward = [](const ModelMesh& mesh, const std::array<std::uint32_t, 3>& t) {
    const auto& p = mesh.positions_m;
    return glm::dot(glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]),
                    mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]]) <= 0.0f;
  };
  for (std::size_t i = 0; i < read.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = read.triangles[i][k], b = modelled.triangles[i][k];
      ASSERT_EQ(read.positions_m[a], modelled.positions_m[b]);
      ASSERT_GT(glm::dot(glm::normalize(read.normals[a]), modelled.normals[b]), 0.9999f);
    }
    inwards += inward(read, read.triangles[i]);
    were_inwards += inward(modelled, modelled.triangles[i]);
  }
  EXPECT_LE(inwards, were_inwards + read.triangles.size() / 1000);
}

TEST(GltfShape, LargeSurfacesAreInPartsThatShortIndicesReach) {
  sim::Plant plant;
  plant.name = "tree";
  plant.skeleton = tests::randomTree(3, 6000);
  const render::PlantModel model = render::modelPlant(plant, kTreeFrame);
  ASSERT_GT(model.stems.positions_m.size(), 65535u);
  const auto file = tests::readGlb(render::glbBytes({{}, {&model}}));
  EXPECT_GT(at(file.meshes, 0).primitives.size(), 1u);
  expectTheSame(readBack(file, "tree stems"), model.stems);
}

/// Triangles that follow each other have nothing in common: parts would hold most vertices several times.
TEST(GltfShape, ASurfaceThatCannotBePartedHasLongIndices) {
  for (const bool mixed : {true, false}) {
    SCOPED_TRACE(mixed);
    render::PlantModel model;
    model.name = "fan";
    model.stems.name = "fan stems";
    for (std::uint32_t v = 0; v < 70'000; ++v) {
      model.stems.positions_m.emplace_back(static_cast<float>(v % 300), static_cast<float>(v / 300), 0.0f);
      model.stems.normals.emplace_back(0.0f, 0.0f, 1.0f);
      model.stems.uvs.emplace_back(0.0f, 0.0f);
      model.stems.exposures.push_back(1.0f);
      model.stems.youths.push_back(0.0f);
      model.stems.orders.push_back(0);
    }
    for (std::uint32_t i = 2; i < 70'000; ++i) {
      const std::uint32_t v = mixed ? 2 + (i - 2) * 997 % 69'998 : i;
      if (v % 300 > 1) model.stems.triangles.push_back({v - 2, v - 1, v});
    }
    const auto file = tests::readGlb(render::glbBytes({{}, {&model}}));
    const auto& primitive = tests::primitiveOf(file, "fan stems");
    EXPECT_EQ(at(file.meshes, 0).primitives.size(), mixed ? 1u : 2u);
    EXPECT_EQ(at(file.accessors, primitive.indices).componentType,
              mixed ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
    if (!mixed) continue;
    EXPECT_EQ(trianglesOf<std::uint32_t>(file, primitive.indices), model.stems.triangles);
  }
}

/// What Draco's own decoder makes of a node's only primitive.
ModelMesh decoded(const tinygltf::Model& model, const std::string& name) {
  const auto& primitive = tests::primitiveOf(model, name);
  const auto& packed = primitive.extensions.at("KHR_draco_mesh_compression");
  const std::string bytes = tests::bytesOfView(model, packed.Get("bufferView").GetNumberAsInt());
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  const auto found = decoder.DecodeMeshFromBuffer(&buffer);
  ModelMesh mesh;
  if (!found.ok()) {
    ADD_FAILURE() << found.status().error_msg();
    return mesh;
  }
  const draco::Mesh& drawn = *found.value();
  const auto read = [&](const char* attribute, auto& values) {
    if (!primitive.attributes.contains(attribute)) return;
    const auto& about = at(model.accessors, primitive.attributes.at(attribute));
    EXPECT_EQ(about.count, drawn.num_points()) << attribute;
    EXPECT_EQ(about.bufferView, -1) << attribute;
    EXPECT_EQ(about.componentType, TINYGLTF_COMPONENT_TYPE_FLOAT) << attribute;
    const auto* from = drawn.GetAttributeByUniqueId(
        static_cast<std::uint32_t>(packed.Get("attributes").Get(attribute).GetNumberAsInt()));
    ASSERT_NE(from, nullptr) << attribute;
    values.resize(drawn.num_points());
    for (std::uint32_t v = 0; v < values.size(); ++v) from->GetMappedValue(draco::PointIndex(v), &values[v]);
  };
  read("POSITION", mesh.positions_m);
  read("NORMAL", mesh.normals);
  read("TEXCOORD_0", mesh.uvs);
  read("_EXPOSURE", mesh.exposures);
  read("_AGE", mesh.youths);
  std::vector<float> births;
  read("_BIRTH", births);
  EXPECT_EQ(births.size(), mesh.youths.size());
  for (const float birth : births) EXPECT_EQ(16.0f * birth, std::round(16.0f * birth));
  std::vector<float> orders;
  read("_ORDER", orders);
  for (const float order : orders) {
    mesh.orders.push_back(static_cast<std::uint8_t>(order));
    EXPECT_EQ(order, static_cast<float>(mesh.orders.back()));
  }
  for (std::uint32_t f = 0; f < drawn.num_faces(); ++f) {
    const auto& face = drawn.face(draco::FaceIndex(f));
    mesh.triangles.push_back({face[0].value(), face[1].value(), face[2].value()});
  }
  EXPECT_EQ(at(model.accessors, primitive.extras.Get("indices").GetNumberAsInt()).count,
            3 * mesh.triangles.size());
  std::map<std::array<float, 3>, std::uint32_t> points;
  for (const sim::Vec3f p : mesh.positions_m) {
    const std::array<float, 3> key{p.x, p.y, p.z};
    mesh.points.push_back(points.try_emplace(key, static_cast<std::uint32_t>(points.size())).first->second);
  }
  return mesh;
}

TEST(GltfShape, BesideInstancesStemsAreCompressedInStepsFarFinerThanTheirTwigs) {
  render::PlantModel model = render::modelPlant(tests::smallVine(), tests::kVineFrame, {.instances = true});
  EXPECT_GT(model.thinnest_m, 0.0);
  for (const bool pictured : {false, true}) {
    SCOPED_TRACE(pictured);
    render::LeafPicture bark;
    bark.tiles = true;
    if (pictured) model.stems.picture = std::make_shared<const render::LeafPicture>(bark);
    const auto file = tests::readGlb(render::glbBytes({{}, {&model}}));
    EXPECT_EQ(file.extensionsRequired,
              (std::vector<std::string>{"EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression"}));
    const ModelMesh read = decoded(file, "vine stems");
    expectAsSound(read, model.stems);
    ASSERT_EQ(read.uvs.empty(), !pictured);
    const double off_m = std::sqrt(3.0) * model.thinnest_m / 120.0;
    std::size_t strange = 0;  // vertices that the model has not
    for (std::size_t v = 0; v < read.positions_m.size(); ++v) {
      bool known = false;
      for (std::size_t w = 0; w < model.stems.positions_m.size() && !known; ++w) {
        known = static_cast<double>(glm::distance(read.positions_m[v], model.stems.positions_m[w])) <=
                    1.01 * off_m &&
                glm::dot(read.normals[v], model.stems.normals[w]) > 0.9999f &&
                std::abs(read.exposures[v] - model.stems.exposures[w]) < 0.002f &&
                std::abs(read.youths[v] - model.stems.youths[w]) < 0.002f &&
                read.orders[v] == model.stems.orders[w] &&
                (!pictured || (std::abs(read.uvs[v].x - model.stems.uvs[w].x) < 0.001f &&
                               std::abs(1.0f - read.uvs[v].y - model.stems.uvs[w].y) < 0.001f));
      }
      strange += !known;
    }
    EXPECT_EQ(strange, 0u) << "of " << read.positions_m.size();
  }
}

/// As of an OBJ that has four corners of its own for each face.
TEST(GltfShape, AScenesVerticesInOnePlaceAreOneWhereTheyAreNothingButPlaces) {
  sim::Mesh wall = tests::wallMesh();
  sim::Mesh loose = wall;
  loose.vertices_m.clear();
  for (auto& triangle : loose.triangles) {
    for (std::uint32_t& corner : triangle) {
      loose.vertices_m.push_back(wall.vertices_m[corner]);
      corner = static_cast<std::uint32_t>(loose.vertices_m.size() - 1);
    }
  }
  const auto tight = tests::readGlb(render::glbBytes({{&wall}, {}}));
  const auto joined = tests::readGlb(render::glbBytes({{&loose}, {}}));
  loose.uvs.assign(loose.vertices_m.size(), {0.0f, 0.0f});
  const auto apart = tests::readGlb(render::glbBytes({{&loose}, {}}));
  const auto cornersOf = [](const tinygltf::Model& model, std::size_t primitive) {
    const auto& p = at(model.meshes, 0).primitives[primitive];
    const auto places = tests::valuesOf<sim::Vec3f>(model, p.attributes.at("POSITION"));
    std::vector<sim::Vec3f> corners;
    for (const std::uint16_t i : tests::valuesOf<std::uint16_t>(model, p.indices))
      corners.push_back(places[i]);
    return corners;
  };
  for (std::size_t primitive = 0; primitive < 2; ++primitive) {
    const auto count = [&](const tinygltf::Model& model) {
      return at(model.accessors, at(model.meshes, 0).primitives[primitive].attributes.at("POSITION")).count;
    };
    EXPECT_EQ(count(joined), count(tight));
    EXPECT_GT(count(apart), count(joined));
    EXPECT_EQ(cornersOf(joined, primitive), cornersOf(tight, primitive));
  }
}

}  // namespace
}  // namespace espalier
