// How much of the sky the surfaces of a mesh see: consumer MESH
#include <espalier.h>

#include <cstdio>

int main(int count, char** arguments) try {
  using namespace espalier;
  if (count != 2) throw sim::InputError("expected a mesh file");
  const sim::World world = scenes::worldOf(arguments[1], {.voxel_m = 0.25});
  const sim::Sky sky = sim::makeSky({.weighting = sim::Weighting::cosine});
  const sim::Lighting exposure = sim::lightOf(world, sky);

  double sum = 0.0, area = 0.0;
  for (std::size_t i = 0; i < exposure.surfaces.size(); ++i) {
    sum += exposure.sky.values[i] * exposure.surfaces[i].surface.coverage;
    area += exposure.surfaces[i].surface.coverage;
  }
  if (!(area > 0.0)) throw sim::InputError("no surface of the mesh has free space before it");
  std::printf("mean sky exposure %.3f: %s\n", sum / area, exposure.about.sky.c_str());
  return 0;
} catch (const espalier::sim::InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
