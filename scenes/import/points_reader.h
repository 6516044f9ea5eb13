#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "sim/base/provenance.h"
#include "sim/base/vec.h"

namespace espalier::scenes {

/// Reads a table of points: on each line x, y and z, with commas between, and if `type` is asked for the
/// point's type, a whole number: those of that type alone are meant. Further columns are not looked at. Empty
/// lines and those that begin with # are passed over, and so is a first line that begins with a letter or a
/// quote, as it names the columns. `read` takes the file's hash. Throws sim::InputError that begins with the
/// file's path, and its line: missing, not a regular file, above 256 MB, without points (of the type), with
/// a line that is none or has a number beyond 1e6.
std::vector<sim::Vec3> readPoints(const std::filesystem::path& file, std::optional<int> type,
                                  sim::InputFile& read);

}  // namespace espalier::scenes
