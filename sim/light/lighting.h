#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/light/random_sky.h"
#include "sim/light/sky.h"
#include "sim/light/sun.h"
#include "sim/world/field.h"
#include "sim/world/world.h"

namespace espalier::sim {

struct LightWanted {
  bool faces = true;       ///< light of the faces that are judged by themselves
  bool brightest = false;  ///< the brightest way from each surface
  /// Voxels where light is wanted beside the surfaces, such as freeBand's; null: none.
  std::shared_ptr<const VoxelSet> space = nullptr;
  bool dense = false;               ///< in every voxel of the world, whatever `space` says
  bool space_hours = false;         ///< hours of sun too, there
  const BitVolume* bare = nullptr;  ///< and the sky's as if this alone took light, there; null: no
  /// Greene's rays for sky_exposure instead of the sky's directions. They know no normals: surfaces then
  /// receive what level ground would in front of them.
  std::optional<RandomSky> random_sky = std::nullopt;
  /// A sun in one place, unit: what of it each surface sees.
  std::optional<Vec3> to_sun = std::nullopt;
};

/// What the numbers of a light are: named wherever they are shown.
struct LightAbout {
  std::string sky;        ///< in words
  std::string weighting;  ///< of the sky, as scene files name it
  std::size_t directions = 0;
  double standard_error = 0.0;     ///< of sky_exposure; 0: not known
  std::string sun;                 ///< in words; empty: there is none, and no more of the following
  std::size_t sun_directions = 0;  ///< within sun_error_deg of the sun's places
  double sun_error_deg = 0.0;
  double sun_hours = 0.0;  ///< a day, where nothing obstructs
  double voxel_m = 0.0;
  std::string interreflection;  ///< of light that bounces, in words; empty: none was found
};

/// What surfaces receive of one kind of light: the values of Lighting::surfaces, then of Lighting::faces.
struct Received {
  std::vector<float> values;
  std::array<float, 6> beyond{};  ///< what a face receives that looks out of the world, by its direction
};

/// The light of a world, found once for its pictures, tables and files. Surfaces are judged by their own
/// normals (sim/light/surface.h).
///
/// What shows its back, or has no place in front (deep in a gap), is judged face by face: a cube's face
/// receives what a surface with the face's normal would in the voxel before it. So walls of a single
/// sheet have values from behind too: they are in pictures and .vdb files, and in no table.
struct Lighting {
  std::vector<TiledVoxel> surfaces;       ///< with places in front, in (y, z, x) order
  std::shared_ptr<const VoxelSet> where;  ///< the same, numbered alike
  std::vector<std::uint64_t> faces;       ///< judged by themselves: faceKey of each, ascending
  std::shared_ptr<const VoxelSet> gaps;   ///< voxels with such faces that are no surfaces

  Received sky, sun;             ///< 0..1
  Received sun_hours;            ///< a day
  Received sun_now;              ///< 0..1: of LightWanted::to_sun, where that was asked for
  std::vector<Vec3f> brightest;  ///< by surface: unit, zero where no sky is seen; empty if not wanted

  /// In free space, as level ground receives it; null where not wanted. Hours are fractions of
  /// about.sun_hours.
  std::shared_ptr<const ExposureField> space_sky, space_sun, space_hours;
  /// As space_sky, with nothing in the way but what LightWanted::bare holds.
  std::shared_ptr<const ExposureField> bare_sky;

  LightAbout about;

  /// By voxel, in (y, z, x) order, then face, as sim/base/faces.h numbers them.
  std::uint64_t faceKey(Voxel voxel, std::uint8_t face) const;
  /// The voxel of such a key.
  Voxel voxelOf(std::uint64_t face_key) const;
  /// Of a face of an occupied voxel with no occupied voxel before it.
  float atFace(const Received& light, Voxel voxel, std::uint8_t face) const;
  /// Of each voxel of `gaps` the mean over its faces.
  std::vector<float> ofGaps(const Received& light) const;
};

/// Finds the light of a world; a sun without directions gives none. Takes the world's bits, the surfaces, a
/// bit for each direction and place before a surface, and what is wanted in free space.
Lighting lightOf(const World& world, const Sky& sky, const Sun& sun = {}, const LightWanted& wanted = {});

}  // namespace espalier::sim
