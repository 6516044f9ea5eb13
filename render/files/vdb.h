#pragma once
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sim/base/provenance.h"
#include "sim/base/voxel_set.h"
#include "sim/world/world.h"

namespace espalier::render {

/// Values for some of a world's voxels. Borrows the set, which must have the world's size.
template <class Value>
struct VdbPart {
  const sim::VoxelSet* where;
  /// Of a voxel and its number in the set; several threads may ask.
  std::function<Value(sim::Voxel voxel, std::size_t number)> value;
};

/// What is known of some of a world's voxels: a grid that is active there and nowhere else.
struct VdbField {
  std::string name;
  std::string description;
  std::string unit;
  /// Parts that share no voxel. Vectors are in world space.
  std::variant<std::vector<VdbPart<float>>, std::vector<VdbPart<std::int32_t>>,
               std::vector<VdbPart<sim::Vec3f>>>
      parts;
  std::vector<std::pair<std::string, std::string>> about = {};  ///< more metadata: name and text
  bool directions = true;  ///< vectors are of length 1; otherwise turning a grid keeps their lengths
  /// Of numbers: what all other voxels have that the scene occupies. Then the grid is one of densities, and
  /// the insides of solids take no room.
  std::optional<float> elsewhere = {};
};

/// A .vdb file of the world. Grids, all with one transform from voxels to world metres: `density` (1 where
/// occupied: what Blender shows), `part`, `colour`, `coverage`, `normal`; `layer`, `nearest` and `distance`
/// within the boundary layers; then the fields. Every grid says what it holds and in what unit; the names of
/// the parts are in the file's metadata. OpenVDB's random file id is replaced by one that follows from the
/// contents, so that the same world gives the same bytes. Throws InputError where a field has another size
/// than the world, std::ios_base::failure where the stream fails.
/// `made_by` goes into the file's metadata: `software`, `seed` and `inputs`.
/// One grid after the other is made and written; `file` must be one that can be sought in.
void writeVdb(std::ostream& file, const sim::World& world, const std::vector<VdbField>& fields = {},
              const sim::Provenance& made_by = {});
/// The same in memory.
std::string vdbBytes(const sim::World& world, const std::vector<VdbField>& fields = {},
                     const sim::Provenance& made_by = {});

/// The fields alone, with the world's transform and the names of its parts.
void writeFieldVdb(std::ostream& file, const sim::World& world, const std::vector<VdbField>& fields,
                   const sim::Provenance& made_by = {});
std::string fieldVdbBytes(const sim::World& world, const std::vector<VdbField>& fields,
                          const sim::Provenance& made_by = {});

}  // namespace espalier::render
