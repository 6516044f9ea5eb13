// How much of the sky the surfaces of a mesh see: consumer MESH
#include <scenes/import/world_of.h>
#include <sim/light/lighting.h>

#include <cstdio>

int main(int, char** arguments) {
  using namespace espalier;
  const sim::World world = scenes::worldOf(arguments[1], 0.25);  // 25 cm voxels
  const sim::Sky sky = sim::makeSky({.weighting = sim::Weighting::cosine});
  const sim::Lighting exposure = sim::lightOf(world, sky);

  double sum = 0.0, area = 0.0;
  for (std::size_t i = 0; i < exposure.surfaces.size(); ++i) {
    sum += exposure.sky.values[i] * exposure.surfaces[i].surface.coverage;
    area += exposure.surfaces[i].surface.coverage;
  }
  std::printf("mean sky exposure %.3f: %s\n", sum / area, exposure.about.sky.c_str());
  return sum > 0.0 && sum < area ? 0 : 1;
}
