#include <gtest/gtest.h>

#include <algorithm>
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

std::vector<sim::Vec3f> placesOf(const tinygltf::Model& model, const tinygltf::Node& node, int accessor) {
  if (at(model.accessors, accessor).componentType == TINYGLTF_COMPONENT_TYPE_FLOAT)
    return tests::valuesOf<sim::Vec3f>(model, accessor);
  std::vector<sim::Vec3f> places;
  for (const auto& p : tests::valuesOf<std::array<std::uint16_t, 4>>(model, accessor)) {
    const sim::Vec3 steps(p[0], p[1], p[2]);
    places.emplace_back(sim::Vec3(node.translation[0], node.translation[1], node.translation[2]) +
                        sim::Vec3(node.scale[0], node.scale[1], node.scale[2]) * steps);
  }
  return places;
}

std::vector<sim::Vec3f> normalsOf(const tinygltf::Model& model, int accessor) {
  if (at(model.accessors, accessor).componentType == TINYGLTF_COMPONENT_TYPE_FLOAT)
    return tests::valuesOf<sim::Vec3f>(model, accessor);
  EXPECT_TRUE(at(model.accessors, accessor).normalized);
  std::vector<sim::Vec3f> normals;
  for (const auto& n : tests::valuesOf<std::array<std::int8_t, 4>>(model, accessor))
    normals.emplace_back(sim::Vec3f(n[0], n[1], n[2]) / 127.0f);
  return normals;
}

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
    for (const sim::Vec3f p : placesOf(model, node, primitive.attributes.at("POSITION"))) {
      const std::array<float, 3> key{p.x, p.y, p.z};
      mesh.points.push_back(points.try_emplace(key, static_cast<std::uint32_t>(points.size())).first->second);
      mesh.positions_m.push_back(p);
    }
    for (const sim::Vec3f n : normalsOf(model, primitive.attributes.at("NORMAL"))) mesh.normals.push_back(n);
    const auto& indices = at(model.accessors, primitive.indices);
    EXPECT_EQ(indices.componentType, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
    for (const auto& t : trianglesOf<std::uint16_t>(model, primitive.indices, first))
      mesh.triangles.push_back(t);
  }
  return mesh;
}

/// One closed surface, outwards, with the triangles of another that are no farther off than that.
void expectTheSame(const ModelMesh& read, const ModelMesh& modelled, float off_m) {
  const tests::Topology topology = tests::topologyOf(read), wanted = tests::topologyOf(modelled);
  EXPECT_EQ(topology.bad_edges, 0u);
  EXPECT_EQ(topology.bad_points, 0u);
  EXPECT_EQ(topology.flat, 0u);
  EXPECT_EQ(topology.euler(), wanted.euler());
  EXPECT_EQ(topology.components, wanted.components);
  EXPECT_GT(tests::volumeOf(read), 0.0);
  ASSERT_EQ(read.triangles.size(), modelled.triangles.size());
  std::size_t inwards = 0, were_inwards = 0;
  const auto inward = [](const ModelMesh& mesh, const std::array<std::uint32_t, 3>& t) {
    const auto& p = mesh.positions_m;
    return glm::dot(glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]),
                    mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]]) <= 0.0f;
  };
  for (std::size_t i = 0; i < read.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = read.triangles[i][k], b = modelled.triangles[i][k];
      ASSERT_LE(glm::distance(read.positions_m[a], modelled.positions_m[b]), off_m);
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
  expectTheSame(readBack(file, "tree stems"), model.stems, 0.0f);
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

TEST(GltfShape, BesideInstancesStemsAreInStepsFarFinerThanTheirTwigs) {
  const render::PlantModel model =
      render::modelPlant(tests::smallVine(), tests::kVineFrame, {.instances = true});
  const auto file = tests::readGlb(render::glbBytes({{}, {&model}}));
  const auto& stems = tests::primitiveOf(file, "vine stems");
  EXPECT_EQ(at(file.accessors, stems.attributes.at("POSITION")).componentType,
            TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
  EXPECT_GT(model.thinnest_m, 0.0);
  expectTheSame(readBack(file, "vine stems"), model.stems, static_cast<float>(model.thinnest_m / 16.0));
}

TEST(GltfShape, StemsAreInFloatsWhereStepsWouldBeTooCoarse) {
  render::PlantModel model = render::modelPlant(tests::smallVine(), tests::kVineFrame, {.instances = true});
  model.thinnest_m = 1e-6;
  const auto file = tests::readGlb(render::glbBytes({{}, {&model}}));
  EXPECT_EQ(file.extensionsRequired, std::vector<std::string>{"EXT_mesh_gpu_instancing"});
  expectTheSame(readBack(file, "vine stems"), model.stems, 0.0f);
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
