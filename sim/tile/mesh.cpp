#include "sim/tile/mesh.h"

#include <cmath>

#include "sim/base/hasher.h"

namespace espalier::sim {

Vec3f unitOrNone(const Vec3& normal) {
  const double length = glm::length(normal);
  return std::isfinite(length) && length > 1e-30 ? Vec3f(normal / length) : Vec3f(0.0f);
}

std::uint64_t contentHash(const Mesh& mesh) {
  Hasher hash;
  hash.add(mesh.vertices_m);
  hash.add(mesh.triangles);
  hash.add(mesh.region);
  hash.add(mesh.material);
  for (const std::string& region : mesh.regions) hash.add(std::string_view(region));
  for (const Material& material : mesh.materials) {
    for (const float channel : {material.colour.r, material.colour.g, material.colour.b}) hash.add(channel);
  }
  return hash.digest();
}

}  // namespace espalier::sim
