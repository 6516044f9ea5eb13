#include "sim/tile/mesh.h"

#include "sim/base/hasher.h"

namespace espalier::sim {

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
