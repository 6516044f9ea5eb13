#pragma once
#include <cmath>
#include <random>
#include <utility>

#include "sim/base/bits.h"
#include "sim/base/frame.h"
#include "sim/grow/plant.h"
#include "sim/tile/mesh.h"

/// A wall with a floor, and a vine on it that grew by no rule at all: something to model and to draw.
namespace espalier::tests {

inline sim::NodeId addNode(sim::Skeleton& skeleton, sim::NodeId parent, sim::Vec3 position_vx,
                           std::int32_t born = 0, float exposure = 0.5f) {
  skeleton.parent.push_back(parent);
  skeleton.position_vx.push_back(position_vx);
  skeleton.born.push_back(born);
  skeleton.columns["exposure"].push_back(exposure);
  return skeleton.size() - 1;
}

/// The leaf of Greene 1989, figure 4: two halves that meet in a keel, away from the point of attachment.
inline sim::ElementShape keeledLeaf() {
  return {"leaf",
          {{{0, .32, .04}, {-.23, .13, -.01}, {-.36, .44, -.11}, {-.24, .76, -.11}, {0, .99, -.06}},
           {{0, .32, .04}, {0, .99, -.06}, {.28, .76, -.13}, {.41, .45, -.13}, {.25, .13, -.02}}},
          {0.10f, 0.24f, 0.045f}};
}

inline const sim::Frame kVineFrame{sim::Vec3(-0.48, 0.02, -0.48), 0.04, sim::Voxel(25, 28, 25)};

/// Stems in the plane z = 15 voxels, in front of wallMesh().
inline sim::Plant smallVine() {
  std::mt19937 random(7);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  sim::Plant plant;
  plant.name = "vine";
  plant.shapes = {keeledLeaf()};
  std::vector<std::pair<sim::NodeId, sim::Vec3>> tips;
  for (const double x : {7.0, 16.0}) {
    tips.emplace_back(addNode(plant.skeleton, sim::kNoNode, {x, 0.0, 15.0}), sim::Vec3(0, 1, 0));
  }
  for (int iteration = 1; iteration <= 9; ++iteration) {
    std::vector<std::pair<sim::NodeId, sim::Vec3>> next;
    for (const auto& [tip, heading] : tips) {
      for (int child = 0; child < (iteration % 3 == 0 ? 2 : 1); ++child) {
        // One after the other: compilers draw arguments in orders of their own.
        const double out = uniform(-0.1, 0.1), up = uniform(0.1, 0.6), along = uniform(-0.8, 0.8);
        const sim::Vec3 wish(along, up, out);
        const sim::Vec3 way = glm::normalize(heading + wish);
        const sim::Vec3 from = plant.skeleton.position_vx[static_cast<std::size_t>(tip)];
        const sim::NodeId node =
            addNode(plant.skeleton, tip, from + 2.4 * way, iteration, static_cast<float>(uniform(0.2, 1.0)));
        next.emplace_back(node, way);
        for (int leaf = 0; leaf < 2; ++leaf) {
          sim::PlacedElement element;
          element.node = node;
          element.position_vx = from + uniform(0.2, 1.0) * 2.4 * way;
          element.y = glm::normalize(sim::Vec3(leaf ? 0.9 : -0.9, uniform(-0.4, 0.4), 0.5));
          element.x = glm::normalize(glm::cross(element.y, sim::Vec3(0, 0.4, 1)));
          element.z = glm::cross(element.x, element.y);
          element.scale = uniform(1.6, 3.0);
          element.exposure = static_cast<float>(uniform(0.2, 1.0));
          element.born = iteration;
          plant.elements.push_back(element);
        }
      }
    }
    tips = std::move(next);
  }
  return plant;
}

inline void addBox(sim::Mesh& mesh, sim::Vec3 low, sim::Vec3 high, const sim::Material& material) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (std::uint32_t i = 0; i < 8; ++i) {
    mesh.vertices_m.emplace_back(i & 1u ? high.x : low.x, i & 2u ? high.y : low.y, i & 4u ? high.z : low.z);
  }
  constexpr std::uint32_t kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                          {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& f : kFaces) {
    mesh.triangles.push_back({first + f[0], first + f[1], first + f[2]});
    mesh.triangles.push_back({first + f[0], first + f[2], first + f[3]});
  }
  mesh.materials.push_back(material);
  mesh.material.resize(mesh.triangles.size(), static_cast<std::uint32_t>(mesh.materials.size() - 1));
  mesh.region.resize(mesh.triangles.size(), 0);
}

/// A floor with its top at y = 0 and a wall on it.
inline sim::Mesh wallMesh() {
  sim::Mesh mesh;
  mesh.name = "wall";
  mesh.regions = {"all"};
  addBox(mesh, {-0.5, -0.02, -0.5}, {0.5, 0.0, 0.5}, {"stone", {0.4f, 0.37f, 0.32f}});
  addBox(mesh, {-0.4, 0.0, -0.1}, {0.4, 1.0, 0.05}, {"brick", {0.36f, 0.15f, 0.09f}});
  return mesh;
}

/// The wall's voxels in kVineFrame.
inline sim::BitVolume wallVoxels() {
  sim::BitVolume bits(kVineFrame.size);
  for (int y = 0; y < bits.size().y; ++y) {
    for (int z = 0; z < bits.size().z; ++z) {
      for (int x = 0; x < bits.size().x; ++x) {
        const sim::Vec3 p = sim::worldFromVoxel(kVineFrame, {x, y, z});
        if (std::abs(p.x) <= 0.4 && p.y <= 1.0 && p.z >= -0.1 && p.z <= 0.05) bits.set({x, y, z});
      }
    }
  }
  return bits;
}

}  // namespace espalier::tests
