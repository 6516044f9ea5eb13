#pragma once
#include <filesystem>
#include <string>

#include "tests/support/numbers.h"

/// All that the program does with a scene, in this process.
namespace espalier::fuzz {

/// What became of a scene.
struct Ended {
  bool done = false;         ///< it came to the end of at least one job
  bool grew = false;         ///< with a segment or an element
  std::string refusal = {};  ///< else: what sim::InputError said of it
  std::string fault = {};    ///< what must never be: another exception, an error without a sentence, another
                             ///< result of the same growth. Empty where all is well
};

/// Grows a legal scene into a folder beside its file, and by chance also draws it, goes on from its state,
/// draws it again from there, and exposes it.
Ended runWhole(const std::filesystem::path& scene, tests::Numbers& numbers);

}  // namespace espalier::fuzz
