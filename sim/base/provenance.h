#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace espalier::sim {

/// A file that a job read.
struct InputFile {
  std::string name;        ///< from the scene's file, never from the machine's root
  std::string kind;        ///< "scene", "rules", "mesh", "mesh_part" (a material file, a buffer), "points",
                           ///< "skeleton", "volume", "picture"
  std::uint64_t hash = 0;  ///< XXH3 (64 bits) of its bytes, as `xxhsum -H3` gives it

  friend bool operator==(const InputFile&, const InputFile&) = default;
};

/// What a file was made by and from, kept in its metadata: nothing of the time, the machine or its folders.
struct Provenance {
  std::string software;  ///< with its version
  std::uint64_t seed = 0;
  std::vector<InputFile> inputs;  ///< in the order of reading, each once
};

/// A hash as it is written everywhere: 16 hexadecimal digits.
std::string hexOf(std::uint64_t hash);

/// The inputs, one a line: "hash kind name".
std::string listOf(const std::vector<InputFile>& inputs);

}  // namespace espalier::sim
