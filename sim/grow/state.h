#pragma once
#include <iosfwd>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/base/bits.h"
#include "sim/grow/growth.h"
#include "sim/world/world.h"

/// Growth on disk: what a run has made of a site after some iteration, so that it can be gone on with, looked
/// at again, or drawn anew. The site itself is not in it: it is made again from the same meshes, which is why
/// a state says what it was grown from.
namespace espalier::sim {

/// What growth follows from, as names and values ("world.voxel", "4 cm"; "plants[0].rules.bias.up", "0.08").
using Inputs = std::vector<std::pair<std::string, std::string>>;

/// A state as it was read. Plants have neither shapes nor parts yet: restore() knows them from their process.
struct State {
  Inputs inputs;
  Growth growth;
  Voxel size{0};                   ///< of its world
  std::vector<TiledVoxel> voxels;  ///< that plants took, by part from 0
};

/// The same bytes for the same growth: a line that says what it is, a checksum, and CBOR. `site`: what was
/// occupied before anything grew. Keeps nothing of it in memory. `file` must be one that can be sought in.
void writeState(std::ostream& file, const Inputs& inputs, const World& world, const BitVolume& site,
                const Growth& growth);
/// The same in memory.
std::string stateBytes(const Inputs& inputs, const World& world, const BitVolume& site, const Growth& growth);

/// Throws InputError, naming the file, for anything that is not a whole state of this version.
State readState(std::string_view bytes, const std::string& file);

/// Puts a state's plants into a site that was made from the same inputs: the world is then what it was.
/// Throws InputError, naming the file, where the plantings or the site are not those that it was grown in.
Growth restore(State state, World& world, const std::vector<Planting>& plantings, const std::string& file);

}  // namespace espalier::sim
