#pragma once
#include <string>

#include "sim/field.h"
#include "sim/world.h"

namespace espalier::render {

/// Exposure to be written beside the world's own grids; either may be missing. Borrowed, of the world's size.
struct ExposureFields {
  const sim::ExposureField* sun = nullptr;
  const sim::ExposureField* sky = nullptr;
};

/// A .vdb file of the world. Grids, all with one transform from voxels to world metres: `density` (1 where
/// occupied: what Blender shows), `part`, `colour`, `coverage`, `normal`; `layer`, `nearest` and `distance`
/// within the boundary layers; `sun_exposure` and `sky_exposure` where given, on surfaces (judged from the
/// free space in front of them) and in the layers around them. Every grid says what it holds and in what
/// unit; the names of the parts are in the file's metadata. OpenVDB's random file id is replaced by one that
/// follows from the contents, so that the same world gives the same bytes. Throws InputError where a field
/// has another size than the world.
std::string vdbBytes(const sim::World& world, const ExposureFields& fields = {});

}  // namespace espalier::render
